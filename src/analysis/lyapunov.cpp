// lyapunov: the arguments, and the spectrum of a walk.
#include "saltus/analysis/lyapunov.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <ostream>

#include "averages.hpp"
#include "growth_walk.hpp"
#include "saltus/analysis/detail/thresholds.hpp"
#include "saltus/base/error.hpp"
#include "saltus/base/list.hpp"

namespace saltus {

namespace {

const std::string exponents_name = "lyapunov";

void require_above_zero(std::string_view name, double value) {
  if (value > 0.0 && std::isfinite(value)) return;
  throw ModelError(text(exponents_name, ": ", name, ": expected a positive number, found ", value));
}

void require_numbers(const LyapunovOptions& options) {
  require_above_zero("time", options.time);
  require_above_zero("every", options.every.value_or(1.0));
  require_above_zero("tolerance", options.tolerance);
  if (!(options.transient >= 0.0 && std::isfinite(options.transient)))
    throw ModelError(text(exponents_name, ": transient: expected a time of 0 s or more, found ",
                          options.transient));
}

void require_directions(std::optional<int> count, Index most, const System& system) {
  if (most == 0)
    throw ModelError(
        text(exponents_name, ": '", system.name(), "' has no states; expected some that move"));
  if (count && !(*count >= 1 && *count <= most))
    throw ModelError(text(exponents_name, ": count: expected an integer from 1 to ", most,
                          ", the number of states, found ", *count));
}

/// Refuses a start at rest: the derivatives of a run take it for free.
void require_moving(const Context& start, const RunStates& states) {
  const std::vector<std::string> resting = at_rest(start, states);
  if (!resting.empty())
    throw ModelError(text(exponents_name, ": t = ", start.time(), " s: ", quoted(resting),
                          " is at rest at the start; expected a state in motion: begin elsewhere, "
                          "or give another transient"));
}

/// Which exponent is known worst, if that is not well enough: each one is compared with its own size,
/// and one that may be zero with the smallest that is not.
std::string unconverged(const Eigen::VectorXd& exponents, const Eigen::VectorXd& errors,
                        double time, double tolerance) {
  double least = std::numeric_limits<double>::infinity();
  for (Index k = 0; k < exponents.size(); ++k) {
    const double size = std::abs(exponents[k]);
    if (std::isfinite(size) && size > 2.0 * errors[k] && size > resolved_growth / time)
      least = std::min(least, size);
  }
  if (!std::isfinite(least)) least = 1.0 / time;
  Index worst = 0;
  double excess = -1.0, bound = 0.0;
  for (Index k = 0; k < exponents.size(); ++k) {
    const double size = std::abs(exponents[k]);
    const double allowed = tolerance * (std::isfinite(size) ? std::max(size, least) : least);
    if (errors[k] / allowed > excess) excess = errors[k] / allowed, worst = k, bound = allowed;
  }
  if (errors[worst] <= bound) return {};
  return text("exponent ", worst, " has the standard error ", errors[worst],
              " 1/s; expected at most ", bound, " 1/s: give a longer time, or a larger tolerance");
}

LyapunovSpectrum spectrum_of(const Growth& growth, const Pieces& pieces, double begin,
                             double tolerance) {
  const Index n = growth.durations.size() - growth.aligned;
  const Eigen::VectorXd durations = growth.durations.tail(n);
  const Eigen::MatrixXd logs = growth.logs.bottomRows(n);
  const Eigen::MatrixXd history = running_means(durations, logs);
  const Eigen::VectorXd errors = standard_errors(durations, logs);
  std::vector<Index> order(static_cast<std::size_t>(logs.cols()));
  std::iota(order.begin(), order.end(), Index{0});
  std::ranges::stable_sort(order, std::ranges::greater(),
                           [&](Index k) { return history(n - 1, k); });
  LyapunovSpectrum found;
  found.history = history(Eigen::all, order), found.errors = errors(order);
  found.exponents = found.history.row(n - 1);
  found.message = unconverged(found.exponents, found.errors, durations.sum(), tolerance);
  found.converged = found.message.empty();
  found.begin = begin + growth.durations.head(growth.aligned).sum();
  found.times.resize(n);
  std::partial_sum(durations.begin(), durations.end(), found.times.begin());
  found.times.array() += found.begin;
  found.states = pieces.names(), found.context = growth.end;
  const Eigen::VectorXd values = RunStates::of(growth.end);
  for (Index i = 0; i < values.size(); ++i)
    if (nth(pieces.labels(), i)) found.frozen.push_back({pieces.states().name(i), values[i]});
  return found;
}

/// Whole numbers among the discrete states: labels, until a run shows that they are none.
std::vector<bool> possible_labels(const Context& start, const RunStates& states) {
  const Eigen::VectorXd values = RunStates::of(start);
  std::vector<bool> labels(static_cast<std::size_t>(states.size()), false);
  for (Index i = states.continuous(); i < states.size(); ++i)
    labels[static_cast<std::size_t>(i)] = std::fmod(values[i], 1.0) == 0.0;
  return labels;
}

}  // namespace

LyapunovSpectrum lyapunov(const System& system, const Context& context,
                          const LyapunovOptions& options) {
  require_numbers(options);
  OrbitRuns runs(exponents_name, system, options.simulation);
  const Context start = runs.plain(context, context.time() + options.transient).context;
  const RunStates states(start);
  require_moving(start, states);
  require_directions(options.count, states.size(), system);
  const double longest =
      std::min(options.time / least_pieces, options.every.value_or(options.time));
  std::vector<bool> labels = possible_labels(start, states);
  while (true) {  // it begins anew where a label turns out to be none
    Pieces pieces(runs, start, labels);
    const auto active = static_cast<Index>(pieces.active().size());
    if (options.count) require_directions(options.count, active, system);
    const auto growth =
        walk(pieces, start, options.time, longest, options.count ? Index{*options.count} : active);
    if (growth) return spectrum_of(*growth, pieces, start.time(), options.tolerance);
    labels = pieces.labels();
  }
}

double LyapunovSpectrum::dimension() const {
  double sum = 0.0;
  for (Index k = 0; k < exponents.size(); ++k) {
    const double value = std::abs(exponents[k]) <= 2.0 * errors[k] ? 0.0 : exponents[k];
    if (!(sum + value >= 0.0))
      return static_cast<double>(k) + (k == 0 ? 0.0 : sum / std::abs(value));
    sum += value;
  }
  return static_cast<double>(exponents.size());
}

std::ostream& operator<<(std::ostream& out, const LyapunovSpectrum& spectrum) {
  out << "Lyapunov exponents to t = " << spectrum.context.time()
      << " s: " << (spectrum.converged ? "converged" : "not converged") << "\n";
  for (Index k = 0; k < spectrum.exponents.size(); ++k)
    out << "  " << spectrum.exponents[k] << " +- " << spectrum.errors[k] << " 1/s\n";
  out << "  sum " << spectrum.sum() << " 1/s, dimension " << spectrum.dimension() << "\n";
  if (!spectrum.message.empty()) out << "  " << spectrum.message << "\n";
  return out;
}

}  // namespace saltus
