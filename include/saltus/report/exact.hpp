// Exact: what a known answer is, a closed form or a reference computed elsewhere.
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
  double accumulation =
      never;  ///< [s] where the events accumulate; `times` are then the first of infinitely many
  double release = never;  ///< [s] where the rest after that ends, and the next series begins
};

/// All event times of one guard, "bounce" or "ball.bounce", or of all of a block, "ball.*", up to
/// the end of the span.
struct EventTimes {
  std::string guard;
  std::vector<EventSeries> series;
};

/// A smooth piece of a trajectory with resets: after `events` events of series `series`, or at rest
/// behind it. A row is compared with its own piece, continued beyond its ends where it must be: an
/// event found a little early or late is an error in time, which is counted apart, and not also one
/// of the size of the jump.
struct Branch {
  std::size_t series = 0;
  std::size_t events = 0;
  bool rest = false;
};

/// State at one time.
struct Sample {
  double time = 0.0;  ///< [s]
  Eigen::VectorXd state;
};

/// A known answer. The state is that of the recorded signals of the scene, one after the other.
struct Exact {
  std::string provenance = {};  ///< where the answer comes from, and to how many digits it is known
  std::vector<EventTimes> events = {};  ///< branches are counted by the first guard
  std::function<Eigen::VectorXd(double t, const Branch& branch)> state =
      {};  ///< empty: no closed form
  std::vector<Sample> samples =
      {};  ///< instead of a closed form: times ascending, each in the scene's save_at
  bool samples_are_exact = false;  ///< whether they are values of a closed form
};

}  // namespace saltus
