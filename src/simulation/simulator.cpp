// Simulator: the public interface of a run.
#include "saltus/simulation/simulator.hpp"

#include <utility>

#include "saltus/simulation/detail/island_runs.hpp"
#include "saltus/simulation/detail/option_table.hpp"
#include "saltus/simulation/detail/run.hpp"

namespace saltus {

namespace {

Islands islands_for(const Plan& plan, const SimulatorOptions& options) {
  return find_islands(plan, options.sensitivity.empty() ? DelayedWires::cut : DelayedWires::join);
}

}  // namespace

Simulator::Simulator(const System& system, SimulatorOptions options) {
  if (!options.islands) {
    run_ = std::make_unique<Run>(system, std::move(options));
    return;
  }
  detail::check(options);
  const auto plan =
      compile(system, std::exchange(options.recorded_signals, {}), options.refinement.get());
  options.refinement.reset();
  *this = Simulator(plan, std::move(options));
}

Simulator::Simulator(std::shared_ptr<const Plan> plan, SimulatorOptions options) {
  if (!options.recorded_signals.empty())
    throw ModelError("recorded_signals: give them to compile(), where the plan is made");
  if (options.refinement)
    throw ModelError("refinement: give it to compile(), where the plan is made");
  Islands islands = options.islands ? islands_for(*plan, options) : Islands();
  if (islands.count() > 1)
    islands_ =
        std::make_unique<IslandRuns>(std::move(plan), std::move(islands), std::move(options));
  else
    run_ = std::make_unique<Run>(std::move(plan), std::move(options));
}
Simulator::~Simulator() = default;
Simulator::Simulator(Simulator&&) noexcept = default;
Simulator& Simulator::operator=(Simulator&&) noexcept = default;

namespace {

/// Calls `use` with the run that there is.
template <class Use>
decltype(auto) with(const std::unique_ptr<Run>& run, const std::unique_ptr<IslandRuns>& islands,
                    Use use) {
  return run ? use(*run) : use(*islands);
}

}  // namespace

void Simulator::initialize(const Context& context) {
  with(run_, islands_, [&](auto& run) {
    const Turn turn = run.claim("initialize");
    run.initialize(context);
  });
}
Status Simulator::advance_to(double t_end) {
  return with(run_, islands_, [&](auto& run) {
    const Turn turn = run.claim("advance_to");
    return run.advance_to(t_end);
  });
}
void Simulator::functions_replaced() {
  with(run_, islands_, [](auto& run) {
    const Turn turn = run.claim("functions_replaced");
    run.functions_replaced();
  });
}
double Simulator::time() const noexcept {
  return with(run_, islands_, [](const auto& run) { return run.time(); });
}
Context Simulator::context() const {
  return with(run_, islands_, [](const auto& run) {
    const Turn turn = run.claim("context");
    return run.context();
  });
}
const Results& Simulator::results() const noexcept {
  return with(run_, islands_, [](const auto& run) -> const Results& { return run.results(); });
}
Results Simulator::take_results() {
  return with(run_, islands_, [](auto& run) {
    const Turn turn = run.claim("take_results");
    return run.take_results();
  });
}
const Plan& Simulator::plan() const noexcept {
  return with(run_, islands_, [](const auto& run) -> const Plan& { return run.plan(); });
}
std::string Simulator::describe() const {
  return with(run_, islands_,
              [](const auto& run) {
                const Turn turn = run.claim("describe");
                return run.describe();
              }) +
         (run_ && run_->options().islands ? islands_for(run_->plan(), run_->options()).describe()
                                          : "");
}

}  // namespace saltus
