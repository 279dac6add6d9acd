// GuardSeries: where to look for the crossings of the guards inside a Taylor step.
#pragma once

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

#include "saltus/plan/detail/flow_series.hpp"
#include "saltus/solver/detail/look_points.hpp"
#include "saltus/solver/detail/taylor/root_separation.hpp"
#include "saltus/tape/series.hpp"

namespace saltus::taylor {

/// The guards of a plan as series along the solution.
class GuardSeries final : public LookPoints {
 public:
  explicit GuardSeries(const GuardSet& guards) : guards_(&guards) {}

  /// Takes the guards whose series show them, as outputs of the series of the plan.
  void take(std::shared_ptr<const FlowSeries> kept) { kept_ = std::move(kept); }

  /// The step begins: `series` is expanded to this order, and the step is h [s] long. Null: it has
  /// no series, and the guards are known by their values only.
  void begin_step(tape::Series* series, int order, double h) {
    series_ = series, order_ = order, h_ = h;
  }

  const std::vector<double>* between(const LocatedGuards& located, double from,
                                     double to) override {
    if (series_ == nullptr) return nullptr;
    points_.clear();
    for (const std::size_t k : located.slots)
      if (number(k) == FlowSeries::no_output || !separate(k, from / h_)) return nullptr;
    for (double& point : points_) point *= h_;
    std::ranges::sort(points_);
    const auto inside = [&](double u) { return u > from && u < to; };
    std::erase_if(points_, [&](double u) { return !inside(u); });
    points_.erase(std::ranges::unique(points_).begin(), points_.end());
    return &points_;
  }

 private:
  int number(std::size_t slot) const { return kept_->output_of_slot[slot]; }

  /// Adds the points of one guard, whose crossings are those of zero, of its error to both sides,
  /// and of the value from which an edge is told.
  bool separate(std::size_t k, double from) {
    double* a = terms_.data();
    series_->expand_outputs(number(k), 1, a);
    double power = 1.0;
    for (int i = 1; i <= order_; ++i) a[i] *= power *= h_;
    const Guard& guard = (*guards_)[k];
    const bool edge = guard.watched_direction() == Direction::edge_detection;
    const double value = a[0];
    const auto crossings_of = [&](double level) {
      a[0] = value - level;
      return separation_.separate(a, order_, from, points_);
    };
    if (edge && !crossings_of(guard.base)) return false;
    if (guard.error > 0.0 && !(crossings_of(guard.error) && crossings_of(-guard.error)))
      return false;
    return crossings_of(0.0);
  }

  const GuardSet* guards_;
  std::shared_ptr<const FlowSeries> kept_;
  tape::Series* series_ = nullptr;
  int order_ = 0;
  double h_ = 0.0;
  std::array<double, most_order + 1> terms_{};
  RootSeparation separation_;
  std::vector<double> points_;
};

}  // namespace saltus::taylor
