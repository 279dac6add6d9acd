// y = interval round(u / interval), elementwise: the nearest level, with a level at 0.
// in: any width. out: the width of u and the interval. Parameter "interval". If y reaches a
// derivative, the times at which the level changes are located, and the level is held between
// instants. Halfway between two levels y is either of them.
// With `hysteresis` h > 0 a level is a state: it is left where u is (interval + h) / 2 away from it,
// for the nearest level, so that noise below h does not make it chatter. The changes are then
// located everywhere, and in has the shape of interval. Parameter "hysteresis".
#pragma once

#include "saltus/library/detail/arguments.hpp"

namespace saltus {

struct QuantizerOptions {
  double hysteresis = 0.0;  ///< 0, or up to the smallest interval
};

class Quantizer final : public LeafSystem {
 public:
  using Options = QuantizerOptions;

  Quantizer(std::string name, const Value& interval, const Options& options = {});

 private:
  void declare_nearest(const Value& interval, ParameterIndex k);
  void declare_levels(const Value& interval, ParameterIndex k, double hysteresis);
};

}  // namespace saltus
