// Ensembles: runs over one plan, in threads that acquire the interpreter lock only to call Python.
#include <atomic>

#include <pybind11/functional.h>
#include <pybind11/stl.h>

#include "interpreter.hpp"
#include "numbers.hpp"
#include "plan_tapes.hpp"
#include "python_results.hpp"
#include "saltus/base/list.hpp"
#include "saltus/simulation/outcomes.hpp"
#include "trace_pass.hpp"

namespace saltus::python {

namespace {

/// The memory of a column as an array of these dimensions; no copy.
template <class Number>
py::array moved(std::vector<Number>&& column, std::vector<py::ssize_t> dimensions) {
  auto* kept = new std::vector<Number>(std::move(column));
  const py::capsule owner(kept, [](void* all) { delete static_cast<std::vector<Number>*>(all); });
  return py::array_t<Number>(std::move(dimensions), kept->data(), owner);
}

/// The reason of each failed run, by number.
py::dict reasons(const Outcomes& outcomes) {
  py::dict all;
  for (std::size_t run = 0; run < outcomes.message.size(); ++run) {
    if (!outcomes.message[run].empty())
      all[py::int_(run)] = py::make_tuple(outcomes.message[run], outcomes.block[run]);
  }
  return all;
}

/// Columns by name, moved out of the C++ object.
py::dict columns(Outcomes&& o) {
  using py::literals::operator""_a;
  const auto runs = static_cast<py::ssize_t>(o.status.size());
  const auto wide = [&](auto& column) {
    const auto size = static_cast<py::ssize_t>(column.size());
    return moved(std::move(column), {runs, runs > 0 ? size / runs : 0});
  };
  py::dict signals;
  for (Outcomes::Signal& signal : o.signals) {
    Dimensions dimensions{runs};
    if (!o.times.empty()) dimensions.push_back(static_cast<py::ssize_t>(o.times.size()));
    signals[py::str(signal.name)] =
        moved(std::move(signal.values), dimensions_of(signal.shape, std::move(dimensions)));
  }
  const py::dict said = reasons(o);
  return py::dict("status"_a = moved(std::move(o.status), {runs}), "reasons"_a = said,
                  "end_time"_a = moved(std::move(o.end_time), {runs}),
                  "wall_time"_a = moved(std::move(o.wall_time), {runs}),
                  "events"_a = moved(std::move(o.events), {runs}),
                  "steps"_a = moved(std::move(o.steps), {runs}),
                  "continuous_state"_a = wide(o.continuous_state),
                  "discrete_state"_a = wide(o.discrete_state), "modes"_a = wide(o.modes),
                  "signals"_a = signals);
}

/// The Python exception, if it is more than the failure of one run, for example Ctrl-C.
bool ends_all(const Results& results) {
  if (!results.cause) return false;
  try {
    std::rethrow_exception(results.cause);
  } catch (const py::error_already_set& error) {
    const Locked lock;
    return !PyErr_GivenExceptionMatches(error.type().ptr(), PyExc_Exception);
  } catch (...) {
    return false;
  }
}

/// An ensemble, with the tapes of its plan.
struct PythonEnsemble {
  PythonEnsemble(Ensemble ensemble, const std::string& machine_code, const py::object& callbacks,
                 int series_order)
      : runs(std::move(ensemble)),
        tapes(runs.plan(), machine_code_when(machine_code), interpreted_by(callbacks),
              series_order) {}

  Ensemble runs;
  PlanTapes tapes;
};

/// A call of Ensemble::run from Python.
class Call {
 public:
  Call(PythonEnsemble& all, std::vector<double> times, py::object watch, py::object each)
      : ensemble_(&all.runs),
        tapes_(&all.tapes),
        outcomes_(all.runs, std::move(times)),
        watch_(std::move(watch)),
        each_(std::move(each)) {}

  /// The columns, and the exception, or None.
  py::tuple run(int threads) {
    try {
      tapes_->begin();
      const Unlocked runs;
      ensemble_->run([this](Index run, const Results& results) { take(run, results); },
                     {.threads = threads,
                      .watch = [this](Index done) { return look(done); },
                      .around = &with_thread_state});
      tapes_->end(evaluations(), counted_);
    } catch (const py::error_already_set& error) {
      if (error.trace()) PyException_SetTraceback(error.value().ptr(), error.trace().ptr());
      raised_ = error.value();
    }
    return py::make_tuple(columns(std::move(outcomes_)), raised_);
  }

 private:
  Evaluations evaluations() const { return {derivatives_, guards_, jacobians_, steps_}; }

