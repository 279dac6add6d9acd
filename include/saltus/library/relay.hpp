// y = on_value after u has reached on_threshold, off_value after it has fallen to off_threshold.
// in, out: scalar. Parameters: all four numbers. Mode 1 is on, mode 0 off. Both switches are located
// as events, everywhere: the mode is a state. The relay starts on if u is at or above on_threshold,
// and off if u is at or below off_threshold; between them `initially_on` decides. If the thresholds
// are equal when the block is made, it has no mode, and is on for u >= on_threshold: in a loop such
// a relay chatters, and the run ends with that status.
#pragma once

#include "saltus/model/leaf_system.hpp"

namespace saltus {

struct RelayOptions {
  double on_threshold = 1.0;
  double off_threshold = 0.0;  ///< <= on_threshold
  double on_value = 1.0;
  double off_value = 0.0;
  bool initially_on = false;  ///< if u starts between the thresholds
};

class Relay final : public LeafSystem {
 public:
  using Options = RelayOptions;

  explicit Relay(std::string name, const Options& options = {});

 private:
  struct Thresholds {
    ParameterIndex on, off;
  };
  void declare_comparison(ParameterIndex threshold, ParameterIndex high, ParameterIndex low);
  void declare_modes(bool initially_on, const Thresholds& thresholds, ParameterIndex high,
                     ParameterIndex low);
};

}  // namespace saltus
