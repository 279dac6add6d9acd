// Crawl: very many steps in very little time, because a derivative jumps at the present state.
#pragma once

#include <cstdint>

#include <Eigen/Core>

#include "saltus/plan/detail/machine.hpp"

namespace saltus {

/// Looks for a jump of the derivative along which the solution slides (docs/semantics.md, 4.7). No
/// step passes such a jump, and none is long: its error is proportional to its size. So where a
/// window of steps took little time, the derivative at the ends of the next steps is compared with
/// the derivative some steps ahead, straight on along the flow. A slide is never further from its
/// jump than that, so a derivative changes its sign. It may do so in a stiff scene too. But there
/// it changes gradually, and a jump stays as large as it is when the way across it is halved down
/// to neighbouring numbers.
///
/// A window costs nothing, and each look ahead two calls of the right-hand side. Looks that find
/// nothing double the next window.
class Crawl {
 public:
  explicit Crawl(Machine& machine) : machine_(&machine) {}

  /// A run, or a piece of it, begins at t.
  void begin(double t);
  /// After a step to t: whether its end has to be looked at, with `found`.
  bool looks(double t, double length_of_run) {
    if (looking_) return true;
    if (++steps_ >= window_) start(t, length_of_run);
    return false;
  }
  /// Looks at the end (t, x) of a step. Returns true if the derivative jumps where the solution is.
  bool found(double t, const Eigen::VectorXd& x);

  /// The jump: which state, its derivative on both sides, the steps counted, and the time they
  /// took.
  struct Jump {
    Index state = 0;
    double at = 0.0, below = 0.0, above = 0.0;
    std::int64_t steps = 0;
    double took = 0.0;  ///< [s]
  };
  const Jump& jump() const noexcept { return jump_; }

 private:
  void start(double t, double length_of_run);
  bool found_at(double t, const Eigen::VectorXd& x, Eigen::VectorXd& f);
  /// The state whose derivative has different signs here and ahead, and changes most; -1 if none.
  Index reverses() const;
  bool jumps(double t, const Eigen::VectorXd& x, Index state);

  Machine* machine_;
  std::int64_t window_ = 0, steps_ = 0;
  int compared_ = 0, reversals_ = 0;
  double since_ = 0.0;    // [s] begin of the window
  double ahead_ = 0.0;    // [s] how far the looks go
  bool looking_ = false;  // steps are compared
  Eigen::VectorXd low_, high_, middle_, f_from_, f_to_, f_;
  Jump jump_;
};

}  // namespace saltus
