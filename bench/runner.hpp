// Runner: one Simulator of any system, used repeatedly, and the result of its last run.
#pragma once

#include <memory>
#include <saltus/report/scene.hpp>
#include <saltus/saltus.hpp>

namespace bench {

class Runner {
 public:
  Runner(std::shared_ptr<const saltus::System> system, saltus::Context start, double t_end,
         const saltus::SimulatorOptions& options)
      : system_(std::move(system)),
        start_(std::move(start)),
        t_end_(t_end),
        simulator_(*system_, options) {}
  /// Runs a scene by this method, with its own tolerances; only events are recorded.
  Runner(const saltus::Scene& scene, saltus::Method method)
      : Runner(
            scene.system, scene.context.with_time(scene.span.begin), scene.span.end,
            {.rtol = scene.options.rtol, .atol = scene.options.atol, .ode_solver_method = method}) {
  }

  void operator()() {
    simulator_.initialize(start_);
    simulator_.advance_to(t_end_);
  }
  const saltus::Results& results() const { return simulator_.results(); }
  const saltus::Statistics& statistics() const { return results().statistics; }
  Eigen::VectorXd state() const { return results().context.continuous_state(); }

 private:
  std::shared_ptr<const saltus::System> system_;
  saltus::Context start_;
  double t_end_;
  saltus::Simulator simulator_;
};

}  // namespace bench
