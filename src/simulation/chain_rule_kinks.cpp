// ChainRule: where a function jumps or has a kink, so that it has no derivative.
#include <algorithm>
#include <cmath>
#include <limits>

#include "saltus/simulation/detail/chain_rule.hpp"

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

}  // namespace

bool ChainRule::jumps_here(int node) {
  const LeafFunction& function = *functions_[node];
  Eigen::VectorXd now(function.size), moved(function.size);
  call(function, now.data());
  for (const ReadValue& read : function.reads) {
    if (!moves(read)) continue;
    const double size = std::max(std::abs(value_of(read)), std::numeric_limits<double>::min());
    for (const double shift : {switch_rounding * size, -switch_rounding * size}) {
      Machine& probe = probe_.at(machine_.x.data(), along(read), shift);
      (*function.call)(*plan_.leaf(function.leaf).system,
                       probe.at(function.leaf, t_, probe.x.data()),
                       VectorRef(moved.data(), moved.size()));
      if (moved != now) return true;
    }
  }
  return false;
}

bool ChainRule::has_switch_here(const LeafPartials& partials, Index size) const {
  const Index first = size + static_cast<Index>(partials.entries.size());
  for (Index k = 0; k < partials.switches; ++k) {
    const double* numbers = &values_[first + k * LeafPartials::numbers_of_switch];
    if (std::abs(numbers[0] - numbers[1]) <= switch_rounding * numbers[2]) return true;
  }
  return false;
}

/// A switch at its limit is a kink only if the function or its derivative differs on both sides: v |v|
/// has none at v = 0.
bool ChainRule::has_kink(const LeafFunction& function) {
  for (const ReadValue& read : function.reads) {
    if (!moves(read)) continue;
    const double size = value_of(read) == 0.0 ? 1.0 : std::abs(value_of(read));
    const Sides wide = sides(function, read, wide_shift * size),
                near = sides(function, read, near_shift * size);
    const auto stays = near.misfit.array() > smooth_fall * wide.misfit.array();
    const auto counts = near.misfit.array() > side_rounding * near.size.array();
    if ((stays && counts).any()) return true;
  }
  return false;
}

/// By how much values and derivatives on both sides differ from each other and from those here.
ChainRule::Sides ChainRule::sides(const LeafFunction& function, const ReadValue& read,
                                  double shift) {
  const LeafPartials& partials = *function.partials;
  const Index count = function.size + static_cast<Index>(partials.entries.size());
  const auto values_at = [&](double by) -> Eigen::ArrayXd {
    Eigen::VectorXd values(partials.tape.size());
    Machine& probe = probe_.at(machine_.x.data(), along(read), by);
    FlowVariables(probe).at(t_, probe.x.data(),
                            [&](const At& at) { partials.tape.evaluate(at, values.data()); });
    return values.head(count).array();
  };
  const Eigen::ArrayXd low = values_at(-shift), here = values_at(0.0), high = values_at(shift);
  return {(high - low).abs().max((high + low - 2.0 * here).abs()),
          low.abs().max(high.abs()).max(here.abs())};
}

}  // namespace saltus
