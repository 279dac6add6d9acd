// Simulator and its options. The interpreter lock is released for a whole run.
#include <chrono>
#include <variant>
#include <vector>

#include <pybind11/functional.h>
#include <pybind11/stl.h>

#include "interpreter.hpp"
#include "names.hpp"
#include "numbers.hpp"
#include "python_plan.hpp"
#include "python_results.hpp"
#include "saltus/simulation/simulator.hpp"

namespace saltus::python {

namespace {

using NamedPort = std::tuple<std::string, const System*, int>;

/// A Simulator that handles signals such as Ctrl-C and lets Python raise their exceptions.
class PythonSimulator {
 public:
  PythonSimulator(std::shared_ptr<PythonPlan> plan, py::object progress)
      : progress_(std::move(progress)),
        plan_(std::move(plan)),
        simulator_(plan_->plan(), prepared(plan_->options())) {}
  PythonSimulator(const PythonSimulator&) = delete;
  PythonSimulator& operator=(const PythonSimulator&) = delete;

  void initialize(const Context& context) {
    plan_->tapes().begin();
    counted_ = 0.0;
    simulator_.initialize(context);
    shown_ = nullptr;
  }

  std::string_view advance_to(double t_end) {
    plan_->tapes().begin();  // it may have other tapes since the last piece
    put_back();
    const Unlocked run;
    const Status status = simulator_.advance_to(t_end);
    plan_->tapes().end(evaluations(), counted_);
    return to_string(status);
  }

  /// Everything since initialize(), moved out, and the exception, or None. If the run continues, it
  /// takes the shown results back, or a copy. An exception refers to the frames through which it
  /// passed, and they refer to this simulator. So no C++ object may keep the exception, or the two
  /// would keep each other alive.
  py::tuple results() {
    if (shown_) return py::make_tuple(shown_, py::none());
    const py::object raised = own().cause ? cause_of(own()) : std::exchange(signalled_, py::none());
    own().cause = nullptr;
    shown_ = std::make_shared<Record>(simulator_.take_results(), true);
    // Ctrl-C, perhaps in a function of the model.
    if (PyErr_GivenExceptionMatches(raised.ptr(), PyExc_KeyboardInterrupt)) {
      shown_->status = Status::interrupted;
      shown_->message = text("t = ", shown_->context.time(), " s: interrupted");
    }
    return py::make_tuple(shown_, raised);
  }

  /// The results of a run that does not continue: their arrays are the memory itself.
  py::tuple last_results() {
    const py::tuple last = results();
    std::exchange(shown_, nullptr)->goes_on = false;
    return last;
  }

  /// Uses the present traces from now on, see TracePass.
  bool replace_traces() {
    const bool replaced = plan_->replace_traces();
    if (replaced) simulator_.functions_replaced();
    plan_->tapes().renew();  // comes last, because the series are made anew before it
    return replaced;
  }

  std::string describe() const { return simulator_.describe() + plan_->tapes().describe(); }

  const Simulator& simulator() const { return simulator_; }

 private:
  /// The engine's results are const, but they are part of this object's own simulator.
  Results& own() { return const_cast<Results&>(simulator_.results()); }

  /// Gives the shown results back to the engine. Results that Python still has do not change. The
  /// engine keeps its own status: if Ctrl-C ended a function of the model, Python shows
  /// "interrupted", and the engine "failed".
  void put_back() {
    if (!shown_) return;
    Results& shown = *shown_;
    const Status status = own().status;
    if (shown_.use_count() == 1)
      own() = std::move(shown);
    else
      own() = shown;
    own().status = status;
    shown_ = nullptr;
  }

  SimulatorOptions prepared(SimulatorOptions options) {
    options.interrupt = [this, asked = std::move(options.interrupt)] {
      if (signal_arrived()) return true;
      if (!progress_.is_none()) report();
      plan_->tapes().consider(evaluations(), counted_);
      return asked && asked();
    };
    return options;
  }

  Evaluations evaluations() const {
    const Statistics& s = simulator_.results().statistics;
    return {s.right_hand_side_calls, s.guard_calls, s.jacobian_calls, s.steps};
  }

  /// Reports the progress of the run, at most ten times a second.
  void report() {
    const auto now = std::chrono::steady_clock::now();
    if (now - reported_ < std::chrono::milliseconds(100)) return;
    reported_ = now;
    locked([&] { ask(progress_, simulator_.time(), simulator_.results().statistics.events); });
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
  std::shared_ptr<PythonPlan> plan_;
  Simulator simulator_;
  std::shared_ptr<Record> shown_;  // results that Python has; null if the engine has them
  double counted_ = 0.0;           // see PlanTapes::consider
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

  py::class_<PythonPlan, std::shared_ptr<PythonPlan>>(module, "Plan")
      .def(py::init<const System&, SimulatorOptions, const py::object&, const std::string&>())
      .def_property_readonly("blocks", [](const PythonPlan& p) { return p.plan()->leaves.size(); });

  py::class_<PythonSimulator>(module, "Simulator")
      .def(py::init<std::shared_ptr<PythonPlan>, py::object>())
      .def("initialize", &PythonSimulator::initialize)
      .def("advance_to", &PythonSimulator::advance_to)
      .def("replace_traces", &PythonSimulator::replace_traces)
      .def("results", &PythonSimulator::results)
      .def("last_results", &PythonSimulator::last_results)
      .def_property_readonly("time", [](const PythonSimulator& s) { return s.simulator().time(); })
      .def_property_readonly(
          "events",
          [](const PythonSimulator& s) { return s.simulator().results().statistics.events; })
      .def_property_readonly("context",
                             [](const PythonSimulator& s) { return s.simulator().context(); })
      .def("describe", &PythonSimulator::describe);
}

}  // namespace saltus::python
