// The runs of one search: whole ones with their derivatives, and the firings of a guard.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "run_states.hpp"
#include "saltus/simulation/detail/standstill.hpp"
#include "saltus/simulation/simulate.hpp"

namespace saltus {

/// Runs of one system with the same options. `where` begins the messages of refusals. Throws
/// ModelError for an option that the searches set themselves.
class OrbitRuns {
 public:
  OrbitRuns(std::string where, const System& system, SimulatorOptions options);

  const std::string& where() const noexcept { return where_; }
  const System& system() const noexcept { return system_; }
  /// The options of a simulator over `plan`, which all runs share.
  SimulatorOptions shared_options() const;
  const std::shared_ptr<const Plan>& plan() const noexcept { return plan_; }

  /// A run to `end` without derivatives; refused if it ends before.
  Results plain(const Context& context, double end);
  /// The same with dense output and recorded signals.
  Results dense(const Context& context, double end, RecordedSignals signals = {});
  /// With the derivatives by these start values and parameters.
  Results derived(const Context& context, double end, const std::vector<std::string>& names);
  /// The same with recorded signals.
  Results recorded(const Context& context, double end, const std::vector<std::string>& names,
                   RecordedSignals signals);
  /// d/dt of all states: discrete ones do not move.
  Eigen::VectorXd flow(const Context& context);

  /// The events of a run in which the section fired `count` times, and that went on by the part
  /// `beyond` of its length. The run grows until then; refused after `longest` seconds.
  EventLog firings(const Context& context, const std::string& section, int count, double longest,
                   double beyond = 0.0);

  /// Refuses a run that an event ended.
  void require_reached(const Results& results, Status status) const;

 private:
  Results through(Simulator& simulator, const Context& context, double end) const;
  Results once(const Context& context, double end, SimulatorOptions options) const;
  [[noreturn]] void ended_early(const Results& results, Status status) const;
  [[noreturn]] void refuse_unreached(const std::string& section, std::size_t found, int count,
                                     double begin, double longest) const;
  void require_zero_crossing(const EventLog& log, const std::string& section) const;

  std::string where_;
  const System& system_;
  SimulatorOptions options_;
  std::shared_ptr<const Plan> plan_;
  std::optional<Simulator> plain_, derived_;
  std::vector<std::string> derived_names_;
  std::optional<Standstill> still_;
  double span_ = 0.0;  // [s] of the last search for firings
};

/// Throws ModelError for an option of a run that a function sets itself.
void require_own_options(const std::string& where, const SimulatorOptions& options);

}  // namespace saltus
