// periodic_orbit: the search, and its result.
#include "saltus/analysis/periodic_orbit.hpp"

#include <algorithm>
#include <cmath>

#include "multipliers.hpp"
#include "orbit_newton.hpp"
#include "places.hpp"
#include "saltus/analysis/detail/thresholds.hpp"
#include "saltus/base/error.hpp"
#include "saltus/base/list.hpp"

namespace saltus {

namespace {

const std::string orbit_name = "periodic_orbit";

void require_positive(std::string_view name, double value) {
  if (value > 0.0 && std::isfinite(value)) return;
  throw ModelError(text(orbit_name, ": ", name, ": expected a positive number, found ", value));
}

void require_count(std::string_view name, int value) {
  if (value >= 1) return;
  throw ModelError(
      text(orbit_name, ": ", name, ": expected an integer of 1 or more, found ", value));
}

void require_arguments(const PeriodicOrbitOptions& options) {
  require_positive("period", options.period.value_or(1.0));
  require_positive("max_period", options.max_period);
  require_positive("tolerance", options.tolerance);
  require_count("firings", options.firings);
  require_count("max_iterations", options.max_iterations);
  if (!(options.transient >= 0.0 && std::isfinite(options.transient)))
    throw ModelError(
        text(orbit_name, ": transient: expected a time of 0 s or more, found ", options.transient));
  if (!options.section.empty() && options.period)
    throw ModelError(
        text(orbit_name, ": expected a section or a period, found both; leave one out"));
  if (options.section.empty() && options.firings != 1)
    throw ModelError(text(orbit_name, ": firings = ", options.firings,
                          " counts those of a section; give its name"));
}

void require_parameters(const Context& context, const std::vector<std::string>& wrt) {
  for (const std::string& name : wrt) {
    const ContextEntry entry = entry_in(orbit_name + ": wrt", context, name);
    if (entry.kind != ContextEntry::Kind::parameter)
      throw ModelError(text(orbit_name, ": wrt: '", name,
                            "' is a start value, which the search finds; expected a parameter"));
  }
}

std::unique_ptr<Closing> closing_of(OrbitRuns& runs, const Context& start,
                                    const PeriodicOrbitOptions& options) {
  if (start.continuous_state().size() + start.discrete_state().size() == 0)
    throw ModelError(text(orbit_name, ": '", runs.system().name(),
                          "' has no states; expected some that return"));
  if (!options.section.empty())
    return closing_of_section(runs, start, options.section, options.firings, options.max_period);
  if (options.period) return closing_of_period(runs, start, *options.period);
  const auto [at, guess] = guess_period(runs, start, options.max_period);
  return closing_of_free_period(runs, at, guess);
}

/// Refuses a system that does not do the same at another time.
void require_same_orbit(Closing& closing, const Arc& arc) {
  const Arc other = closing.again(arc);
  const double growth = same_run * closing.growth(arc);
  const Eigen::VectorXd bound = growth * closing.sizes(arc)(closing.active());
  const Eigen::VectorXd change = (other.end - arc.end).cwiseAbs()(closing.active());
  const bool moved = std::abs(other.period - arc.period) > growth * arc.period;
  if (!moved && (change.array() <= bound.array()).all() && arc.final.modes() == other.final.modes())
    return;
  Index worst = 0;
  (change - bound).maxCoeff(&worst);
  const std::string& name = closing.states().name(nth(closing.active(), worst));
  const double time = other.begin.time();
  if (closing.autonomous())
    throw ModelError(text(orbit_name, ": t = ", time, " s: the same start leads elsewhere ('", name,
                          "') than at t = ", arc.begin.time(),
                          " s, so the time moves the system; expected an autonomous one: give the "
                          "period of the drive"));
  throw ModelError(text(orbit_name, ": t = ", time, " s: '", name, "' returns after the first ",
                        arc.period,
                        " s and not after the second, so this is no period of the drive; expected "
                        "its period or a multiple of it"));
}

/// The derivatives of start and period by parameters; with the exception if there are none.
PeriodicOrbit::ByParameters derivatives_by(Closing& closing, const OrbitFound& found,
                                           const Context& at, bool isolated,
                                           std::vector<std::string>& wrt) {
  PeriodicOrbit::ByParameters by;
  if (wrt.empty() || found.status != SearchStatus::converged) return by;
  Eigen::VectorXd unknowns(static_cast<Index>(closing.active().size()) + 1);
  unknowns << found.arc.start(closing.active()), found.arc.period;
  const Arc full = closing.arc(found.arc.begin, unknowns, wrt);
  wrt = full.parameters;  // a vector has a name for each entry
  try {
    if (!isolated)
      throw SimulationError(text(orbit_name, ": t = ", at.time(),
                                 " s: a multiplier is 1, so the orbit is one of many and has no "
                                 "derivative by a parameter; expected an isolated orbit"),
                            at.time());
    const auto [start, period] = closing.implicit(full, wrt);
    by.x0 = closing.to_orbit(at, wrt, start).topRows(closing.states().continuous());
    by.period = period;
  } catch (const Error&) {
    by.none = std::current_exception();
  }
  return by;
}

std::vector<std::string> continuous_of(const RunStates& states) {
  return {states.names().begin(), states.names().begin() + states.continuous()};
}

PeriodicOrbit orbit_of(Closing& closing, OrbitFound found, const PeriodicOrbitOptions& options) {
  const Arc& arc = found.arc;
  PeriodicOrbit orbit;
  orbit.status = found.status, orbit.iterations = found.iterations;
  if (orbit.success() && !found.message.empty()) orbit.notes.push_back(found.message);
  if (!orbit.success()) orbit.message = found.message;
  orbit.context = closing.on_orbit(arc);
  orbit.x0 = orbit.context.continuous_state();
  orbit.names = continuous_of(closing.states());
  orbit.period = arc.period;
  const Multipliers spectrum = multipliers_of(closing, arc);
  orbit.multipliers = spectrum.values, orbit.trivial = spectrum.trivial;
  if (orbit.success())
    orbit.notes.insert(orbit.notes.end(), spectrum.notes.begin(), spectrum.notes.end());
  else
    orbit.multipliers.setConstant(std::numeric_limits<double>::quiet_NaN());
  orbit.monodromy = closing.square(arc.monodromy), orbit.return_map = closing.square(arc.by_start);
  orbit.residual = (arc.end - arc.start).cwiseAbs().maxCoeff();
  orbit.parameters = options.wrt;
  orbit.by_parameters =
      derivatives_by(closing, found, orbit.context, spectrum.isolated, orbit.parameters);
  orbit.results = closing.runs().dense(orbit.context, orbit.context.time() + arc.period,
                                       options.recorded_signals);
  return orbit;
}

}  // namespace

PeriodicOrbit periodic_orbit(const System& system, const Context& context,
                             const PeriodicOrbitOptions& options) {
  OrbitRuns runs(orbit_name, system, options.simulation);
  require_arguments(options);
  require_parameters(context, options.wrt);
  const Context start = options.transient > 0.0
                            ? runs.plain(context, context.time() + options.transient).context
                            : context;
  const std::unique_ptr<Closing> closing = closing_of(runs, start, options);
  if (closing->autonomous()) require_same_orbit(*closing, closing->at(closing->unknowns()));
  OrbitFound found = search_orbit(*closing, options.tolerance, options.max_iterations);
  if (found.status == SearchStatus::converged && !closing->autonomous())
    require_same_orbit(*closing, found.arc);
  return orbit_of(*closing, std::move(found), options);
}

std::optional<bool> PeriodicOrbit::stable() const {
  if (!success()) return {};
  const double largest = multipliers.size() > 0 ? multipliers.cwiseAbs().maxCoeff() : 0.0;
  if (std::abs(largest - 1.0) <= multiplier_margin) return {};
  return largest < 1.0;
}

Index PeriodicOrbit::parameter(std::string_view name) const {
  if (!success())
    throw SimulationError(text(orbit_name, ": no orbit was found (status '", to_string(status),
                               "': ", message, "), so it has no derivative"),
                          context.time());
  const auto found = std::ranges::find(parameters, name);
  if (found == parameters.end())
    throw ModelError(
        text("'", name, "' was not among the parameters of wrt", known_names(name, parameters)));
  if (by_parameters.none) std::rethrow_exception(by_parameters.none);
  return found - parameters.begin();
}

double PeriodicOrbit::dperiod(std::string_view name) const {
  const Index k = parameter(name);
  return by_parameters.period[k];
}

Eigen::VectorXd PeriodicOrbit::dx0(std::string_view name) const {
  const Index k = parameter(name);
  return by_parameters.x0.col(k);
}

std::ostream& operator<<(std::ostream& out, const PeriodicOrbit& orbit) {
  const std::optional<bool> stable = orbit.stable();
  out << "periodic orbit: " << to_string(orbit.status) << " after " << orbit.iterations
      << " Newton steps, "
      << (!stable   ? "stability undecided"
          : *stable ? "stable"
                    : "unstable")
      << "\n  period " << orbit.period << " s, residual " << orbit.residual << "\n";
  for (Index i = 0; i < orbit.x0.size(); ++i)
    out << "  " << nth(orbit.names, i) << " = " << orbit.x0[i] << "\n";
  for (const auto& one : orbit.multipliers)
    out << "  multiplier " << one << ", |.| = " << std::abs(one) << "\n";
  if (!orbit.message.empty()) out << "  " << orbit.message << "\n";
  for (const std::string& note : orbit.notes) out << "  " << note << "\n";
  return out;
}

}  // namespace saltus
