// TangentFlow: the branches of its comparisons, steps and remainders.
#include <cmath>

#include "saltus/simulation/detail/tangent_flow.hpp"

namespace saltus {

namespace {

/// Rounding, in parts of a residual's terms and of their movement in a rounding of the values.
constexpr double limit_rounding = 1e3 * thresholds::eps;

}  // namespace

bool is_at_limit(const double* numbers, const GuardTangent& residual, double t, const double* x) {
  double terms = numbers[2] + std::abs(residual.by_time * t);
  for (Index i = 0; i < residual.by_state.size(); ++i)
    terms += std::abs(residual.by_state[i] * x[i]);
  return std::abs(numbers[0] - numbers[1]) <= limit_rounding * terms;
}

void TangentFlow::branches_at(double t, const double* x, std::vector<double>& branches) {
  branches.clear();
  if (!switches_) return;
  const double* numbers = switches_at(t, x);
  for (Index k = 0; k < switches_->size(); k += tape::numbers_of_switch) {
    const double branch = numbers[k + tape::numbers_of_switch - 1];
    branches.push_back(std::isnan(branch) ? 0.0 : branch);
  }
}

const double* TangentFlow::switches_at(double t, const double* x) {
  switch_values_.resize(switches_->size());
  variables_.at(t, x, [&](const At& at) { switches_->evaluate(at, switch_values_.data()); });
  return switch_values_.data();
}

/// Makes what is needed where a branch changes, which most runs never ask for.
TangentFlow::Switched& TangentFlow::switched() {
  if (switched_) return *switched_;
  const Plan& plan = machine_->plan();
  FlowGraph flow = flow_graph(plan);
  const std::vector<tape::Node> rates(flow.rates.begin(), flow.rates.end());
  const std::vector<tape::Node> numbers = tape::switches_of(flow.graph, rates);
  tape::Tape values(flow.graph, rates);
  return switched_.emplace(Switched{std::move(values), residuals(flow.graph, numbers)});
}

Eigen::VectorXd TangentFlow::rates_of_branch(double t, const double* x) {
  Eigen::VectorXd rates(machine_->plan().nx);
  variables_.at(t, x, [&](const At& at) { switched().rates.evaluate(at, rates.data()); });
  for (Index i = 0; i < rates.size(); ++i)
    if (machine_->resting().rests(i)) rates[i] = 0.0;
  return rates;
}

TangentFlow::GuardSwitches* TangentFlow::switches_of_guard(Index slot) {
  if (functions_ != machine_->functions()) make();
  const auto [place, is_new] = guard_switches_.try_emplace(slot);
  std::optional<GuardSwitches>& found = place->second;
  if (is_new && nth(row_of_slot_, slot) >= 0) {
    FlowGraph flow = flow_graph(machine_->plan());
    const tape::Node guard = *flow.guards[slot];
    const std::vector<tape::Node> numbers = tape::switches_of(flow.graph, {&guard, 1});
    if (!numbers.empty()) {
      tape::Tape values(flow.graph, numbers);
      found.emplace(GuardSwitches{std::move(values), residuals(flow.graph, numbers)});
    }
  }
  return found ? &*found : nullptr;
}

/// The derivatives of a - b of switches with these numbers.
TangentFlow::Partials TangentFlow::residuals(tape::Graph& graph,
                                             const std::vector<tape::Node>& numbers) const {
  std::vector<tape::Node> rows;
  for (std::size_t k = 0; k < numbers.size(); k += tape::numbers_of_switch)
    rows.push_back(graph.binary(tape::Op::sub, numbers[k], numbers[k + 1]));
  return partials(graph, rows, true);
}

}  // namespace saltus
