// TangentProbe: derivatives of functions of a machine along a direction, by central differences.
#pragma once

#include <functional>
#include <string>

#include "saltus/plan/detail/machine.hpp"
#include "saltus/simulation/detail/difference_ladder.hpp"
#include "saltus/simulation/detail/tangent_columns.hpp"
#include "saltus/simulation/detail/thresholds.hpp"

namespace saltus {

/// A second machine beside that of a run. It takes the values of the run, moved along a direction
/// to both sides, and so the machine of the run is never touched.
class TangentProbe {
 public:
  explicit TangentProbe(const Machine& machine)
      : machine_(&machine), probe_(machine.shared_plan()) {
    begin();
  }
  /// A run begins: no size is known.
  void begin();

  /// The machine with the values of the run, moved by `shift` along the direction.
  Machine& at(const double* x, const TangentDirection& along, double shift);
  /// The same without a shift.
  Machine& at(const double* x) { return at(x, {}, 0.0); }

  /// The shift along a direction that moves no value by more than its size; 0 if none moves.
  double reach(const double* x, const TangentDirection& along) const {
    return shift_of(x, along, 0.0);
  }
  /// Notes how large the values are, and how long a step is [s].
  void note(const double* x, double step);
  /// What was noted.
  const TangentSizes& sizes() const noexcept { return sizes_; }
  /// Takes what another probe noted.
  void take(const TangentSizes& sizes) { sizes_ = sizes; }

  /// d out along the direction at (t, x). `read(machine, shift, out)` computes `size` numbers on a
  /// machine that is moved; the time and all that the machine does not have it moves by itself. NaN
  /// where no derivative is found.
  template <class Read>
  void derivative(const double* x, const TangentDirection& along, Index size, const Read& read,
                  double* out) {
    const auto value = [&](double shift, double* to) { read(at(x, along, shift), shift, to); };
    search(x, along, size, std::ref(value), out);
  }
  /// Why the last derivative has a NaN; empty if it has none.
  const std::string& obstacle() const noexcept { return obstacle_; }

  /// dxdot along the direction. States at rest do not move.
  void flow(double t, const double* x, const TangentDirection& along, double* out);
  /// The derivative itself, without a shift.
  Eigen::VectorXd flow(double t, const double* x);

 private:
  using Value = std::function<void(double shift, double* out)>;
  void search(const double* x, const TangentDirection& along, Index size, const Value& value,
              double* out);
  void rung(double shift, const Value& value);
  void climb_down(double shift, const Value& value);
  void clear_up(double shift, double from, const Value& value);
  bool found(double shift, const Value& value, Eigen::VectorXd& out);
  double shift_of(const double* x, const TangentDirection& along, double least) const;
  void let_rest(double* xdot) const;

  const Machine* machine_;
  Machine probe_;
  TangentSizes sizes_;
  MovedValues moved_;
  Eigen::VectorXd centre_;
  bool has_centre_ = false;
  DifferenceLadder ladder_;
  std::string raised_, obstacle_;
};

}  // namespace saltus
