// The signs by which an explicit method shows that a scene is stiff.
#pragma once

#include "saltus/solver/detail/one_step.hpp"
#include "saltus/solver/detail/spectral_radius.hpp"
#include "saltus/solver/detail/stiff_thresholds.hpp"

namespace saltus {

/// The fastest part of a scene.
struct FastPart {
  double rate = 0.0;           ///< |lambda| [1/s]
  bool hardly_damped = false;  ///< it oscillates: see thresholds::hardly_damped
};

/// Whether the longest step since a restart is so short beside the steps before it [s] that
/// stability may be the reason. To find its first length again takes a method fewer steps.
inline bool has_collapsed(double longest, double before) {
  return longest < thresholds::collapse * before;
}
/// Whether steps of h |lambda| = `reach` are out of the question for a method that is stable up to
/// `stability`.
inline bool is_far_beyond(double reach, double stability) {
  return reach > thresholds::far_beyond_stability * stability;
}

/// Asks the StiffnessTest of the explicit method, and for |lambda| only where that has a sign. A
/// function `suits(FastPart)` says whether there is a method that is better for such a part.
class StiffSigns {
 public:
  StiffSigns(OneStepSolver& method, SpectralRadius& radius) : method_(&method), radius_(&radius) {
    method.watch_stiffness();
  }

  /// After a restart; `before` [s] is the longest step before it, 0: there is none to compare with.
  void restart(double before) { before_ = before, unchecked_ = true; }
  /// The last stretch of a stiff method for a part of this kind did not last: the next question
  /// comes later.
  void be_patient(const FastPart& part) {
    if (part.hardly_damped) method_->stiffness().put_off(4);
  }

  /// Whether the scene looks stiff at the end of a step; `longest` [s] of the steps since the
  /// restart.
  template <class Suits>
  bool look(double longest, const Suits& suits) {
    return long_since_stiff(suits) || collapsed(longest, suits) || beside_oscillation(suits);
  }

  /// [tolerances] The amplitude of a fast oscillation that was found.
  double amplitude(const FastPart& part) const { return method_->stiffness().amplitude(part.rate); }

 private:
  double rate() { return (*radius_)(method_->time(), method_->state()); }

  /// Whether a damping ratio is that of an oscillation that is hardly damped.
  static bool hardly(double damping) { return damping <= thresholds::hardly_damped; }
  /// An oscillation that grows asks for no stiff method, because that would damp it.
  static bool grows(double damping) { return damping < -thresholds::damping_rounding; }

  template <class Suits>
  bool long_since_stiff(const Suits& suits) {
    StiffnessTest& test = method_->stiffness();
    if (!test.detected()) return false;
    const FastPart part{rate(), hardly(radius_->damping())};
    const bool sure = !part.hardly_damped || test.by_smoothness() || test.oscillates(part.rate);
    if (sure && !grows(radius_->damping()) && suits(part)) return true;
    test.forget(false);
    return false;
  }

  /// Whether stability makes the first step after a restart a hundred times shorter than the steps
  /// before. Then the scene is stiff, without a wait for fifteen such steps. A fast part that
  /// oscillates was set going by what restarted it (a contact): it is the solution, and the error
  /// bounds its steps.
  template <class Suits>
  bool collapsed(double longest, const Suits& suits) {
    if (!unchecked_ || longest == 0.0) return false;
    unchecked_ = false;
    if (!has_collapsed(longest, before_)) return false;
    const FastPart part{rate(), false};
    return radius_->damping() > thresholds::well_damped &&
           is_far_beyond(part.rate * before_, method_->stability()) &&
           part.rate * longest > thresholds::least_reach && suits(part);
  }

  /// Whether stability bounds the steps beside a fast oscillation that is hardly damped.
  template <class Suits>
  bool beside_oscillation(const Suits& suits) {
    StiffnessTest& test = method_->stiffness();
    if (!test.may_oscillate()) return false;
    const FastPart part{rate(), true};
    const double damping = radius_->damping();
    if (hardly(damping) && !grows(damping) && test.oscillates(part.rate) && suits(part))
      return true;
    test.put_off(2);
    return false;
  }

  OneStepSolver* method_;
  SpectralRadius* radius_;
  double before_ = 0.0;    // [s] longest step before the last restart
  bool unchecked_ = true;  // no step was looked at since the last restart or change
};

}  // namespace saltus
