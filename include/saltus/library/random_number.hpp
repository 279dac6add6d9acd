// y[k] = a random number, from tick k, at t = k dt, to the next; one for each entry, independent.
// out: elementwise of the parameters. Normal: parameters "seed", "mean", "standard_deviation";
// uniform: "seed", "lower_limit", "upper_limit". Held; ticks are exact time events. y[k] is a
// function of the seed and k: a run that is resumed, or is part of a sweep, has the same numbers.
// Two blocks with one seed have the same numbers. Before the first tick y is that of tick 0.
#pragma once

#include <string_view>

#include "saltus/library/detail/arguments.hpp"

namespace saltus {

struct RandomNumberOptions {
  std::string_view distribution = "normal";  ///< normal, uniform
  double seed = 0.0;                         ///< any finite number
  Value mean = 0.0;                          ///< of a normal distribution
  Value standard_deviation = 1.0;            ///< >= 0
  Value lower_limit = 0.0;                   ///< of a uniform distribution
  Value upper_limit = 1.0;                   ///< >= lower_limit
};

class RandomNumber final : public LeafSystem {
 public:
  using Options = RandomNumberOptions;

  RandomNumber(std::string name, double dt, const Options& options = {});

 private:
  void declare_normal(double dt, const Options& options);
  void declare_uniform(double dt, const Options& options);
};

}  // namespace saltus
