// FlowTerms: the linear equation of the tangents, as sparse terms.
#pragma once

#include <vector>

#include "saltus/simulation/detail/tangent_flow.hpp"
#include "saltus/solver/detail/column_steps.hpp"

namespace saltus {

/// S' = f_x S + f_p, and what the columns of discrete states and signals add, by the exact derivatives of
/// the flow. All columns are computed together, from one evaluation of all derivatives.
class FlowTerms final : public ColumnRate {
 public:
  FlowTerms(const Machine& machine, TangentFlow& flow) : machine_(&machine), flow_(&flow) {}

  /// Chooses the terms for these columns and for the states at rest.
  void choose(const TangentColumns& columns);
  /// A step begins. `continues`: where the last one ended.
  void watch(bool continues);
  /// The step ends at the last point.
  void end_step() { at_end_ = now_, crossed_in_step_ = crossed_; }
  /// Whether a switch of the flow has changed its branch in that step.
  bool crossed() const noexcept { return crossed_in_step_; }

  void go_to(double t, const double* x) override;
  void apply(const double* s, double* ds) const override;

 private:
  /// ds[to] += value s[from], for all columns of a row.
  struct ByState {
    Index value, to, from;
  };
  /// ds[to] += value weight, for one column.
  struct Fixed {
    Index value, to;
    double weight;
  };

  const Machine* machine_;
  TangentFlow* flow_;
  Index n_ = 0, m_ = 0;
  std::vector<ByState> by_state_;
  std::vector<Fixed> fixed_;
  const double* values_ = nullptr;
  // The branches of the switches at the first point of a step, at the present one, and at the end.
  std::vector<double> branches_, now_, at_end_;
  bool crossed_ = false, crossed_in_step_ = false;
};

}  // namespace saltus
