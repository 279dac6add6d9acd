// InstantTime: how the time of an instant moves with each parameter.
#pragma once

#include <optional>
#include <string>

#include "saltus/simulation/detail/tangent_gaps.hpp"
#include "saltus/simulation/detail/tangent_times.hpp"

namespace saltus {

/// An instant moves as its first cause does. Where the other causes move apart from it, their order
/// would change, and the columns are lost.
class InstantTime {
 public:
  InstantTime(TangentColumns& columns, TangentGaps& gaps) : columns_(&columns), gaps_(&gaps) {}

  /// An instant begins at t [s], and has no cause yet.
  void open(double t) { t_ = t, first_ = true; }
  /// Takes one more cause.
  void take(const MovedTime& moved);
  /// Whether this instant has a cause so far.
  bool is_caused() const noexcept { return !first_; }
  /// All causes are known: an instant without one has a fixed time.
  void settle();

  /// The name of the event that caused the last instant, if one did.
  const std::optional<std::string>& cause() const noexcept { return cause_; }
  std::string event() const { return cause_.value_or(""); }

 private:
  TangentColumns* columns_;
  TangentGaps* gaps_;
  double t_ = 0.0;  // [s]
  bool first_ = true;
  std::optional<std::string> cause_;
};

}  // namespace saltus
