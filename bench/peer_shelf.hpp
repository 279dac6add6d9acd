// A scene of the shelf by a method of Saltus, with its events and resets.
#pragma once

#include <saltus/report/achieved.hpp>

#include "peer.hpp"
#include "runner.hpp"

namespace bench {

class ShelfPeer final : public Peer {
 public:
  ShelfPeer(saltus::Scene scene, saltus::Method method, double rtol)
      : scene_(at_tolerance(std::move(scene), method, rtol)), timed_(scene_, method) {}

  bool run() override {
    try {
      timed_();
    } catch (const saltus::SimulationError&) {
      return false;
    }
    return ended_well(timed_.results().status);
  }
  Counts counts() const override {
    const auto& s = timed_.statistics();
    return {s.steps, s.right_hand_side_calls, s.jacobian_calls, s.linear_setups};
  }
  /// The error comes from a run of its own that records. A wrong number of events is an infinite
  /// error.
  double error() override {
    const saltus::Achieved found = achieved(scene_, simulate(scene_));
    if (found.event_mismatch != 0 || std::isnan(found.scaled)) return HUGE_VAL;
    return found.scaled * scene_.options.rtol.smallest();
  }

 private:
  saltus::Scene scene_;
  Runner timed_;
};

}  // namespace bench
