// TimeJumps: jumps of called functions along a step, and whether a parameter moves them.
#pragma once

#include <array>
#include <functional>
#include <vector>

#include "saltus/simulation/detail/tangent_probe.hpp"

namespace saltus {

/// Looks at the flow along a step by its fourth differences. Those of a smooth flow fall by sixteen where
/// the distance is halved, and those at a jump stay. A jump moves with a parameter if it is no more
/// between two neighbouring times after a small shift of that parameter.
class TimeJumps {
 public:
  using StateAt = std::function<Eigen::VectorXd(double t)>;
  /// The flow on both sides of a jump, at neighbouring times [s].
  struct Jump {
    double before, after;
    Eigen::VectorXd x_before, x_after, by;  ///< by: f+ - f-
  };

  explicit TimeJumps(TangentProbe& probe) : probe_(&probe) {}

  /// A run of n states begins.
  void begin(Index n) { rates_.setZero(n); }
  /// The jumps between these times [s].
  std::vector<Jump> within(double from, double to, const StateAt& state);
  /// Whether a column moves a jump.
  bool moves(const Jump& jump, const TangentColumns& columns, Index k);

 private:
  /// The flow at a time.
  struct Look {
    double t;
    Eigen::VectorXd x, f;
  };
  /// Five looks at equal distances.
  using Looks = std::array<Look, 5>;
  Look look(double t, const StateAt& state);
  Look between(const Look& a, const Look& b, const StateAt& state) {
    return look(a.t + 0.5 * (b.t - a.t), state);
  }
  double bend(const Looks& at) const;
  void search(const Looks& at, const StateAt& state, std::vector<Jump>& found);

  TangentProbe* probe_;
  Eigen::VectorXd rates_;  // the largest of each derivative so far
};

}  // namespace saltus
