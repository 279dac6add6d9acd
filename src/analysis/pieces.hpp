// Short runs with the derivative of the end by the start.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "orbit_runs.hpp"

namespace saltus {

/// A run from x to phi(x).
struct Piece {
  /// (m, m) d phi/dx of the active states, at a fixed time, through all events.
  Eigen::MatrixXd matrix;
  double duration = 0.0;  ///< [s]
  Context end;
  bool has_events = false;
  bool rested = false;  ///< a block came to rest in it: then nothing is left of its directions
};

/// Pieces of one long run. The active states are the continuous ones and the discrete ones that are no
/// labels, as counts and sides are: whole numbers that depend on no active state.
class Pieces {
 public:
  Pieces(OrbitRuns& runs, const Context& start, std::vector<bool> labels);

  /// About `duration` seconds from `begin`. The piece ends elsewhere if an event is at its end, and
  /// later, but not after `latest`, if a block is at rest there. Empty if states that were taken for
  /// labels turn out to be none; they are then no labels any more.
  std::optional<Piece> run(const Context& begin, double duration, double latest);

  const std::vector<Index>& active() const noexcept { return active_; }
  const std::vector<bool>& labels() const noexcept { return labels_; }
  const RunStates& states() const noexcept { return states_; }
  const std::vector<std::string>& names() const noexcept { return names_; }

 private:
  /// The run to the first end at which no block is at rest.
  const Results& moving(const Context& begin, double duration, double latest);
  [[noreturn]] void refuse_rest(const std::vector<std::string>& resting,
                                const Results& results) const;
  bool labels_hold(const Eigen::MatrixXd& derivatives, const Context& end);

  OrbitRuns& runs_;
  RunStates states_;
  std::vector<bool> labels_;
  std::vector<Index> active_;
  std::vector<std::string> names_;
  std::optional<Simulator> simulator_;
};

}  // namespace saltus
