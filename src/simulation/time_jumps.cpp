// TimeJumps: halves a step where the flow is not smooth, down to neighbouring times.
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

/// The largest second difference, in parts of the size of its derivative.
double TimeJumps::bend(const Look& a, const Look& b, const Look& c) const {
  double most = 0.0;
  for (Index i = 0; i < rates_.size(); ++i) {
    const double miss = std::abs(a.f[i] - 2.0 * b.f[i] + c.f[i]);
    if (miss > 0.0 && rates_[i] > 0.0) most = std::max(most, miss / rates_[i]);
  }
  return most;
}

void TimeJumps::search(Look from, Look to, const StateAt& state, std::vector<Jump>& found) {
  Look a = from, c = to;
  const auto between = [](const Look& left, const Look& right) {
    return left.t + 0.5 * (right.t - left.t);
  };
  const auto is_between = [&](const Look& left, const Look& right) {
    return left.t < between(left, right) && between(left, right) < right.t;
  };
  if (!is_between(a, c)) return;
  Look b = look(between(a, c), state);
  while (bend(a, b, c) > thresholds::least_bend) {
    if (!is_between(a, b) || !is_between(b, c)) {
      const bool first = (b.f - a.f).cwiseAbs().sum() > (c.f - b.f).cwiseAbs().sum();
      const Look &minus = first ? a : b, &plus = first ? b : c;
      found.push_back({minus.t, plus.t, minus.x, plus.x, plus.f - minus.f});
      if (found.size() >= thresholds::most_called_jumps) return;
      search(from, minus, state, found);
      return search(plus, to, state, found);
    }
    Look left = look(between(a, b), state), right = look(between(b, c), state);
    if (bend(a, left, b) > bend(b, right, c))
      c = std::move(b), b = std::move(left);
    else
      a = std::move(b), b = std::move(right);
  }
}

std::vector<TimeJumps::Jump> TimeJumps::within(double from, double to, const StateAt& state) {
  std::vector<Jump> found;
  search(look(from, state), look(to, state), state, found);
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
