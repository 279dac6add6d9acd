#include "saltus/simulation/detail/poles.hpp"

#include <cmath>
#include <limits>

#include "saltus/base/detail/forced_unwind.hpp"
#include "saltus/simulation/detail/thresholds.hpp"

namespace saltus {

namespace {

double largest(const Tolerance& tolerance) {
  if (!tolerance.by_state()) return tolerance[0];
  return tolerance.each().empty() ? 0.0 : *std::ranges::max_element(tolerance.each());
}

bool changes_sign(double a, double b) { return (a < 0.0 && b > 0.0) || (a > 0.0 && b < 0.0); }

}  // namespace

Poles::Poles(Machine& machine, const SimulatorOptions& options)
    : machine_(&machine),
      options_(&options),
      loose_(std::max(largest(options.rtol), largest(options.atol)) > thresholds::loose_tolerance),
      variables_(machine) {}

void Poles::begin() {
  pole_ = {};
  std::ranges::fill(before_, 0.0);
}

/// Whether there are divisors. Takes them if the functions of the machine are others than before.
bool Poles::looks() {
  if (std::exchange(functions_, machine_->functions()) != machine_->functions()) {
    divisors_ = flow_divisors(machine_->plan());
    const Index size = divisors_->values ? divisors_->values->size() : 0;
    for (auto* values : {&before_, &now_, &inside_}) values->assign(size, 0.0);
    for (auto* each : {&x_, &f_far_, &f_near_}) each->resize(machine_->plan().nx);
  }
  return divisors_->values.has_value() && !machine_->carries();
}

void Poles::look(double t, const Eigen::VectorXd& x, List<double>& values) {
  variables_.at(t, x.data(), [&](const At& at) { divisors_->values->evaluate(at, values.data()); });
}

/// A divisor that is exactly zero keeps its last sign.
void Poles::keep(const List<double>& values) {
  for (Index i = 0; i < std::ssize(values); ++i) {
    if (values[i] != 0.0) before_[i] = values[i];
  }
}

/// Whether some state has a pole at t; it is noted. Its tolerance is that at the begin of the step,
/// because its end is arbitrary.
template <class Test>
bool Poles::has_state(double t, const Test& test) {
  for (Index i = 0; i < f_far_.size(); ++i) {
    if (!test(i, options_->atol[i] + options_->rtol[i] * std::abs(x_[i]))) continue;
    pole_ = {t, i};
    return true;
  }
  return false;
}

/// Looks evenly inside the step and at its end. The look at its begin was at the state itself, from
/// which the interpolant of a multistep method differs.
bool Poles::find(double from, double to, Integration& integration) {
  bool found = false;
  double begin = from;
  for (int piece = 1; piece <= thresholds::pole_looks && !found; ++piece) {
    const double end =
        piece == thresholds::pole_looks ? to : from + (to - from) * piece / thresholds::pole_looks;
    look(end, integration.at(end), now_);
    double first = std::numeric_limits<double>::infinity();
    for (Index i = 0; i < std::ssize(now_); ++i) {
      if (!changes_sign(before_[i], now_[i])) continue;
      const double t = narrow(i, begin, end, integration);
      if (t < first && is_pole(t, from, to, integration)) first = t, found = true;
    }
    keep(now_), begin = end;
  }
  return found;
}

/// Bisects to neighbouring times.
double Poles::narrow(Index divisor, double from, double to, Integration& integration) {
  for (;;) {
    const double middle = from + 0.5 * (to - from);
    if (!(from < middle && middle < to)) return to;
    look(middle, integration.at(middle), inside_);
    (changes_sign(before_[divisor], inside_[divisor]) ? to : from) = middle;
  }
}

/// Whether the derivative is infinite at t, where a divisor crosses zero.
bool Poles::is_pole(double t, double from, double to, Integration& integration) {
  const double rounding = thresholds::eps * std::max(std::abs(from), std::abs(to));
  const double near =
      std::max(thresholds::near_pole * (to - from), thresholds::near_pole_roundings * rounding);
  const double far = thresholds::far_from_pole * near;
  const bool before = from < t - far, after = t + far < to;
  if (!before && !after) return fills(t, t - from > to - t ? from : to, integration);
  return (before && grows(t, -near, integration)) || (after && grows(t, near, integration));
}

/// Compares the derivatives at two distances from t.
bool Poles::grows(double t, double near, Integration& integration) {
  if (!derivative_at(t + thresholds::far_from_pole * near, integration, f_far_) ||
      !derivative_at(t + near, integration, f_near_))
    return false;
  return has_state(t, [&](Index i, double tolerance) {
    const double size = std::abs(f_near_[i]);
    return size > thresholds::growth_at_pole * std::abs(f_far_[i]) &&
           size * std::abs(near) > thresholds::least_pole * tolerance;
  });
}

/// For a step of some roundings: whether the derivative at its end is so large that a state moves by
/// a part of its tolerance in it.
bool Poles::fills(double t, double end, Integration& integration) {
  if (!derivative_at(end, integration, f_far_)) return false;
  return has_state(t, [&](Index i, double tolerance) {
    return std::abs(f_far_[i] * (end - t)) > thresholds::short_pole * tolerance;
  });
}

/// The derivative near a pole, which the solution need not reach: false if it is not defined there.
bool Poles::derivative_at(double t, Integration& integration, Eigen::VectorXd& f) {
  try {
    machine_->derivative(t, integration.at(t).data(), f.data());
    return true;
  } catch (const Interruption&) {
    throw;
  } catch (...) {
    detail::pass_end_of_thread();
    return false;
  }
}

}  // namespace saltus
