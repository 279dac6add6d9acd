// The last step towards the edge of what a derivative is defined for: along the tangent.
#pragma once

#include <algorithm>
#include <cmath>
#include <exception>

#include "saltus/solver/detail/solver.hpp"
#include "saltus/solver/detail/thresholds.hpp"

namespace saltus::detail {

/// A guard at the edge of the domain of a derivative, as x of sqrt(x), is zero where no step can
/// end, because the derivative is not finite beyond. The steps become shorter until the edge is
/// nearer than the shortest of them. This step goes on from there along x0 + u f(t0, x0), a few
/// hundred roundings of the time, so that the guard can be located; nothing is computed beyond it.
class TangentStep {
 public:
  /// Prepares the step from (t, x) after a step that threw, in the handler of its exception. False
  /// if the derivative is finite ahead, so that something else is wrong.
  bool prepare(Machine& machine, double t, const Eigen::VectorXd& x, double t_stop) {
    length_ = std::min(t_stop - t, thresholds::tangent_roundings * thresholds::eps * std::abs(t));
    if (!(length_ > 0.0) || machine.not_finite(t, x.data())) return false;
    x0_ = x;
    f_.resize(x.size());
    machine.derivative(t, x0_.data(), f_.data());
    end_ = x0_ + length_ * f_;
    if (!machine.not_finite(t + length_, end_.data())) return false;
    refused_ = std::current_exception();
    return true;
  }
  void leave() noexcept { refused_ = nullptr; }
  /// Whether this is the current step.
  explicit operator bool() const noexcept { return refused_ != nullptr; }

  double length() const noexcept { return length_; }  // [s]
  const Eigen::VectorXd& end() const noexcept { return end_; }
  void inside(double u, double* x) const {
    Eigen::Map<Eigen::VectorXd>(x, x0_.size()) = x0_ + u * f_;
  }
  /// Throws what the step of the method threw, because no guard is zero on this one.
  [[noreturn]] void give_up() const { std::rethrow_exception(refused_); }

 private:
  double length_ = 0.0;
  Eigen::VectorXd x0_, f_, end_;
  std::exception_ptr refused_;
};

}  // namespace saltus::detail
