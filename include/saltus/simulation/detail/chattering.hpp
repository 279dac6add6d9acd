// Chattering: events go on, and time does not.
#pragma once

#include <cstdint>

#include <Eigen/Core>

#include "saltus/simulation/detail/present.hpp"
#include "saltus/simulation/options.hpp"

namespace saltus {

/// Counts the events of a run between which nothing moves (docs/semantics.md, 4.7).
class Chattering {
 public:
  explicit Chattering(const SimulatorOptions& options) : rtol_(options.rtol), atol_(options.atol) {}

  /// A run begins at t with the state x.
  void begin(double t, const Eigen::VectorXd& x);

  /// An instant as the run sees it.
  struct Seen {
    double t = 0.0;              ///< [s]
    bool at_root = false;        ///< it began because a guard fired
    double length_of_run = 0.0;  ///< [s]
  };
  /// Before an instant: whether no state has moved by its tolerance since the last root.
  bool idle(const Eigen::VectorXd& x) const;
  /// After an instant. True if the run chatters: `count` events since `since`.
  bool chatters(const Outcome& outcome, const Seen& seen, bool idle, const Eigen::VectorXd& x);

  /// How many events in a row, since when.
  struct Series {
    std::int64_t count = 0;
    double since = 0.0;  ///< [s]
    /// Counts one more that follows at t; forgets them where none follows.
    void next(bool follows, double t) {
      *this = follows ? Series{count + 1, count == 0 ? t : since} : Series{};
    }
    /// Counts one more; true when that makes `size`, and then begins anew at t unless it is kept.
    bool full(std::int64_t size, double t) {
      if (count >= size) *this = {0, t};
      return ++count >= size;
    }
  };
  /// The series that made the run chatter.
  const Series& found() const noexcept { return found_; }

 private:
  bool find(const Series& series) {
    found_ = series;
    return true;
  }

  double rtol_, atol_;
  Series stuck_;       // a guard at rest without a Zeno monitor fires again
  Series fluttering_;  // a relation whose both sides lead back to its surface
  Series roots_;       // roots
  Series idle_;        // roots between which no state moves
  Series found_;
  Eigen::VectorXd at_root_;  // x at the last root
};

}  // namespace saltus
