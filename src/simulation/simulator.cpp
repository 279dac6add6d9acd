// Simulator: the public interface of a run.
#include "saltus/simulation/simulator.hpp"

#include <utility>

#include "saltus/simulation/detail/run.hpp"

namespace saltus {

Simulator::Simulator(const System& system, SimulatorOptions options)
    : run_(std::make_unique<Run>(system, std::move(options))) {}
Simulator::Simulator(std::shared_ptr<const Plan> plan, SimulatorOptions options)
    : run_(std::make_unique<Run>(std::move(plan), std::move(options))) {
  if (!run_->options().recorded_signals.empty())
    throw ModelError("recorded_signals: give them to compile(), where the plan is made");
  if (run_->options().refinement)
    throw ModelError("refinement: give it to compile(), where the plan is made");
}
Simulator::~Simulator() = default;
Simulator::Simulator(Simulator&&) noexcept = default;
Simulator& Simulator::operator=(Simulator&&) noexcept = default;

void Simulator::initialize(const Context& context) {
  const Turn turn = run_->claim("initialize");
  run_->initialize(context);
}
Status Simulator::advance_to(double t_end) {
  const Turn turn = run_->claim("advance_to");
  return run_->advance_to(t_end);
}
void Simulator::functions_replaced() {
  const Turn turn = run_->claim("functions_replaced");
  run_->functions_replaced();
}
double Simulator::time() const noexcept { return run_->time(); }
Context Simulator::context() const {
  const Turn turn = run_->claim("context");
  return run_->context();
}
const Results& Simulator::results() const noexcept { return run_->results(); }
Results Simulator::take_results() {
  const Turn turn = run_->claim("take_results");
  return run_->take_results();
}
const Plan& Simulator::plan() const noexcept { return run_->plan(); }
std::string Simulator::describe() const {
  const Turn turn = run_->claim("describe");
  return run_->describe();
}

}  // namespace saltus
