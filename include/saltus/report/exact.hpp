// Exact: a known answer, either a closed form or a reference computed elsewhere.
#pragma once

#include <functional>
#include <limits>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace saltus {

/// Event times of one guard, from one rest to the next.
struct EventSeries {
  static constexpr double never = std::numeric_limits<double>::infinity();

  std::vector<double> times = {};  ///< [s]
  /// [s] where the events accumulate; `times` are then the first of infinitely many events.
  double accumulation = never;
  double release = never;  ///< [s] end of the rest after that; the next series begins
};

/// All event times of one guard, "bounce" or "ball.bounce", or of all events of a block, "ball.*",
/// up to the end of the span.
struct EventTimes {
  std::string guard;
  std::vector<EventSeries> series;
};

/// A smooth piece of a trajectory with resets: after `events` events of series `series`, or at rest
/// after the series. A row is compared with its own piece, continued beyond its ends if necessary.
/// So an event found a little early or late is an error in time, which is counted separately, and
/// not also an error as large as the jump.
struct Branch {
  std::size_t series = 0;
  std::size_t events = 0;
  bool rest = false;
};

/// The state at one time.
struct Sample {
  double time = 0.0;  ///< [s]
  Eigen::VectorXd state;
};

/// A known answer. The state consists of the recorded signals of the scene, concatenated.
struct Exact {
  std::string provenance = {};  ///< the source of the answer, and its number of known digits
  std::vector<EventTimes> events = {};  ///< branches are counted by the first guard
  /// Empty if there is no closed form.
  std::function<Eigen::VectorXd(double t, const Branch& branch)> state = {};
  /// Known values in place of a closed form. Their times ascend, and each is in the scene's
  /// save_at.
  std::vector<Sample> samples = {};
  bool samples_are_exact = false;  ///< whether the samples are values of a closed form
};

}  // namespace saltus
