// Chattering: events follow each other, and time hardly advances.
#pragma once

#include <cstdint>

#include <Eigen/Core>

#include "saltus/simulation/detail/present.hpp"
#include "saltus/simulation/options.hpp"

namespace saltus {

/// Counts series of events between which nothing moves (docs/semantics.md, 4.7).
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
    bool executed = false;       ///< an execution set off another
  };
  /// Before an instant: whether no state has moved by its tolerance since the last event. The moves of all
  /// events are added up.
  bool idle(const Eigen::VectorXd& x);
  /// After an instant. True if the run chatters: `count` events since `since`.
  bool chatters(const Outcome& outcome, const Seen& seen, bool idle, const Eigen::VectorXd& x);

  /// A series of events: their number, and the time of the first.
  struct Series {
    std::int64_t count = 0;
    double since = 0.0;  ///< [s]
    /// Counts one more event at t if it follows the others; otherwise forgets them.
    void next(bool follows, double t) {
      *this = follows ? Series{count + 1, count == 0 ? t : since} : Series{};
    }
    /// Counts one more event. True when the series has `size` events; the next call begins a new
    /// series at t.
    bool full(std::int64_t size, double t) {
      if (count >= size) *this = {0, t};
      return ++count >= size;
    }
  };
  /// The series that made the run chatter.
  const Series& found() const noexcept { return found_; }

 private:
  bool rests(const Seen& seen);
  bool find(const Series& series) {
    found_ = series;
    return true;
  }

  Tolerance rtol_, atol_;
  Series stuck_;       // a guard at rest without a Zeno monitor fires again
  Series fluttering_;  // both sides of a relation lead back to its surface
  Series roots_;       // events
  Series idle_;        // no state moves between these events
  Series resting_;     // the moves of no state add up to its tolerance over these events
  Series found_;
  Eigen::VectorXd at_event_;  // x at the last event
  Eigen::VectorXd moved_;     // how far each state has flowed in the series `resting_`
  bool moves_ = false;        // some state has moved by its tolerance in that series
};

}  // namespace saltus
