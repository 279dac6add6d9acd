// FreeValue: its checks, its start, and starts that are drawn.
#include "saltus/analysis/free_value.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "saltus/base/error.hpp"
#include "saltus/base/ids.hpp"
#include "saltus/base/list.hpp"
#include "saltus/base/philox.hpp"

namespace saltus {

std::string_view to_string(SearchStatus status) {
  constexpr std::string_view names[] = {"converged", "max_nfev",    "max_iterations",
                                        "stalled",   "interrupted", "failed"};
  return nth(names, status);
}

namespace detail {

namespace {

[[noreturn]] void refuse(const std::string& where, const FreeValue& free, const std::string& what) {
  throw ModelError(text(where, ": '", free.name, "': ", what));
}

void require_possible_start(const std::string& where, const FreeValue& free) {
  if (!free.start) return;
  if (!std::isfinite(*free.start))
    refuse(where, free, text("expected a finite start value, found ", *free.start));
  if (*free.start < free.lower || *free.start > free.upper)
    refuse(where, free,
           text("the start value ", *free.start, " is outside of the bounds ", free.lower, " to ",
                free.upper, "; change one of them"));
  if (free.log && *free.start <= 0.0)
    refuse(where, free, text("log needs a start value above 0, found ", *free.start));
}

/// The number of each start's part, in an order by random keys.
std::vector<int> shuffled_parts(int count, double seed, Index column) {
  std::vector<double> keys(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) nth(keys, i) = uniform(random_words(seed, i, 2 * column));
  std::vector<int> parts(keys.size());
  std::iota(parts.begin(), parts.end(), 0);
  std::ranges::sort(parts, {}, [&](int i) { return nth(keys, i); });
  return parts;
}

}  // namespace

void require_possible(const std::string& where, const FreeValue& free) {
  if (!(free.lower < free.upper))
    refuse(where, free,
           text("expected a lower bound below the upper bound, found ", free.lower, " and ",
                free.upper, "; a value that is known belongs into the context"));
  require_possible_start(where, free);
  if (free.log && free.upper <= 0.0)
    refuse(where, free, text("log needs an upper bound above 0, found ", free.upper));
}

FreeValue with_start(const std::string& where, FreeValue free, double value) {
  require_possible(where, free);
  if (free.start) return free;
  const double least = free.log ? std::max(free.lower, 0.0) : free.lower;
  const double middle =
      free.log ? std::sqrt(least * free.upper) : 0.5 * free.lower + 0.5 * free.upper;
  if (least < value && value < free.upper)
    free.start = value;
  else if (std::isfinite(middle) && !(free.log && middle == 0.0))
    free.start = middle;
  else
    refuse(where, free,
           text("the value ", value, " of the context is no start within the bounds ", free.lower,
                " to ", free.upper, "; give one as .start"));
  return free;
}

std::vector<Eigen::VectorXd> latin_hypercube(const Eigen::VectorXd& lower,
                                             const Eigen::VectorXd& upper, int count, double seed) {
  std::vector<Eigen::VectorXd> starts(static_cast<std::size_t>(count), lower);
  for (Index k = 0; k < lower.size(); ++k) {
    const std::vector<int> parts = shuffled_parts(count, seed, k);
    for (int i = 0; i < count; ++i) {
      const double within = uniform(random_words(seed, i, 2 * k + 1));
      nth(starts, i)[k] += (nth(parts, i) + within) / count * (upper[k] - lower[k]);
    }
  }
  return starts;
}

}  // namespace detail

}  // namespace saltus
