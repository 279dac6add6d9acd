// StretchLog: which method advanced a run, from when to when.
#pragma once

#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <vector>

#include "saltus/solver/detail/solver.hpp"

namespace saltus {

/// Counts the steps of a method from its begin on: the difference of its statistics.
class StretchLog {
 public:
  /// A run begins at t [s].
  void clear(double t) {
    past_.clear();
    begun_ = t, steps_before_ = 0;
  }
  /// The method in use ends at t [s].
  void end(const Solver& method, double t) {
    past_.push_back(present(method));
    past_.back().end = t;
    begun_ = t;
  }
  /// The next method takes over. A stiff method says why, after "the scene looks stiff".
  void begin(const Solver& method, const char* why) {
    steps_before_ = method.statistics().steps;
    if (past_.size() < shown) reasons_[past_.size()] = why;
  }
  bool changed() const noexcept { return !past_.empty(); }

  /// All stretches; `now` is the method in use.
  std::vector<Stretch> all(const Solver& now) const {
    std::vector<Stretch> all = past_;
    all.push_back(present(now));
    return all;
  }
  /// The first of them in words.
  std::string to_string(const Solver& now) const {
    const auto list = all(now);
    std::string words = list.front().method;
    for (std::size_t i = 1; i < std::min(list.size(), shown); ++i)
      words += text(", then ", list[i].method, " from t = ", list[i].begin, " s: the scene ",
                    *reasons_[i] ? "looks stiff " : "no longer does", reasons_[i]);
    return list.size() > shown ? text(words, "; ", list.size(), " stretches in all") : words;
  }

 private:
  static constexpr std::size_t shown = 4;  // stretches in words

  Stretch present(const Solver& method) const {
    return {method.method(), begun_, method.time(), method.statistics().steps - steps_before_};
  }

  std::vector<Stretch> past_;
  std::array<const char*, shown> reasons_ = {};  // of the first stretches; the very first has none
  double begun_ = 0.0;                           // [s] begin of the present stretch
  std::int64_t steps_before_ = 0;
};

}  // namespace saltus
