// period_map: the linear map of a sampled system.
#include "saltus/analysis/period_map.hpp"

#include <algorithm>
#include <cmath>
#include <ostream>

#include "closing.hpp"
#include "multipliers.hpp"
#include "places.hpp"
#include "saltus/analysis/detail/thresholds.hpp"
#include "saltus/base/error.hpp"
#include "saltus/base/list.hpp"

namespace saltus {

namespace {

const std::string map_name = "period_map";

void require_inputs(const System& system, const Context& context,
                    const std::vector<std::string>& inputs) {
  for (const std::string& name : inputs) {
    if (open_port(system, name) >= 0)
      throw ModelError(text(map_name, ": '", name,
                            "' is an open input; connect a Constant to it, and name the parameter "
                            "of that"));
    const ContextEntry entry = find_entry(context.layout(), name);
    if (entry.kind != ContextEntry::Kind::parameter)
      throw ModelError(text(map_name, ": '", name, "' is a state; expected a parameter",
                            known_names(name, entry_names(context.layout()))));
  }
}

/// Refuses a mode that changes: the next period has another map.
void require_return(const Closing& closing, const Arc& arc) {
  const std::string changed = arc.unreturned(
      closing.states(), std::vector<bool>(static_cast<std::size_t>(closing.states().size())));
  if (!changed.empty())
    throw ModelError(text(map_name, ": t = ", arc.final.time(), " s: ", changed,
                          "; expected the same mode after one period: begin elsewhere, or give a "
                          "longer period"));
}

/// Refuses a period after which the same start leads elsewhere.
void require_same_map(Closing& closing, const Arc& arc) {
  const Arc other = closing.again(arc);
  const double growth = same_run * closing.growth(arc);
  const Eigen::VectorXd change = (other.end - arc.end).cwiseAbs()(closing.active());
  Eigen::VectorXd bound = growth * closing.scale(arc).array() + same_at_zero;
  // at rest the ends are the same after any time, and the derivatives are not
  const Eigen::VectorXd turned = closing.square(other.by_start - arc.by_start).rowwise().norm();
  bound = (turned.array() > growth).select(-1.0, bound);
  if ((change.array() <= bound.array()).all()) return;
  Index worst = 0;
  (change - bound).maxCoeff(&worst);
  throw ModelError(
      text(map_name, ": t = ", arc.final.time(), " s: the same start leads elsewhere ('",
           closing.states().name(nth(closing.active(), worst)), "') in the second ", arc.period,
           " s than in the first, so this is no period of the clocks; expected their "
           "sample time or a common multiple of it"));
}

/// C, D, y and the names of the outputs at the start.
void add_outputs(PeriodMap& map, const Closing& closing, const Arc& arc,
                 const RecordedSignals& signals, std::vector<std::string> names) {
  names.insert(names.begin(), closing.states().names().begin(), closing.states().names().end());
  const Results run = closing.runs().recorded(arc.begin, arc.begin.time(), names, signals);
  const auto p = static_cast<Index>(run.sensitivities.size()), n = closing.states().size();
  Index rows = 0;
  for (const RecordedSignal& signal : run.signals) rows += signal.shape.size;
  Eigen::MatrixXd by(rows, p);
  map.y.resize(rows);
  Index row = 0;
  for (std::size_t s = 0; s < run.signals.size(); ++s) {
    const RecordedSignal& signal = run.signals[s];
    const std::vector<double>& slopes = run.sensitivities.signals[s];
    for (Index i = 0; i < signal.shape.size; ++i, ++row) {
      const Index back = signal.shape.size - i;  // of the last row
      map.y[row] = *(signal.values.end() - back);
      for (Index k = 0; k < p; ++k) by(row, k) = *(slopes.end() - back * p + k);
      map.outputs.push_back(signal.name + entry_place(signal.shape, i));
    }
  }
  map.C = by(Eigen::all, closing.active()), map.D = by.rightCols(p - n);
}

void add_states(PeriodMap& map, const Closing& closing, const Arc& arc) {
  for (const Index i : closing.active()) map.states.push_back(closing.states().name(i));
  for (Index i = 0; i < closing.states().size(); ++i)
    if (nth(closing.labels(), i)) map.frozen.push_back({closing.states().name(i), arc.start[i]});
  map.x0 = RunStates::of(arc.begin)(closing.active());
  map.x1 = RunStates::of(arc.final)(closing.active());
}

}  // namespace

PeriodMap period_map(const System& system, const Context& context, double period,
                     const PeriodMapOptions& options) {
  if (!(period > 0.0 && std::isfinite(period)))
    throw ModelError(text(map_name, ": period: expected a positive time, found ", period));
  OrbitRuns runs(map_name, system, options.simulation);
  if (context.continuous_state().size() + context.discrete_state().size() == 0)
    throw ModelError(text(map_name, ": '", system.name(), "' has no states; expected some"));
  require_inputs(system, context, options.inputs);
  const std::unique_ptr<Closing> closing = closing_of_period(runs, context, period);
  const Arc arc = closing->at(closing->unknowns(), options.inputs);
  require_return(*closing, arc);
  closing->take_labels(arc);
  require_same_map(*closing, arc);
  PeriodMap map;
  map.Phi = closing->square(arc.monodromy);
  map.Gamma = arc.by_parameters(closing->active(), Eigen::all);
  map.period = period, map.context = arc.begin, map.size = closing->scale(arc);
  add_states(map, *closing, arc);
  map.inputs = arc.parameters;
  if (options.outputs) {
    add_outputs(map, *closing, arc, *options.outputs, options.inputs);
  } else {
    const auto n = static_cast<Index>(map.states.size());
    map.C = Eigen::MatrixXd::Identity(n, n);
    map.D = Eigen::MatrixXd::Zero(n, map.Gamma.cols());
    map.y = map.x0, map.outputs = map.states;
  }
  return map;
}

bool PeriodMap::is_fixed_point() const {
  return ((x1 - x0).cwiseAbs().array() <= closed_point * size.array()).all();
}

Eigen::VectorXcd PeriodMap::multipliers() const { return largest_first(Phi); }

Stability PeriodMap::stability() const {
  const Eigen::VectorXcd values = multipliers();
  if (values.size() == 0) return Stability::no_states;
  const double largest = values.cwiseAbs().maxCoeff();
  if (std::abs(largest - 1.0) <= multiplier_margin) return Stability::undecided;
  return largest < 1.0 ? Stability::stable : Stability::unstable;
}

std::ostream& operator<<(std::ostream& out, const PeriodMap& map) {
  const auto line = [&](std::string_view what, const std::vector<std::string>& names) {
    out << "  " << what << ": " << (names.empty() ? "none" : quoted(names)) << "\n";
  };
  out << "map over " << map.period << " s from t = " << map.context.time() << " s, at "
      << (map.is_fixed_point() ? "a fixed point" : "a moving state") << ", "
      << to_string(map.stability()) << "\n";
  line("states", map.states), line("inputs", map.inputs), line("outputs", map.outputs);
  for (const auto& one : map.multipliers())
    out << "  multiplier " << one << ", |.| = " << std::abs(one) << "\n";
  for (const NamedValue& label : map.frozen)
    out << "  frozen: " << label.name << " = " << label.value << "\n";
  return out;
}

}  // namespace saltus
