#include "saltus/simulation/detail/computed_derivatives.hpp"

#include "saltus/base/error.hpp"
#include "saltus/simulation/detail/kinks.hpp"
#include "saltus/tape/jacobian.hpp"
#include "saltus/tape/switches.hpp"

namespace saltus {

ParameterDirection ComputedDerivatives::by(Index of, const Eigen::VectorXd& p) {
  ParameterDirection found;
  if (!computed_) {
    found.moves = {{of, 1.0}};
    return found;
  }
  Eigen::VectorXd by = Eigen::VectorXd::Unit(p.size(), of);
  for (std::size_t i = 0; i < made_.size() && found.obstacle.empty(); ++i) {
    const ComputedParameter& one = computed_->all[i];
    if (!by.segment(one.from, one.count).isZero(0.0)) found.obstacle = add(i, p, by);
  }
  for (Index i = 0; i < by.size(); ++i)
    if (by[i] != 0.0) found.moves.push_back({i, by[i]});
  return found;
}

std::string ComputedDerivatives::add(std::size_t number, const Eigen::VectorXd& p,
                                     Eigen::VectorXd& by) {
  const ComputedParameter& one = computed_->all[number];
  const Partials& of = partials(number);
  Eigen::VectorXd values(of.tape.size());
  of.tape.evaluate(at_parameters(p.data() + one.from, one.count), values.data());
  Eigen::VectorXd moved = Eigen::VectorXd::Zero(one.size);
  for (std::size_t e = 0; e < of.entries.size(); ++e) {
    const auto [row, variable] = of.entries[e];
    const double of_variable = by[one.from + variable];
    if (of_variable != 0.0) moved[row] += values[one.size + static_cast<Index>(e)] * of_variable;
  }
  if (!moved.allFinite())
    return text("parameter '", one.name, "', which the diagram computes, has no finite derivative");
  const double* switches = values.data() + one.size + static_cast<Index>(of.entries.size());
  if (has_switch_at_limit(switches, of.switches) && bends(number, p, by))
    return text("parameter '", one.name, "', which the diagram computes, has a kink or a jump");
  by.segment(one.to, one.size) += moved;
  return {};
}

/// Whether values and derivatives differ on both sides, in the direction in which the variables move.
bool ComputedDerivatives::bends(std::size_t number, const Eigen::VectorXd& p,
                                const Eigen::VectorXd& by) {
  const ComputedParameter& one = computed_->all[number];
  const Partials& of = partials(number);
  const auto here = p.segment(one.from, one.count), along = by.segment(one.from, one.count);
  const auto values_at = [&](double shift) -> Eigen::ArrayXd {
    const Eigen::VectorXd moved = here + shift * along;
    Eigen::VectorXd values(of.tape.size());
    of.tape.evaluate(at_parameters(moved.data(), one.count), values.data());
    return values.head(one.size + static_cast<Index>(of.entries.size())).array();
  };
  const double length = along.cwiseAbs().maxCoeff();
  const double size = (along.array() != 0.0).select(here.array(), 0.0).abs().maxCoeff();
  return has_kink(values_at, (size == 0.0 ? 1.0 : size) / length);
}

const ComputedDerivatives::Partials& ComputedDerivatives::partials(std::size_t number) {
  std::optional<Partials>& made = made_[number];
  if (made) return *made;
  const ComputedParameter& one = computed_->all[number];
  tape::Graph graph = one.values.graph();
  const std::vector<tape::Node> rows = one.values.outputs();
  std::vector<tape::Node> variables, values = rows;
  for (Index i = 0; i < one.count; ++i) variables.push_back(graph.parameter(i));
  const std::vector<tape::Node> switches = tape::switches_of(graph, rows);
  std::vector<std::pair<Index, Index>> entries;
  for (const tape::Partial& partial : tape::differentiate(graph, rows, variables)) {
    entries.emplace_back(partial.row, partial.column);
    values.push_back(partial.value);
  }
  values.insert(values.end(), switches.begin(), switches.end());
  const auto count = static_cast<Index>(switches.size()) / tape::numbers_of_switch;
  return made.emplace(Partials{std::move(entries), count, tape::Tape(graph, values)});
}

}  // namespace saltus
