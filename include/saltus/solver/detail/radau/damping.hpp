// The first steps after a hand-over, which damp an oscillation.
#pragma once

#include "saltus/solver/detail/radau/tuning.hpp"

namespace saltus::radau {

/// See Start::damp_rate. A step of length h with h |lambda| = 10 leaves a third of an oscillation,
/// if three stages take it. By its estimate it would be so short that it resolves the oscillation.
/// So the estimate is allowed if it shrinks from step to step as the oscillation does.
class Damping {
 public:
  /// |lambda| [1/s], 0: there is no oscillation; its amplitude [tolerances]; the longest step [s].
  void begin(double rate, double size, double longest) {
    length_ = rate > 0.0 ? tuning::damping_reach / rate : 0.0, size_ = size;
    left_ = rate > 0.0 && length_ <= longest ? tuning::damping_steps : 0;
  }
  void end() { left_ = 0; }

  /// Whether more steps are to damp; [s] their length.
  bool goes_on() const { return left_ > 0; }
  double length() const { return length_; }

  /// Whether a step of length h damps: a shorter one, to a stop time, is a step like any other.
  bool by(double h) const { return left_ > 0 && h >= tuning::damping_share * length_; }
  /// Whether the estimate, its largest part [tolerances], is no more than the damped oscillation.
  bool allows(double estimate) const { return estimate <= tuning::damping_room * size_; }
  /// A step has damped, with this estimate.
  void accept(double estimate) { --left_, size_ = tuning::damping_left * estimate; }

 private:
  int left_ = 0;         // [steps]
  double length_ = 0.0;  // [s]
  double size_ = 0.0;    // [tolerances] the amplitude
};

}  // namespace saltus::radau
