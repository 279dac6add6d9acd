// FlowTerms: chosen at an instant, evaluated at each stage.
#include "saltus/simulation/detail/flow_terms.hpp"

#include <algorithm>

#include "saltus/solver/detail/lane.hpp"

namespace saltus {

namespace {

/// to += value from, for m columns, in pairs.
void add_row(double value, const double* from, Index m, double* to) {
  Index k = 0;
  for (; k + 1 < m; k += 2) {
    const detail::Lane<2> sum = detail::load<2>(to + k) + value * detail::load<2>(from + k);
    detail::store<2>(to + k, sum);
  }
  if (k < m) to[k] += value * from[k];
}

}  // namespace

void FlowTerms::choose(const TangentColumns& columns) {
  using Variable = TangentFlow::Variable;
  n_ = columns.x.rows(), m_ = columns.size();
  by_state_.clear(), fixed_.clear();
  Index value = -1;
  for (const auto& [row, kind, index] : flow_->rate_entries()) {
    ++value;
    if (machine_->resting().rests(row)) continue;
    const Index to = row * m_;
    const auto add = [&](Index k, double weight) {
      if (weight != 0.0) fixed_.push_back({value, to + k, weight});
    };
    if (kind == Variable::x) by_state_.push_back({value, to, index * m_});
    for (Index k = 0; k < m_ && kind == Variable::z; ++k) add(k, columns.z(index, k));
    for (Index k = 0; k < m_ && kind == Variable::y; ++k) add(k, columns.y(index, k));
    if (kind != Variable::p) continue;
    for (const auto& column : columns.by_entry(index)) add(column.number, column.by);
  }
}

void FlowTerms::watch(bool continues) {
  crossed_ = false;
  if (continues)
    branches_ = at_end_;
  else
    branches_.clear();
}

void FlowTerms::go_to(double t, const double* x) {
  values_ = flow_->rates_at(t, x);
  if (!flow_->has_switches()) return;
  flow_->branches_at(t, x, now_);
  if (branches_.empty()) branches_ = now_;
  crossed_ = crossed_ || branches_ != now_;
}

void FlowTerms::apply(const double* s, double* ds) const {
  std::fill_n(ds, n_ * m_, 0.0);
  if (m_ == 1) {
    for (const auto& [value, to, from] : by_state_) ds[to] += values_[value] * s[from];
  } else {
    for (const auto& [value, to, from] : by_state_) add_row(values_[value], s + from, m_, ds + to);
  }
  for (const auto& [value, to, weight] : fixed_) ds[to] += values_[value] * weight;
}

}  // namespace saltus
