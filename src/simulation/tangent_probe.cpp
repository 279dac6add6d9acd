// TangentProbe: how far a machine is moved, and the derivatives by differences.
#include "saltus/simulation/detail/tangent_probe.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "saltus/base/detail/forced_unwind.hpp"
#include "saltus/base/error.hpp"

namespace saltus {

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// Differences to u and 2 u together have the error u^4 / 30 by the fifth derivative, and eps / u
/// by rounding: both are below 1e-12 for this relative shift.
constexpr double first_shift = 1e-3;
/// The next rung below. A function that changes c times as fast as its arguments needs c u < 0.014
/// (see `agreement` in difference_ladder.cpp). The last rung is at 1e-9: c is up to 1e7, and rounding is 2e-7.
constexpr double ladder_step = 30.0;
constexpr int ladder_rungs = 4;
/// The step between the larger shifts for a tiny value: a good shift has about as many decades.
constexpr double clear_step = 1e3;

/// |d| in units of the size of a value; a value that was zero so far counts as 1.
double in_sizes(double d, double size) {
  return d == 0.0 ? 0.0 : std::abs(d) / (size > 0.0 ? size : 1.0);
}

std::string first_line(const std::string& of) { return of.substr(0, of.find('\n')); }

}  // namespace

void TangentProbe::begin() {
  sizes_.x.setZero(machine_->x.size());
  sizes_.z.setZero(machine_->z.size()), sizes_.y.setZero(machine_->y.size());
  sizes_.step = 0.0;
}

void TangentProbe::note(const double* x, double step) {
  const auto grow = [](Eigen::VectorXd& sizes, const double* now) {
    for (Index i = 0; i < sizes.size(); ++i) sizes[i] = std::max(sizes[i], std::abs(now[i]));
  };
  grow(sizes_.x, x), grow(sizes_.z, machine_->z.data()), grow(sizes_.y, machine_->y.data());
  sizes_.step = std::max(sizes_.step, step);
}

/// The shift that moves no value by more than its size, where a size is at least `least`; 0 if
/// nothing moves, NaN if the direction is.
double TangentProbe::shift_of(const double* x, const TangentDirection& along, double least) const {
  double most =
      in_sizes(along.t, sizes_.step);  // a short step says nothing: it may end at an event
  const auto look = [&](const double* d, const Eigen::VectorXd& sizes, const double* values) {
    if (d == nullptr) return;
    for (Index i = 0; i < sizes.size(); ++i) {
      const double now = in_sizes(d[i], std::max({std::abs(values[i]), sizes[i], least}));
      most = std::isnan(now) || std::isnan(most) ? nan : std::max(most, now);
    }
  };
  look(along.x, sizes_.x, x);
  look(along.z, sizes_.z, machine_->z.data());
  look(along.y, sizes_.y, machine_->y.data());
  for (const ParameterMove& move : along.p)
    if (!std::isnan(most))
      most = std::max(most, in_sizes(move.by, std::max(std::abs(machine_->p[move.entry]), least)));
  return most > 0.0 ? 1.0 / most : most;
}

void TangentProbe::search(const double* x, const TangentDirection& along, Index size,
                          const Value& value, double* out) {
  obstacle_.clear(), raised_.clear(), has_centre_ = false;
  const double shift = shift_of(x, along, 0.0);
  if (!(shift > 0.0)) {
    std::fill_n(out, size, std::isnan(shift) ? nan : 0.0);
    if (std::isnan(shift)) obstacle_ = "a derivative that it follows from is not a number";
    return;
  }
  for (Eigen::VectorXd* to : {&moved_.up, &moved_.down, &moved_.far_up, &moved_.far_down, &centre_})
    to->resize(size);
  ladder_.begin(size, 1.0 / shift_of(x, along, 1.0));
  rung(first_shift * shift, value);
  if (ladder_.open()) climb_down(first_shift * shift, value);
  if (ladder_.blurred())
    clear_up(first_shift * shift, first_shift * shift_of(x, along, 1.0), value);
  if (ladder_.write(out)) return;
  obstacle_ = raised_.empty() ? "the function jumps or has a kink there"
                              : "a function raised at a moved value: " + raised_;
}

/// Smaller shifts, then a larger one, until all numbers are settled.
void TangentProbe::climb_down(double shift, const Value& value) {
  double smaller = shift;
  for (int k = 0; k < ladder_rungs && ladder_.open(); ++k) rung(smaller /= ladder_step, value);
  if (ladder_.open()) rung(ladder_step * shift, value);
}

/// A tiny value may count as zero. So this tries the shifts for a zero, down to those of its size.
void TangentProbe::clear_up(double shift, double from, const Value& value) {
  for (double larger = from; larger > ladder_step * shift && ladder_.blurred();
       larger /= clear_step)
    rung(larger, value);
}

void TangentProbe::rung(double shift, const Value& value) {
  moved_.shift = shift;
  const bool all = found(shift, value, moved_.up) && found(-shift, value, moved_.down) &&
                   found(2.0 * shift, value, moved_.far_up) &&
                   found(-2.0 * shift, value, moved_.far_down);
  if (!all) return;
  ladder_.look(moved_, [&]() -> const Eigen::VectorXd* {
    if (!has_centre_) has_centre_ = found(0.0, value, centre_);
    return has_centre_ ? &centre_ : nullptr;
  });
}

/// Whether the function has values there. If it raises, it has none, and the run goes on.
bool TangentProbe::found(double shift, const Value& value, Eigen::VectorXd& out) {
  try {
    value(shift, out.data());
    return true;
  } catch (const Interruption&) {
    throw;
  } catch (const std::exception& error) {
    raised_ = first_line(error.what());
  } catch (...) {
    detail::pass_end_of_thread();
    raised_ = "an exception that is not a std::exception";
  }
  return false;
}

Machine& TangentProbe::at(const double* x, const TangentDirection& along, double shift) {
  const auto move = [shift](const double* base, const double* d, Eigen::VectorXd& to) {
    for (Index i = 0; i < to.size(); ++i) to[i] = base[i] + (d == nullptr ? 0.0 : shift * d[i]);
  };
  move(x, along.x, probe_.x);
  move(machine_->z.data(), along.z, probe_.z);
  move(machine_->y.data(), along.y, probe_.y);
  move(machine_->p.data(), nullptr, probe_.p);
  for (const ParameterMove& one : along.p) probe_.p[one.entry] += shift * one.by;
  if (probe_.modes != machine_->modes || probe_.seen_guards().outdated()) {
    probe_.modes = machine_->modes;
    probe_.select_guards();
  }
  return probe_;
}

void TangentProbe::let_rest(double* xdot) const {
  const RestingStates& resting = machine_->resting();
  if (!resting.any()) return;
  for (Index i = 0; i < sizes_.x.size(); ++i) {
    if (resting.rests(i)) xdot[i] = 0.0;
  }
}

void TangentProbe::flow(double t, const double* x, const TangentDirection& along, double* out) {
  const auto read = [&](Machine& probe, double shift, double* xdot) {
    probe.flow(t + shift * along.t, probe.x.data(), xdot);
  };
  derivative(x, along, sizes_.x.size(), read, out);
  let_rest(out);
}

Eigen::VectorXd TangentProbe::flow(double t, const double* x) {
  Eigen::VectorXd xdot(machine_->plan().nx);
  Machine& probe = at(x);
  probe.flow(t, probe.x.data(), xdot.data());
  let_rest(xdot.data());
  return xdot;
}

}  // namespace saltus