  void take(Index run, const Results& results) {
    derivatives_ += results.statistics.right_hand_side_calls;
    guards_ += results.statistics.guard_calls;
    jacobians_ += results.statistics.jacobian_calls;
    steps_ += results.statistics.steps;
    outcomes_.take(run, results);
    if (ends_all(results)) {
      nth(outcomes_.status, run) = static_cast<int>(Status::interrupted);
      std::rethrow_exception(results.cause);
    }
    if (each_.is_none()) return;
    locked([&] {
      auto copy = std::make_shared<Record>(results);
      copy->cause = nullptr;  // it would refer to the frames through which it passed
      ask(each_, run, copy, cause_of(results));
    });
  }

  /// Handles signals, and reports the number of finished runs.
  bool look(Index done) {
    tapes_->consider(evaluations(), counted_);
    return locked([&] {
      if (PyErr_CheckSignals() != 0) throw py::error_already_set();
      return !watch_.is_none() && ask(watch_, done).cast<bool>();
    });
  }

  /// A thread keeps its interpreter state from one call of Python to the next.
  static void with_thread_state(const std::function<void()>& share) {
    const Locked lock;
    const Unlocked runs;
    share();
  }

  const Ensemble* ensemble_;
  PlanTapes* tapes_;
  double counted_ = 0.0;  // see PlanTapes::consider
  std::atomic<std::int64_t> derivatives_ = 0, guards_ = 0, jacobians_ = 0,
                            steps_ = 0;  // of finished runs
  Outcomes outcomes_;
  py::object watch_, each_, raised_ = py::none();
};

void vary(Ensemble& ensemble, const std::string& name, py::handle values) {
  const Array numbers = to_array(values, text("'", name, "'"));
  const auto* first = numbers.data();
  ensemble.vary(name, {first, first + numbers.size()},
                numbers.ndim() == 2 ? static_cast<Index>(numbers.shape(1)) : 1);
}

std::vector<std::string> state_names(const Ensemble& ensemble, std::string_view kind) {
  std::vector<std::string> names;
  const Layout& layout = ensemble.base().layout();
  const auto add = [&](const Layout::Leaf& leaf, const char* state, Index size) {
    for (Index i = 0; i < size; ++i)
      names.push_back(layout.name_of(leaf, text(state, "[", i, "]")));
  };
  for (const Layout::Leaf& leaf : layout.leaves) {
    if (kind == "mode")
      names.push_back(leaf.of_diagram ? joined_name(leaf.path, "parameters") : leaf.path);
    if (kind == "x") add(leaf, "x", leaf.nx);
    if (kind == "z") add(leaf, "z", leaf.nz);
  }
  return names;
}

bool has_modes(const Ensemble& ensemble) {
  return std::ranges::any_of(ensemble.plan().leaves,
                             [](const PlanLeaf& leaf) { return leaf.declared().has_modes; });
}

}  // namespace

void bind_ensemble(py::module_& module) {
  py::class_<PythonEnsemble>(module, "Ensemble")
      .def(py::init([](const System& system, const Context& base, std::pair<double, double> span,
                       SimulatorOptions options, const py::object& callbacks,
                       const std::string& machine_code) {
             options.refinement = trace_pass(callbacks);
             const int order = series_order(options);
             Ensemble runs(system, base, TimeSpan{span.first, span.second}, std::move(options));
             return new PythonEnsemble(std::move(runs), machine_code, callbacks, order);
           }),
           py::keep_alive<1, 2>())
      .def("vary", [](PythonEnsemble& e, const std::string& name,
                      py::handle values) { vary(e.runs, name, values); })
      .def(
          "run",
          [](PythonEnsemble& ensemble, int threads, std::vector<double> times, py::object watch,
             py::object each) {
            return Call(ensemble, std::move(times), std::move(watch), std::move(each)).run(threads);
          })
      .def("state_names",
           [](const PythonEnsemble& e, std::string_view kind) { return state_names(e.runs, kind); })
      .def_property_readonly("has_modes", [](const PythonEnsemble& e) { return has_modes(e.runs); })
      .def_property_readonly("size", [](const PythonEnsemble& e) { return e.runs.size(); });

  module.def("status_names", [] {
    std::vector<std::string> names;
    for (int i = 0; i <= static_cast<int>(Status::failed); ++i)
      names.emplace_back(to_string(static_cast<Status>(i)));
    return names;
  });
  module.def("find_entry", [](const Context& context, std::string_view name) {
    return find_entry(context.layout(), name).size;
  });
  module.def("with_entry", [](Context context, const std::string& name, py::handle values) {
    const Array numbers = to_array(values, text("'", name, "'"));
    write_entry(context, find_entry(context.layout(), name),
                {numbers.data(), static_cast<std::size_t>(numbers.size())}, name);
    return context;
  });
  module.def("entry_names", [](const Context& context) { return entry_names(context.layout()); });
}

}  // namespace saltus::python
