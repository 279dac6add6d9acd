// ChainRule: where a function jumps or has a kink, so that it has no derivative.
#include <algorithm>
#include <cmath>
#include <limits>

#include "saltus/simulation/detail/chain_rule.hpp"
#include "saltus/simulation/detail/kinks.hpp"

namespace saltus {

namespace {

/// [of a value] A shift that a called boolean has to survive.
constexpr double boolean_shift = 16.0 * thresholds::eps;

}  // namespace

bool ChainRule::jumps_here(int node) {
  const LeafFunction& function = *functions_[node];
  Eigen::VectorXd now(function.size), moved(function.size);
  call(function, now.data());
  for (const ReadValue& read : function.reads) {
    if (!moves(read)) continue;
    const double size = std::max(std::abs(value_of(read)), std::numeric_limits<double>::min());
    for (const double shift : {boolean_shift * size, -boolean_shift * size}) {
      Machine& probe = probe_.at(machine_.x.data(), along(read), shift);
      (*function.call)(*plan_.leaf(function.leaf).system,
                       probe.at(function.leaf, t_, probe.x.data()),
                       VectorRef(moved.data(), moved.size()));
      if (moved != now) return true;
    }
  }
  return false;
}

bool ChainRule::has_kink(const LeafFunction& function) {
  const LeafPartials& partials = *function.partials;
  const Index count = function.size + static_cast<Index>(partials.entries.size());
  for (const ReadValue& read : function.reads) {
    if (!moves(read)) continue;
    const auto values_at = [&](double shift) -> Eigen::ArrayXd {
      Eigen::VectorXd values(partials.tape.size());
      Machine& probe = probe_.at(machine_.x.data(), along(read), shift);
      FlowVariables(probe).at(t_, probe.x.data(),
                              [&](const At& at) { partials.tape.evaluate(at, values.data()); });
      return values.head(count).array();
    };
    const double size = value_of(read) == 0.0 ? 1.0 : std::abs(value_of(read));
    if (saltus::has_kink(values_at, size)) return true;
  }
  return false;
}

}  // namespace saltus
