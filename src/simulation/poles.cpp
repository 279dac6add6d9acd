#include "saltus/simulation/detail/poles.hpp"

#include <cmath>
#include <limits>

#include "saltus/base/detail/is_defined.hpp"
#include "saltus/simulation/detail/thresholds.hpp"

namespace saltus {

namespace {

double largest(const Tolerance& tolerance) {
  if (!tolerance.by_state()) return tolerance[0];
  return tolerance.each().empty() ? 0.0 : *std::ranges::max_element(tolerance.each());
}

bool changes_sign(double a, double b) { return (a < 0.0 && b > 0.0) || (a > 0.0 && b < 0.0); }

}  // namespace

bool Poles::may_be_passed(const SimulatorOptions& options) {
  return std::max(largest(options.rtol), largest(options.atol)) > thresholds::loose_tolerance;
}

Poles::Poles(Machine& machine, const SimulatorOptions& options)
    : machine_(&machine), options_(&options), variables_(machine) {}

void Poles::begin() {
  std::ranges::fill(before_, 0.0);
  departed_.fill({});
}

/// Whether there are divisors. Takes them if the functions of the machine are others than before.
bool Poles::looks() {
  if (std::exchange(functions_, machine_->functions()) != machine_->functions()) {
    divisors_ = flow_divisors(machine_->plan());
    const Index size = divisors_->values ? divisors_->values->size() : 0;
    for (auto* values : {&before_, &now_, &inside_}) values->assign(size, 0.0);
    for (auto* each : {&area_, &area_far_}) each->resize(machine_->plan().nx);
  }
  return divisors_->values.has_value() && !machine_->carries();
}

void Poles::look(double t, List<double>& values) {
  variables_.at(t, x_.data(),
                [&](const At& at) { divisors_->values->evaluate(at, values.data()); });
}

/// A divisor that is exactly zero keeps its last sign.
void Poles::keep(const List<double>& values) {
  for (Index i = 0; i < std::ssize(values); ++i) {
    if (values[i] != 0.0) before_[i] = values[i];
  }
}

/// Steps of some roundings would fill the list, and show nothing.
void Poles::remember(double t, const Eigen::VectorXd& x) {
  x_ = x;
  const double rounding = thresholds::eps * std::abs(t);
  if (t - departed_[newest_].t < thresholds::near_pole_roundings * rounding) return;
  Departed& place = departed_[newest_ = (newest_ + 1) % departed_.size()];
  place.t = t, place.x = x;
}

bool Poles::find(double from, double to, Integration& integration) {
  bool found = false;
  double first = std::numeric_limits<double>::infinity();
  look(to, now_);
  for (Index i = 0; i < std::ssize(now_); ++i) {
    if (!changes_sign(before_[i], now_[i])) continue;
    const double t = narrow(i, from, to);
    if (t < first && is_pole(t, from, to, integration)) first = t, found = true;
  }
  return found;
}

/// Bisects to neighbouring times.
double Poles::narrow(Index divisor, double from, double to) {
  for (;;) {
    const double middle = from + 0.5 * (to - from);
    if (!(from < middle && middle < to)) return to;
    look(middle, inside_);
    (changes_sign(before_[divisor], inside_[divisor]) ? to : from) = middle;
  }
}

/// Whether the derivative is infinite at t, where a divisor crosses zero. The step itself shows it
/// where it is long enough; a step of some roundings does not, but those before it do.
bool Poles::is_pole(double t, double from, double to, Integration& integration) {
  const double least =
      thresholds::near_pole_roundings * thresholds::eps * std::max(std::abs(from), std::abs(to));
  const double room = thresholds::least_ratio * least;
  if (t - from < room && to - t < room) return earlier_steps_show(t, least);
  return (t - from >= room && side_shows(t, from, least, integration)) ||
         (to - t >= room && side_shows(t, to, least, integration));
}

/// Compares the area of each derivative near t with that at the end of one side of the step, and at
/// the beginnings of the steps before it. At a zero of the derivative the area is small by chance, so
/// it is taken at three places of the side.
bool Poles::side_shows(double t, double end, double least, Integration& integration) {
  const double length = std::abs(end - t), near = std::max(thresholds::near_pole * length, least);
  area_far_.setZero();
  for (const double part : {1.0, 0.6, 0.3}) {
    const double at = t + part * (end - t);
    if (!area(t, at, integration.at(at), area_)) return false;
    area_far_ = area_far_.cwiseMax(area_);
  }
  for (const Departed& each : departed_) {
    if (t - each.t > thresholds::steps_around * length) continue;
    if (!area(t, each.t, each.x, area_)) return false;
    area_far_ = area_far_.cwiseMax(area_);
  }
  const double at = t + (end > t ? near : -near);
  return area(t, at, integration.at(at), area_) && stays_large(t);
}

/// The same with the beginnings of the last steps.
bool Poles::earlier_steps_show(double t, double least) {
  double nearest = std::numeric_limits<double>::infinity();
  const Departed* near = nullptr;
  for (const Departed& each : departed_) {
    if (t - each.t < least || t - each.t >= nearest) continue;
    nearest = t - each.t, near = &each;
  }
  if (near == nullptr) return false;
  area_far_.setZero();
  bool compares = false;
  for (const Departed& each : departed_) {
    if (!(t - each.t >= thresholds::least_ratio * nearest) || !std::isfinite(each.t)) continue;
    if (!area(t, each.t, each.x, area_)) return false;
    area_far_ = area_far_.cwiseMax(area_), compares = true;
  }
  return compares && area(t, near->t, near->x, area_) && stays_large(t);
}

/// Whether the area of some derivative has not shrunk with the distance; the state is noted. Its
/// tolerance is that at the begin of the step, because its end is arbitrary.
bool Poles::stays_large(double t) {
  for (Index i = 0; i < area_.size(); ++i) {
    const double tolerance = options_->atol[i] + options_->rtol[i] * std::abs(x_[i]);
    if (!(area_[i] > thresholds::area_at_pole * area_far_[i]) ||
        !(area_[i] > thresholds::least_pole * tolerance))
      continue;
    pole_ = {t, i};
    return true;
  }
  return false;
}

/// |f| times the distance from t, at a state that the solution need not reach: false if it is not
/// defined there.
bool Poles::area(double t, double at, const Eigen::VectorXd& x, Eigen::VectorXd& out) {
  if (!detail::is_defined([&] { machine_->derivative(at, x.data(), out.data()); })) return false;
  out = out.cwiseAbs() * std::abs(at - t);
  return !out.hasNaN();
}

}  // namespace saltus
