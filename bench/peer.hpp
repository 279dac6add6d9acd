// Peer: one solver on one stiff scene at one tolerance, run as often as one likes.
#pragma once

#include <memory>
#include <string>

#include "stiff_shelf.hpp"

namespace bench {

/// Counts of one run. `calls` counts f in all its uses; differences for a Jacobian are calls too.
struct Counts {
  long steps = 0, calls = 0, jacobians = 0, factorisations = 0;
};

class Peer {
 public:
  virtual ~Peer() = default;
  /// From the start to the end; false: it gave up.
  virtual bool run() = 0;
  virtual Counts counts() const = 0;
  /// The error of the last run, in the measure of the scene.
  virtual double error() = 0;
};

/// The largest error of the rows, one for each sample of the answer; NaN counts as infinite.
inline double error_of(const StiffScene& scene, const std::vector<Eigen::VectorXd>& rows) {
  double worst = 0.0;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const Eigen::ArrayXd exact = scene.answer[k].state.array();
    const double found = ((rows[k].array() - exact).abs() / (scene.scale + exact.abs())).maxCoeff();
    worst = found <= worst ? worst : std::isnan(found) ? HUGE_VAL : found;
  }
  return worst;
}

/// Saltus on the same functions, which it sees as a leaf.
class SaltusPeer final : public Peer {
 public:
  SaltusPeer(const StiffScene& scene, saltus::Method method, double rtol)
      : scene_(scene),
        leaf_(scene.problem),
        start_(leaf_.create_context()),
        simulator_(leaf_, options(method, rtol)) {}

  bool run() override {
    simulator_.initialize(start_);
    return ended_well(simulator_.advance_to(scene_.problem.t_end));
  }
  Counts counts() const override {
    const auto& s = simulator_.results().statistics;
    return {s.steps, s.right_hand_side_calls, s.jacobian_calls, s.linear_setups};
  }
  double error() override {
    const auto y = simulator_.results().output("y");
    std::vector<Eigen::VectorXd> rows;
    for (saltus::Index i = 0; i < y.rows(); ++i) rows.emplace_back(y.row(i));
    return error_of(scene_, rows);
  }

 private:
  saltus::SimulatorOptions options(saltus::Method method, double rtol) const {
    std::vector<double> times;
    for (const auto& sample : scene_.answer) times.push_back(sample.time);
    return {.rtol = rtol,
            .atol = rtol * scene_.scale,
            .ode_solver_method = method,
            .recorded_signals = {{"y", leaf_.output(0)}},
            .save_at = times,
            .event_rows = false,
            .throw_errors = false};
  }

  StiffScene scene_;
  StiffLeaf leaf_;
  saltus::Context start_;
  saltus::Simulator simulator_;
};

}  // namespace bench
