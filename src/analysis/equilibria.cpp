// equilibria: searches from many starts, and each point once.
#include "saltus/analysis/equilibria.hpp"

#include <algorithm>
#include <cmath>

#include "saltus/analysis/detail/thresholds.hpp"
#include "saltus/base/error.hpp"
#include "saltus/base/list.hpp"
#include "trim_question.hpp"

namespace saltus {

namespace {

const std::string equilibria_name = "equilibria";

/// The free values as trim takes them.
std::vector<FreeValue> frees_of(const EquilibriaOptions& options) {
  if (options.box.empty() == options.starts.empty())
    throw ModelError(text(equilibria_name, ": expected a box or a list of starts, found ",
                          options.box.empty() ? "neither" : "both"));
  if (options.box.empty()) {
    std::vector<FreeValue> frees;
    for (const NamedValue& one : options.starts.front())
      frees.push_back({.name = one.name, .start = one.value});
    return frees;
  }
  if (options.count < 1)
    throw ModelError(
        text(equilibria_name, ": count: expected 1 or more starts, found ", options.count));
  if (!std::isfinite(options.seed))
    throw ModelError(
        text(equilibria_name, ": seed: expected a finite number, found ", options.seed));
  for (const FreeValue& free : options.box)
    if (!std::isfinite(free.lower) || !std::isfinite(free.upper))
      throw ModelError(text(equilibria_name, ": box: '", free.name,
                            "': expected finite bounds, found ", free.lower, " and ", free.upper));
  return options.box;
}

/// The values of one start, in the order of the first.
Eigen::VectorXd values_of(const std::vector<NamedValue>& start,
                          const std::vector<FreeValue>& frees) {
  const auto n = static_cast<Index>(frees.size());
  Eigen::VectorXd values(n);
  for (Index k = 0; k < n; ++k) {
    const std::string& name = nth(frees, k).name;
    const auto found = std::ranges::find(start, name, &NamedValue::name);
    if (found == start.end() || start.size() != frees.size())
      throw ModelError(text(equilibria_name, ": starts: expected the same names in each, '", name,
                            "' and others"));
    values[k] = found->value;
  }
  return values;
}

bool same(const OperatingPoint& one, const OperatingPoint& other) {
  for (std::size_t k = 0; k < one.values.size(); ++k) {
    const double a = one.values[k].value, b = other.values[k].value;
    const double size = std::max(std::abs(a), std::abs(b));
    if (!(std::abs(a - b) <= same_point * (size > same_point ? size : 1.0))) return false;
  }
  return true;
}

bool before(const OperatingPoint& one, const OperatingPoint& other) {
  return std::ranges::lexicographical_compare(one.values, other.values, {}, &NamedValue::value,
                                              &NamedValue::value);
}

void search_from(TrimQuestion& question, const Eigen::VectorXd& start, Equilibria& found) {
  ++found.starts;
  try {
    OperatingPoint point = question.answer(start);
    if (!point.success())
      found.failures.push_back(point.message);
    else if (std::ranges::none_of(found.points,
                                  [&](const auto& known) { return same(point, known); }))
      found.points.push_back(std::move(point));
  } catch (const ModelError& error) {
    found.failures.emplace_back(error.what());
  }
}

}  // namespace

Equilibria equilibria(const System& system, const Context& context,
                      const EquilibriaOptions& options) {
  const std::vector<FreeValue> frees = frees_of(options);
  TrimQuestion question = trim_question(equilibria_name, system, context,
                                        {.free = frees,
                                         .hold = options.hold,
                                         .derivatives = options.derivatives,
                                         .outputs = options.outputs,
                                         .tolerance = options.tolerance,
                                         .max_nfev = options.max_nfev,
                                         .refinement = options.refinement});
  std::vector<Eigen::VectorXd> starts;
  for (const auto& start : options.starts) starts.push_back(values_of(start, frees));
  if (starts.empty())
    starts = detail::latin_hypercube(question.bounds.lower, question.bounds.upper, options.count,
                                     options.seed);
  Equilibria found;
  for (const Eigen::VectorXd& start : starts) search_from(question, start, found);
  std::ranges::sort(found.points, before);
  return found;
}

}  // namespace saltus
