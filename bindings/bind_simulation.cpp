// Simulator and its options. The interpreter lock is released for a whole run.
#include <chrono>
#include <variant>
#include <vector>

#include <pybind11/functional.h>
#include <pybind11/stl.h>

#include "interpreter.hpp"
#include "names.hpp"
#include "numbers.hpp"
#include "plan_tapes.hpp"
#include "python_results.hpp"
#include "saltus/simulation/detail/option_table.hpp"
#include "saltus/simulation/simulator.hpp"
#include "trace_pass.hpp"

namespace saltus::python {

namespace {

using NamedPort = std::tuple<std::string, const System*, int>;

/// A Simulator that handles signals such as Ctrl-C and lets Python raise their exceptions.
class PythonSimulator {
 public:
  PythonSimulator(const System& system, SimulatorOptions options, py::object progress,
                  const py::object& callbacks, const std::string& machine_code)
      : progress_(std::move(progress)),
        pass_(trace_pass(callbacks)),
        simulator_(system, prepared(std::move(options))),
        tapes_(simulator_.plan(), machine_code_when(machine_code), interpreted_by(callbacks)) {
    if (pass_) pass_->end();
  }
  PythonSimulator(const PythonSimulator&) = delete;
  PythonSimulator& operator=(const PythonSimulator&) = delete;

  void initialize(const Context& context) {
    tapes_.begin();
    simulator_.initialize(context);
  }

  void advance_to(double t_end) {
    const Unlocked run;
    simulator_.advance_to(t_end);
    tapes_.end(evaluations());
  }

  /// Everything since initialize(), moved out or copied, and the exception, or None. An exception
  /// refers to the frames it went through, and they refer to this simulator. So no C++ object may
  /// keep the exception, or the two would keep each other alive.
  py::tuple results(bool take) {
    // The engine's results are const, but they are part of this object's own simulator.
    auto& now = const_cast<Results&>(simulator_.results());
    const py::object raised = now.cause ? cause_of(now) : std::exchange(signalled_, py::none());
    now.cause = nullptr;
    auto results = std::make_shared<Results>(take ? simulator_.take_results() : now);
    // Ctrl-C, perhaps in a function of the model.
    if (PyErr_GivenExceptionMatches(raised.ptr(), PyExc_KeyboardInterrupt)) {
      results->status = Status::interrupted;
      results->message = text("t = ", results->context.time(), " s: interrupted");
    }
    return py::make_tuple(results, raised);
  }

  /// Runs the present traces from now on, see TracePass.
  bool replace_traces() {
    if (!pass_) return true;
    const bool replaced = pass_->replace();
    tapes_.renew();
    return replaced;
  }

  std::string describe() const { return simulator_.describe() + tapes_.describe(); }

  const Simulator& simulator() const { return simulator_; }

 private:
  SimulatorOptions prepared(SimulatorOptions options) {
    options.refinement = pass_;
    options.throw_errors = false;
    options.interrupt = [this, asked = std::move(options.interrupt)] {
      if (signal_arrived()) return true;
      if (!progress_.is_none()) report();
      tapes_.consider(evaluations());
      return asked && asked();
    };
    return options;
  }

  Evaluations evaluations() const {
    const Statistics& s = simulator_.results().statistics;
    return {s.right_hand_side_calls, s.guard_calls, s.jacobian_calls};
  }

  /// Reports the progress of the run, at most ten times a second.
  void report() {
    const auto now = std::chrono::steady_clock::now();
    if (now - reported_ < std::chrono::milliseconds(100)) return;
    reported_ = now;
    locked([&] { progress_(simulator_.time(), simulator_.results().statistics.events); });
  }

  /// Ctrl-C ends the run well; any other exception of a signal handler counts as an exception of
  /// the model.
  bool signal_arrived() {
    return locked([&] {
      if (PyErr_CheckSignals() == 0) return false;
      py::error_already_set error;
      if (!error.matches(PyExc_KeyboardInterrupt)) throw error;
      signalled_ = error.value();
      return true;
    });
  }

  py::object signalled_ = py::none();
  py::object progress_;
  std::chrono::steady_clock::time_point reported_{};
  std::shared_ptr<TracePass> pass_;  // null: every function is called
  Simulator simulator_;
  PlanTapes tapes_;
};

void set_recorded_signals(SimulatorOptions& options, const std::vector<NamedPort>& signals) {
  options.recorded_signals.clear();
  for (const auto& [name, system, index] : signals)
    options.recorded_signals.push_back({name, {system, index}});
}

/// A number, or an array of one number for each state.
Tolerance tolerance_from(py::handle value, const char* name) {
  const Array numbers = to_array(value, text("option ", name));
  if (numbers.ndim() == 0) return *numbers.data();
  if (numbers.ndim() == 1)
    return std::vector<double>(numbers.data(), numbers.data() + numbers.size());
  throw ModelError(text("option ", name, ": expected one number, or a list of one number for each ",
                        "continuous state; found an array of ", numbers.ndim(), " dimensions"));
}

void bind_tolerance(py::class_<SimulatorOptions>& options,
                    const detail::Option<Tolerance>& option) {
  const auto member = option.member;
  options.def_property(
      option.name,
      [member](const SimulatorOptions& o) -> std::variant<double, std::vector<double>> {
        const Tolerance& tolerance = o.*member;
        if (tolerance.by_state()) return tolerance.each();
        return tolerance.smallest();
      },
      [member, name = option.name](SimulatorOptions& o, py::handle value) {
        o.*member = tolerance_from(value, name);
      });
}

}  // namespace

void bind_simulation(py::module_& module) {
  py::class_<SimulatorOptions> options(module, "SimulatorOptions");
  options.def(py::init<>()).def("set_recorded_signals", &set_recorded_signals);
  detail::for_each_option([&]<class T>(const detail::Option<T>& option) {
    if constexpr (std::is_same_v<T, Tolerance>)
      bind_tolerance(options, option);
    else
      options.def_readwrite(option.name, option.member);
  });

  py::class_<PythonSimulator>(module, "Simulator")
      .def(py::init<const System&, SimulatorOptions, py::object, const py::object&,
                    const std::string&>())
      .def("initialize", &PythonSimulator::initialize)
      .def("advance_to", &PythonSimulator::advance_to)
      .def("replace_traces", &PythonSimulator::replace_traces)
      .def("results", &PythonSimulator::results)
      .def_property_readonly("time", [](const PythonSimulator& s) { return s.simulator().time(); })
      .def_property_readonly(
          "events",
          [](const PythonSimulator& s) { return s.simulator().results().statistics.events; })
      .def_property_readonly("context",
                             [](const PythonSimulator& s) { return s.simulator().context(); })
      .def("describe", &PythonSimulator::describe);
}

}  // namespace saltus::python
