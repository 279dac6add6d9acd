// The work-precision report. It runs without the interpreter lock; functions of the model or of the
// known answer acquire it for each call.
#include <pybind11/functional.h>
#include <pybind11/stl.h>

#include <sstream>

#include "interpreter.hpp"
#include "names.hpp"
#include "python_scene.hpp"
#include "saltus/report/written.hpp"
#include "trace_pass.hpp"

namespace saltus::python {

namespace {

/// Throws the exception of a signal handler, such as KeyboardInterrupt.
bool check_signals() {
  return locked([] {
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    return false;
  });
}

/// Ctrl-C in a run ends the whole report, not only the run.
void check_run(const Results* results) {
  check_signals();
  if (results == nullptr || !results->cause) return;
  try {
    std::rethrow_exception(results->cause);
  } catch (py::error_already_set& error) {
    const Locked lock;
    if (!error.matches(PyExc_Exception)) throw;
  } catch (const std::exception&) {  // the row has the reason
  }
}

/// The report as JSON.
std::string work_precision_json(Scene scene, WorkOptions work, std::string name,
                                std::string title) {
  scene.name = std::move(name);
  scene.options.interrupt = check_signals;
  work.between = check_run;
  const Unlocked unlock;
  WorkReport report = work_precision(std::move(scene), work);
  report.title = std::move(title);
  std::ostringstream out;
  write_json(out, report);
  return out.str();
}

void set_samples(Scene& scene, const std::vector<double>& times, const py::sequence& rows,
                 bool exact, std::string provenance) {
  scene.exact.samples.clear();
  for (std::size_t i = 0; i < times.size(); ++i)
    scene.exact.samples.push_back(
        {times[i], to_vector(rows[i], text("reference at t = ", times[i], " s"))});
  scene.exact.samples_are_exact = exact;
  scene.exact.provenance = std::move(provenance);
}

/// The scene's system belongs to the Python object, which must outlive it. All its blocks are
/// traced: the report makes plans of it without the lock.
std::shared_ptr<Scene> user_scene(const System& system, const Context& context,
                                  std::pair<double, double> span, SimulatorOptions options,
                                  const py::object& callbacks) {
  if (const auto pass = trace_pass(callbacks)) options.refinement = pass->of_known();
  return std::make_shared<Scene>(
      Scene{.name = system.name(),
            .system = std::shared_ptr<const System>(std::shared_ptr<void>(), &system),
            .context = context,
            .span = {span.first, span.second},
            .options = std::move(options)});
}

}  // namespace

void bind_report(py::module_& module) {
  py::class_<WorkOptions>(module, "WorkOptions")
      .def(py::init<>())
      .def_readwrite("methods", &WorkOptions::methods)
      .def_readwrite("rtols", &WorkOptions::rtols)
      .def_readwrite("atol_over_rtol", &WorkOptions::atol_over_rtol)
      .def_readwrite("time_limit", &WorkOptions::time_limit)
      .def_property(
          "least_time", [](const WorkOptions& w) { return w.timing.least_time; },
          [](WorkOptions& w, double seconds) { w.timing.least_time = seconds; })
      .def_property(
          "most_repeats", [](const WorkOptions& w) { return w.timing.most_repeats; },
          [](WorkOptions& w, int most) { w.timing.most_repeats = most; });

  module.def("user_scene", &user_scene, py::keep_alive<0, 1>());
  module.def("set_samples", &set_samples);
  module.def("set_event_times",
             [](Scene& scene, const std::vector<std::pair<std::string, std::vector<double>>>& all) {
               scene.exact.events.clear();
               for (const auto& [guard, times] : all)
                 scene.exact.events.push_back({guard, {{.times = times}}});
             });
  module.def("add_invariant", [](Scene& scene, const std::string& name, py::object value) {
    scene.invariants.push_back(
        {name, row_function(std::move(value), text("invariant '", name, "'"))});
  });
  module.def("set_gap",
             [](Scene& scene, py::object gap) { scene.gap = row_function(std::move(gap), "gap"); });
  module.def("work_precision", &work_precision_json);
}

}  // namespace saltus::python
