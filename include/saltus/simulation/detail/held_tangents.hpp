// HeldTangents: the derivatives of the signals that are held between instants.
#pragma once

#include <optional>

#include "saltus/model/context.hpp"
#include "saltus/plan/detail/flow_graph.hpp"
#include "saltus/simulation/detail/tangent_flow.hpp"

namespace saltus {

/// The signals of formulas have exact derivatives, by the chain rule. Where a function is called, or has
/// a kink at the present values, they are differences along the columns.
class HeldTangents {
 public:
  HeldTangents(const Machine& machine, TangentFlow& flow, TangentProbe& probe)
      : machine_(&machine), flow_(&flow), probe_(&probe) {}

  /// A run begins: those of the signals that a context computes, by its parameters.
  void begin(const Context& start, TangentColumns& columns);
  /// The machine has evaluated its signals at the present time t [s].
  void follow(double t, TangentColumns& columns);
  /// Why the last derivative has a NaN; empty if nothing says.
  const std::string& obstacle() const noexcept { return obstacle_; }

 private:
  /// The exact derivatives, and where they have kinks.
  struct Exact {
    TangentFlow::Partials partials;
    std::vector<Index> places;
    std::optional<tape::Tape> switches;
    bool whole;
  };

  void make();
  bool has_kink_at(double t);
  void differ(double t, TangentColumns& columns, Eigen::MatrixXd& y);
  void add_exact(double t, const TangentColumns& columns, Eigen::MatrixXd& y);

  const Machine* machine_;
  TangentFlow* flow_;
  TangentProbe* probe_;
  std::optional<Exact> exact_;
  int functions_ = -1;  // of which `exact_` is made
  std::string obstacle_;
};

}  // namespace saltus
