// CalledDerivatives: the derivatives of a function without a formula, by the values that it reads.
#pragma once

#include <functional>
#include <string>

#include "saltus/plan/detail/leaf_function.hpp"
#include "saltus/simulation/detail/tangent_probe.hpp"

namespace saltus {

/// The declared derivatives of a function, and central differences by those values for which none
/// are declared.
class CalledDerivatives {
 public:
  using Moves = std::function<bool(const ReadValue&)>;

  /// The probe has to be one of this machine.
  CalledDerivatives(Machine& machine, TangentProbe& probe)
      : machine_(&machine),
        probe_(&probe),
        unit_x_(Eigen::VectorXd::Zero(machine.plan().nx)),
        unit_z_(Eigen::VectorXd::Zero(machine.plan().nz)),
        unit_y_(Eigen::VectorXd::Zero(machine.plan().ny)) {}

  /// A row for each number of the function, a column for each value that it reads, at (t, x) of the
  /// machine, whose signals are those of that state. The columns of values that do not move are 0.
  Eigen::MatrixXd of(const LeafFunction& function, double t, const Moves& moves);

  /// Whether a column of the last one is a difference.
  bool differenced() const noexcept { return differenced_; }
  /// Why a number of the last one is NaN; empty if none is.
  const std::string& obstacle() const noexcept { return obstacle_; }

  /// The direction in which one value moves; it lasts until the next call.
  TangentDirection along(const ReadValue& read);

 private:
  Eigen::MatrixXd declared(const LeafFunction& function, double t, const Moves& moves);
  Eigen::MatrixXd jacobian(const LeafFunction& function, double t);
  void difference(const LeafFunction& function, double t, const ReadValue& read, double* out);

  Machine* machine_;
  TangentProbe* probe_;
  Eigen::VectorXd unit_x_, unit_z_, unit_y_;
  ParameterMove unit_p_;
  bool differenced_ = false;
  std::string obstacle_;
};

}  // namespace saltus
