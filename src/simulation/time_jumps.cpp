// TimeJumps: the jumps of a step, and whether they move.
#include "saltus/simulation/detail/time_jumps.hpp"

#include <algorithm>
#include <cmath>

#include "saltus/simulation/detail/thresholds.hpp"

namespace saltus {

TimeJumps::Look TimeJumps::look(double t, const StateAt& state) {
  Look now{t, state(t), {}};
  now.f = probe_->flow(t, now.x.data());
  for (Index i = 0; i < rates_.size(); ++i)
    if (std::isfinite(now.f[i])) rates_[i] = std::max(rates_[i], std::abs(now.f[i]));
  return now;
}

/// The largest fourth difference, in parts of the size of its derivative.
double TimeJumps::bend(const Looks& at) const {
  double most = 0.0;
  for (Index i = 0; i < rates_.size(); ++i) {
    const double miss =
        std::abs(at[0].f[i] - 4.0 * at[1].f[i] + 6.0 * at[2].f[i] - 4.0 * at[3].f[i] + at[4].f[i]);
    if (miss > 0.0 && rates_[i] > 0.0) most = std::max(most, miss / rates_[i]);
  }
  return most;
}

/// Halves the looks where the flow is not smooth, down to neighbouring times.
void TimeJumps::search(const Looks& at, const StateAt& state, std::vector<Jump>& found) {
  if (!(bend(at) > thresholds::least_bend) || found.size() >= thresholds::most_called_jumps) return;
  const auto size = [&](std::size_t k) { return (at[k + 1].f - at[k].f).cwiseAbs().sum(); };
  bool divides = true;
  std::size_t largest = 0;
  for (std::size_t k = 0; k + 1 < at.size(); ++k) {
    const double middle = at[k].t + 0.5 * (at[k + 1].t - at[k].t);
    divides = divides && at[k].t < middle && middle < at[k + 1].t;
    if (size(k) > size(largest)) largest = k;
  }
  if (!divides) {
    const Look &minus = at[largest], &plus = at[largest + 1];
    found.push_back({minus.t, plus.t, minus.x, plus.x, plus.f - minus.f});
    return;
  }
  for (const std::size_t k : {0, 2})
    search({at[k], between(at[k], at[k + 1], state), at[k + 1],
            between(at[k + 1], at[k + 2], state), at[k + 2]},
           state, found);
}

std::vector<TimeJumps::Jump> TimeJumps::within(double from, double to, const StateAt& state) {
  std::vector<Jump> found;
  const Look first = look(from, state), last = look(to, state),
             middle = between(first, last, state);
  search({first, between(first, middle, state), middle, between(middle, last, state), last}, state,
         found);
  return found;
}

bool TimeJumps::moves(const Jump& jump, const TangentColumns& columns, Index k) {
  TangentDirection along = columns.column(k);
  along.t = 0.0;
  const double reach = probe_->reach(jump.x_before.data(), along);
  if (!(reach > 0.0)) return std::isnan(reach);
  Index most = 0;
  jump.by.cwiseAbs().maxCoeff(&most);
  const auto flow = [&](double t, const Eigen::VectorXd& x, double shift) {
    Eigen::VectorXd f(x.size());
    Machine& probe = probe_->at(x.data(), along, shift);
    probe.flow(t, probe.x.data(), f.data());
    return f[most];
  };
  for (const double shift :
       {thresholds::shift_of_jump * reach, -thresholds::shift_of_jump * reach}) {
    const double there =
        flow(jump.after, jump.x_after, shift) - flow(jump.before, jump.x_before, shift);
    if (!(std::abs(there - jump.by[most]) <= 0.5 * std::abs(jump.by[most]))) return true;
  }
  return false;
}

}  // namespace saltus
