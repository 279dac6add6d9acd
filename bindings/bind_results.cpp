// Results: columns as NumPy arrays over the C++ memory, which lives as long as any of them, or over
// copies.
#include <algorithm>
#include <sstream>

#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include "interpreter.hpp"
#include "numbers.hpp"
#include "python_results.hpp"

namespace saltus::python {

namespace {

using SharedRecord = std::shared_ptr<Record>;

template <class Number>
py::array column(const SharedRecord& results, std::vector<Number>& values,
                 std::vector<py::ssize_t> dimensions) {
  if (results->goes_on) return py::array_t<Number>(std::move(dimensions), values.data());
  const py::capsule owner(new SharedRecord(results),
                          [](void* shared) { delete static_cast<SharedRecord*>(shared); });
  return py::array_t<Number>(std::move(dimensions), values.data(), owner);
}

py::ssize_t rows(const SharedRecord& results) {
  return static_cast<py::ssize_t>(results->time.size());
}

/// The number of rows of a signal: those of its island, if it has one.
py::ssize_t rows(const SharedRecord& results, const RecordedSignal& signal) {
  if (signal.island < 0) return rows(results);
  return static_cast<py::ssize_t>(nth(results->islands, signal.island).time.size());
}

py::dict outputs(const SharedRecord& results) {
  py::dict all;
  for (RecordedSignal& signal : results->signals) {
    Dimensions dimensions = dimensions_of(signal.shape, {rows(results, signal)});
    all[py::str(signal.name)] = column(results, signal.values, std::move(dimensions));
  }
  return all;
}

/// The continuous state and the recorded signals at each of `times`. It needs the interpreter only
/// if the model has Python functions.
py::tuple at(const SharedRecord& results, const std::vector<double>& times, bool left) {
  std::vector<double> states;
  std::vector<std::vector<double>> signals(results->signals.size());
  {
    const Unlocked unlock;
    DenseOutput dense(results->trajectory);
    for (const double t : times) {
      dense.move_to(t, left ? Side::left : Side::right);
      const auto append = [](std::vector<double>& to, const VectorView& values) {
        to.insert(to.end(), values.begin(), values.end());
      };
      append(states, dense.state());
      for (std::size_t i = 0; i < signals.size(); ++i) append(signals[i], dense.signal(i));
    }
  }
  const auto n = static_cast<py::ssize_t>(times.size());
  py::dict outputs;
  for (std::size_t i = 0; i < signals.size(); ++i) {
    outputs[py::str(results->signals[i].name)] =
        py::array_t<double>(dimensions_of(results->signals[i].shape, {n}), signals[i].data());
  }
  const py::ssize_t width = results->trajectory.plan()->nx;
  return py::make_tuple(py::array_t<double>({n, width}, states.data()), outputs);
}

/// The derivatives of these values at each of `times`, with the parameter as their last axis.
py::tuple sensitivities_at(const SharedRecord& results, const std::vector<double>& times,
                           bool left) {
  std::vector<double> states;
  std::vector<std::vector<double>> signals(results->signals.size());
  {
    const Unlocked unlock;
    DenseSensitivities dense(results->trajectory, results->sensitivities);
    for (const double t : times) {
      dense.move_to(t, left ? Side::left : Side::right);
      const auto append = [](std::vector<double>& to, const Eigen::MatrixXd& values) {
        for (const auto& row : values.rowwise()) to.insert(to.end(), row.begin(), row.end());
      };
      append(states, dense.state());
      for (std::size_t i = 0; i < signals.size(); ++i) append(signals[i], dense.signal(i));
    }
  }
  const auto n = static_cast<py::ssize_t>(times.size());
  const auto m = static_cast<py::ssize_t>(results->sensitivities.size());
  py::dict outputs;
  for (std::size_t i = 0; i < signals.size(); ++i) {
    Dimensions dimensions = dimensions_of(results->signals[i].shape, {n});
    dimensions.push_back(m);
    outputs[py::str(results->signals[i].name)] =
        py::array_t<double>(std::move(dimensions), signals[i].data());
  }
  const py::ssize_t width = results->trajectory.plan()->nx;
  return py::make_tuple(py::array_t<double>({n, width, m}, states.data()), outputs);
}

py::array copy_of(std::span<const double> values) {
  return py::array_t<double>(static_cast<py::ssize_t>(values.size()), values.data());
}

/// An event, in the order of the fields of saltus.results.Event.
py::tuple event(const Record& results, std::size_t i) {
  if (i >= results.events.size())
    throw py::index_error(text("event ", i, " of ", results.events.size()));
  const Event e = results.events[i];
  py::tuple rests(e.rests.size());
  for (std::size_t k = 0; k < e.rests.size(); ++k) rests[k] = e.rests[k];
  return py::make_tuple(e.time, e.jump, to_string(e.kind), e.direction, e.block, e.name,
                        is_of_queue(e.kind) ? e.due : e.predicted, copy_of(e.before),
                        copy_of(e.after), e.entry, rests);
}

/// If no kind is given, the times of all events that fired.
py::array event_times(const Record& results, std::string_view name,
                      std::optional<std::string_view> kind) {
  if (!kind) return copy_of(results.events.times(name));
  std::vector<std::string> known;
  for (int i = 0; i <= static_cast<int>(EventKind::executed); ++i) {
    const auto one = static_cast<EventKind>(i);
    if (to_string(one) == kind) return copy_of(results.events.times(name, one));
    known.emplace_back(to_string(one));
  }
  throw ModelError(text("unknown kind of event '", *kind, "'", known_names(*kind, known)));
}

/// The counts, by the names of the fields of saltus.results.Statistics.
py::dict counts_of(const Statistics& s) {
  py::dict by_name;
  for (const auto& [name, count] : s.events_by_name) by_name[py::str(name)] = count;
  using py::literals::operator""_a;
  py::list stretches;
  for (const Stretch& part : s.stretches)
    stretches.append(py::make_tuple(part.method, part.begin, part.end, part.steps));
  return py::dict("method"_a = s.method, "stretches"_a = stretches, "steps"_a = s.steps,
                  "rejected"_a = s.rejected, "restarts"_a = s.restarts,
                  "right_hand_side_calls"_a = s.right_hand_side_calls,
                  "guard_calls"_a = s.guard_calls, "jacobian_calls"_a = s.jacobian_calls,
                  "linear_setups"_a = s.linear_setups, "linear_solver"_a = s.linear_solver,
                  "instants"_a = s.instants, "events"_a = s.events, "events_by_name"_a = by_name,
                  "wall_time"_a = s.wall_time);
}

py::dict statistics(const Record& results) { return counts_of(results.statistics); }

/// The islands that stepped apart, each in the order of the fields of saltus.results.Island.
py::list islands(const SharedRecord& results) {
  py::list all;
  for (std::size_t k = 0; k < results->islands.size(); ++k) {
    IslandResults& island = results->islands[k];
    py::list signals;
    for (const RecordedSignal& signal : results->signals)
      if (signal.island == static_cast<int>(k)) signals.append(signal.name);
    const auto n = static_cast<py::ssize_t>(island.time.size());
    all.append(py::make_tuple(island.name, island.blocks, column(results, island.time, {n}),
                              column(results, island.jump, {n}), counts_of(island.statistics),
                              py::tuple(signals)));
  }
  return all;
}

/// The derivatives, in the form of saltus.results.Sensitivities; None if nobody asked for them.
py::object sensitivities(const SharedRecord& results) {
  const Sensitivities& all = results->sensitivities;
  if (all.empty()) return py::none();
  const auto m = static_cast<py::ssize_t>(all.size());
  const auto table = [m](const std::vector<double>& values) {
    return py::array_t<double>({static_cast<py::ssize_t>(values.size()) / m, m}, values.data());
  };
  py::dict outputs;
  for (std::size_t i = 0; i < all.signals.size(); ++i) {
    const RecordedSignal& signal = results->signals[i];
    Dimensions dimensions = dimensions_of(signal.shape, {rows(results, signal)});
    dimensions.push_back(m);
    outputs[py::str(signal.name)] =
        py::array_t<double>(std::move(dimensions), all.signals[i].data());
  }
  py::list gaps;
  for (const SensitivityGap& gap : all.gaps)
    gaps.append(py::make_tuple(gap.time, gap.event, gap.parameter, gap.reason));
  using py::literals::operator""_a;
  return py::dict("parameters"_a = all.parameters, "outputs"_a = outputs,
                  "event_times"_a = table(all.event_times), "predicted"_a = table(all.predicted),
                  "continuous_state"_a = table(all.continuous_state),
                  "discrete_state"_a = table(all.discrete_state), "gaps"_a = gaps);
}

}  // namespace

py::object cause_of(const Results& results) {
  if (!results.cause) return py::none();
  try {
    std::rethrow_exception(results.cause);
  } catch (const py::error_already_set& error) {
    if (error.trace()) PyException_SetTraceback(error.value().ptr(), error.trace().ptr());
    return error.value();
  } catch (const SimulationError& error) {
    return as_python(error);
  } catch (const ModelError& error) {
    return as_python(error, "ModelError");
  } catch (const std::exception& error) {
    return ask(error_class("Error"), error.what());
  }
}

void bind_results(py::module_& module) {
  py::class_<Record, SharedRecord>(module, "Results")
      .def_property_readonly("time",
                             [](const SharedRecord& r) { return column(r, r->time, {rows(r)}); })
      .def_property_readonly("jump",
                             [](const SharedRecord& r) { return column(r, r->jump, {rows(r)}); })
      .def_property_readonly("outputs", &outputs)
      .def_property_readonly("islands", &islands)
      .def_property_readonly("apart",
                             [](const Record& r) {
                               return std::ranges::any_of(r.signals, [](const RecordedSignal& s) {
                                 return s.island >= 0;
                               });
                             })
      .def_readonly("context", &Results::context)
      .def_property_readonly("status", [](const Record& r) { return to_string(r.status); })
      .def_readonly("message", &Results::message)
      .def_readonly("block", &Results::block)
      .def_property_readonly("statistics", &statistics)
      .def_property_readonly("sensitivities", &sensitivities)
      .def_property_readonly("event_count", [](const Record& r) { return r.events.size(); })
      .def_property_readonly("event_names", [](const Record& r) { return r.events.names(); })
      .def_property_readonly("dense", [](const Record& r) { return !r.trajectory.empty(); })
      .def_property_readonly(
          "span",
          [](const Record& r) { return py::make_tuple(r.trajectory.begin(), r.trajectory.end()); })
      .def_property_readonly(
          "joints", [](const Record& r) { return py::array(py::cast(r.trajectory.joints())); })
      .def("__repr__",
           [](const Record& r) {
             std::ostringstream out;
             out << static_cast<const Results&>(r);
             return out.str();
           })
      .def("at", &at)
      .def("sensitivities_at", &sensitivities_at)
      .def("event", &event)
      .def("event_times", &event_times);
}

}  // namespace saltus::python
