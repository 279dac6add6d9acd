// The equations whose solution is a periodic orbit.
#include "closing.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/LU>

#include "saltus/analysis/detail/thresholds.hpp"
#include "saltus/base/error.hpp"
#include "saltus/base/list.hpp"

namespace saltus {

namespace {

bool is_whole(double value) { return std::fmod(value, 1.0) == 0.0; }

}  // namespace

std::string Arc::unreturned(const RunStates& states, const std::vector<bool>& labels) const {
  for (std::size_t b = 0; b < states.blocks().size(); ++b) {
    const int old = begin.modes()[b], now = final.modes()[b];
    if (old != now)
      return text("the mode of '", states.blocks()[b], "' did not return: it went from ", old,
                  " to ", now);
  }
  for (Index i = 0; i < states.size(); ++i)
    if (nth(labels, i) && start[i] != end[i])
      return text("the discrete state '", states.name(i), "' did not return: it went from ",
                  start[i], " to ", end[i]);
  return {};
}

Closing::Closing(OrbitRuns& runs, const Context& context) : runs_(runs), states_(context) {
  begin_at(context);
  set_labels(std::vector<bool>(static_cast<std::size_t>(states_.size()), false));
}

void Closing::begin_at(const Context& context) {
  base_ = context, values_ = RunStates::of(context);
}

void Closing::set_labels(std::vector<bool> labels) {
  labels_ = std::move(labels);
  active_.clear();
  for (Index i = 0; i < states_.size(); ++i)
    if (!nth(labels_, i)) active_.push_back(i);
}

Context Closing::start(const Eigen::VectorXd& unknowns) const {
  Eigen::VectorXd values = values_;
  values(active_) = unknowns.head(static_cast<Index>(active_.size()));
  return states_.put(base_, values);
}

std::vector<std::string> Closing::names_with(const std::vector<std::string>& parameters) const {
  std::vector<std::string> names = states_.names();
  names.insert(names.end(), parameters.begin(), parameters.end());
  return names;
}

Eigen::VectorXd Closing::residual(const Arc& arc) const { return (arc.end - arc.start)(active_); }

Eigen::MatrixXd Closing::matrix(const Arc& arc) const {
  Eigen::MatrixXd matrix = square(arc.by_start);
  matrix.diagonal().array() -= 1.0;
  return matrix;
}

Eigen::VectorXd Closing::sizes(const Arc& arc) const {
  constexpr double turn = 6.283185307179586;
  return arc.start.cwiseAbs().cwiseMax(arc.end.cwiseAbs()) +
         arc.flow_start.cwiseAbs() * (arc.period / turn);
}

double Closing::growth(const Arc& arc) const { return std::max(1.0, square(arc.by_start).norm()); }

std::pair<Eigen::MatrixXd, Eigen::VectorXd> Closing::implicit(
    const Arc& arc, const std::vector<std::string>& /*parameters*/) {
  const Eigen::MatrixXd right = -active_rows(arc.by_parameters);
  const Eigen::MatrixXd by = matrix(arc).partialPivLu().solve(right);
  Eigen::MatrixXd start = Eigen::MatrixXd::Zero(states_.size(), by.cols());
  start(active_, Eigen::all) = by;
  const Eigen::VectorXd along = arc.period_by_start(active_);
  return {start, by.transpose() * along + arc.period_by_parameters};
}

Arc Closing::again(const Arc& arc) {
  const Context shifted = base_.with_time(base_.time() + elsewhere * arc.period);
  const auto m = static_cast<Index>(active_.size());
  Eigen::VectorXd unknowns(m + 1);
  unknowns << arc.start(active_), arc.period;
  return this->arc(states_.put(shifted, arc.start), unknowns, {});
}

void Closing::move_to_end(const Arc& arc) { base_ = arc.final, values_ = arc.end; }

void Closing::take_labels(const Arc& arc) {
  std::vector<bool> whole(static_cast<std::size_t>(states_.size()), false);
  for (Index i = states_.continuous(); i < states_.size(); ++i)
    whole[static_cast<std::size_t>(i)] = is_whole(arc.start[i]) && is_whole(arc.end[i]);
  std::vector<bool> labels = whole;
  for (Index i = 0; i < states_.size(); ++i)
    for (Index k = 0; k < states_.size(); ++k)
      if (!nth(whole, k) && arc.by_start(i, k) != 0.0) labels[static_cast<std::size_t>(i)] = false;
  set_labels(std::move(labels));
}

Arc Closing::made(const Context& start, const Results& results, double period, double moved,
                  const Eigen::VectorXd& times) const {
  const Index n = states_.size();
  const auto count = static_cast<Index>(results.sensitivities.size());
  const Eigen::MatrixXd by = derivatives_of(results);
  const Eigen::VectorXd along = times.size() > 0 ? times : Eigen::VectorXd::Zero(count);
  require(results, by, along);
  Arc arc;
  arc.flow_start = runs_.flow(start), arc.flow_end = runs_.flow(results.context);
  const Eigen::MatrixXd total = by + arc.flow_end * along.transpose();
  arc.start = RunStates::of(start);
  arc.end = RunStates::of(results.context) + moved * arc.flow_end;
  arc.period = period;
  arc.monodromy = by.leftCols(n), arc.by_start = total.leftCols(n);
  arc.by_parameters = total.rightCols(count - n);
  arc.period_by_start = along.head(n), arc.period_by_parameters = along.tail(count - n);
  arc.begin = start, arc.final = results.context;
  const auto& known = results.sensitivities.parameters;
  arc.parameters.assign(known.begin() + n, known.end());
  return arc;
}

void Closing::require(const Results& results, const Eigen::MatrixXd& by,
                      const Eigen::VectorXd& times) const {
  const auto& known = results.sensitivities.parameters;
  std::vector<std::string> names;
  std::vector<Index> read;
  for (Index k = 0; k < by.cols(); ++k) {
    const bool discrete = k >= states_.continuous() && k < states_.size();
    if (discrete && is_whole(values_[k])) continue;
    read.push_back(k), names.push_back(nth(known, k));
  }
  Eigen::MatrixXd all(by.rows() + 1, by.cols());
  all << by, times.transpose();
  refuse_gap(runs_.where(), results, names, all(Eigen::all, read));
}

}  // namespace saltus
