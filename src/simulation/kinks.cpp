#include "saltus/simulation/detail/kinks.hpp"

#include <cmath>

#include "saltus/simulation/detail/thresholds.hpp"
#include "saltus/tape/switches.hpp"

namespace saltus {

namespace {

/// [of its terms] The operands of a switch that are closer are at its limit.
constexpr double switch_rounding = 16.0 * thresholds::eps;
/// [of a value] The shifts with which both sides of a switch are compared. What a smooth function
/// changes falls with the shift, by a hundred; a kink stays as it is.
constexpr double wide_shift = 1e-4, near_shift = 1e-6;
constexpr double smooth_fall = 0.1;
/// [of the size of a derivative] A smaller difference of both sides is rounding.
constexpr double side_rounding = 1e-9;

/// By how much values and derivatives on both sides differ from each other and from those here.
struct Sides {
  Eigen::ArrayXd misfit, size;
};

Sides sides(const std::function<Eigen::ArrayXd(double)>& values_at, double shift) {
  const Eigen::ArrayXd low = values_at(-shift), here = values_at(0.0), high = values_at(shift);
  return {(high - low).abs().max((high + low - 2.0 * here).abs()),
          low.abs().max(high.abs()).max(here.abs())};
}

}  // namespace

bool has_switch_at_limit(const double* numbers, Index switches) {
  for (Index k = 0; k < switches; ++k, numbers += tape::numbers_of_switch)
    if (std::abs(numbers[0] - numbers[1]) <= switch_rounding * numbers[2]) return true;
  return false;
}

bool has_kink(const std::function<Eigen::ArrayXd(double)>& values_at, double size) {
  const Sides wide = sides(values_at, wide_shift * size),
              near = sides(values_at, near_shift * size);
  const auto stays = near.misfit > smooth_fall * wide.misfit;
  const auto counts = near.misfit > side_rounding * near.size;
  return (stays && counts).any();
}

}  // namespace saltus
