// PlanTapes: the tapes of one plan, and when they become machine code.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

#include "saltus/plan/plan.hpp"
#include "saltus/simulation/options.hpp"
#include "saltus/solver/detail/taylor/step_rule.hpp"
#include "saltus/tape/series.hpp"
#include "saltus/tape/tape.hpp"

namespace saltus::python {

/// The values of the option `machine_code`.
enum class MachineCodeWhen { never, automatic, always };
MachineCodeWhen machine_code_when(std::string_view word);

/// The order of the Taylor series of the states; 0 if the method has none.
inline int series_order(const SimulatorOptions& options) {
  return options.ode_solver_method == Method::taylor ? taylor::order_of(options.rtol) : 0;
}

/// The instructions that the runs of one system have evaluated since its tapes were compiled last,
/// and those of its last run alone.
struct Interpreted {
  std::atomic<double> all = 0.0, last_run = 0.0;
};

/// The evaluations of a run, or of several.
struct Evaluations {
  std::int64_t derivatives = 0, guards = 0, jacobians = 0, steps = 0;
};

/// Tapes that are compiled together.
struct TapeGroup {
  std::vector<tape::Tape> tapes = {};
  std::vector<tape::SeriesOrder> series = {};
  double instructions = 0.0;  // of all
  bool done = false;          // compiled, or never to be
};

/// Compiles the tapes of a plan once it pays, by python/saltus/jit/. Without llvmlite nothing
/// happens, except that `always` is an error. Several runs of the plan may use it at the same time:
/// while one of them compiles, the others continue with the tapes that they have.
class PlanTapes {
 public:
  /// `order` is that of the Taylor series of the states, 0 if the method has none.
  PlanTapes(const Plan& plan, MachineCodeWhen when, std::shared_ptr<Interpreted> interpreted,
            int order);

  /// Before a run: compiles with `always`, and if the last run of the system was long enough.
  void begin();
  /// During or after a run that has made so many evaluations since it began. `counted`: the
  /// instructions of this run that `end` has counted, 0 when it begins.
  void consider(const Evaluations& now, double counted);
  /// After a run, or a piece of it: counts. The next run decides whether to compile.
  void end(const Evaluations& now, double& counted);
  /// The plan has other tapes now, perhaps within a run.
  void renew();

  std::string describe() const;

 private:
  void read_plan();
  void read_series();
  bool always() const { return when_ == MachineCodeWhen::always; }
  void compile_if_pays(TapeGroup& group, double interpreted);
  double run_instructions(const Evaluations& evaluations) const;

  const Plan* plan_;
  MachineCodeWhen when_;
  std::shared_ptr<Interpreted> interpreted_;
  int order_;
  // Jacobians are compiled when one was needed: their tapes are long, and most methods need none.
  TapeGroup run_, jacobians_;
  double by_derivative_ = 0.0, by_guards_ = 0.0, by_step_ = 0.0;  // instructions
  std::mutex compiling_;
};

}  // namespace saltus::python
