// LeafSystem: the functions with which python/saltus/leaf_system/ declares blocks.
#include <pybind11/stl.h>

#include "made.hpp"
#include "numbers.hpp"
#include "saltus/library/rate_transition.hpp"
#include "zero_crossing.hpp"

namespace saltus::python {

namespace {

/// Shows the functions that a block holds to the garbage collector, so a lambda that holds its
/// block is no leak.
void let_collect(PyHeapTypeObject* heap_type) {
  PyTypeObject& type = heap_type->ht_type;
  type.tp_flags |= Py_TPFLAGS_HAVE_GC;
  type.tp_traverse = [](PyObject* self, visitproc visit, void* arg) {
    Py_VISIT(Py_TYPE(self));
    if (!holds_block(self)) return 0;
    return py::cast<const PythonLeaf&>(py::handle(self)).traverse(visit, arg);
  };
  type.tp_clear = [](PyObject* self) {
    if (holds_block(self)) py::cast<PythonLeaf&>(py::handle(self)).clear();
    return 0;
  };
}

PythonLeaf& leaf_of(py::handle self) { return self.cast<PythonLeaf&>(); }

/// () is a scalar, (n,) is a vector of n entries, (m, n) a matrix of m rows.
std::optional<Shape> shape_from(const std::optional<Dimensions>& dimensions,
                                const std::string& what) {
  return dimensions ? std::optional(shape_of(*dimensions, what)) : std::nullopt;
}

/// A state of more than two dimensions is shown as a vector of its numbers.
Shape shape_of_state(const Dimensions& dimensions, Index size) {
  return dimensions.size() > 2 ? Shape::of(size) : shape_of(dimensions, "state");
}

/// Entries of a Jacobian as (row, column).
using Places = std::vector<std::pair<Index, Index>>;

void declare_continuous_state(py::handle self, py::handle initial, py::object ode,
                              const InputList& inputs, py::object jacobian,
                              const std::optional<Places>& sparsity, py::object sparse_jacobian,
                              bool formula, std::vector<std::string> names,
                              py::object derivatives) {
  PythonLeaf& leaf = leaf_of(self);
  const Array values = to_array(initial, text("block '", leaf.name(), "': continuous state"));
  ContinuousState state{.initial = as_vector(values), .names = std::move(names), .inputs = inputs};
  if (!ode.is_none())
    state.ode = leaf.vector_function(
        leaf.add(self, std::move(ode),
                 {.inputs = inputs, .what = "ode", .role = Role::ode, .formula = formula}));
  if (!jacobian.is_none()) {
    state.jacobian = leaf.matrix_function(leaf.add(
        self, std::move(jacobian), {.inputs = inputs, .what = "jacobian", .role = Role::jacobian}));
  }
  if (sparsity) {
    state.sparsity.emplace();
    for (const auto& [row, column] : *sparsity) state.sparsity->push_back({row, column});
  }
  if (!sparse_jacobian.is_none()) {
    state.sparse_jacobian = leaf.vector_function(
        leaf.add(self, std::move(sparse_jacobian),
                 {.inputs = inputs, .what = "sparse_jacobian", .role = Role::sparse_jacobian}));
  }
  if (!derivatives.is_none())
    state.derivatives = leaf.derivatives_function(
        leaf.add(self, std::move(derivatives),
                 {.inputs = inputs, .what = "derivatives of ode", .role = Role::derivatives}));
  leaf.declare_continuous_state(std::move(state));
  leaf.set_state_dimensions(dimensions_of(values));
}

/// The values that a function reads, by their names in Python. Everything includes the relations of
/// the block.
Reads reads_of(const PythonLeaf& leaf, const std::string& what,
               const std::vector<std::string>& words) {
  static const std::vector<std::pair<std::string, Reads>> known{
      {"time", Reads::time},
      {"continuous_state", Reads::continuous_state},
      {"discrete_state", Reads::discrete_state},
      {"mode", Reads::mode},
      {"inputs", Reads::inputs},
      {"relations", Reads::relations}};
  Reads all = Reads::parameters;
  for (const std::string& word : words) {
    const auto found = std::ranges::find(known, word, &std::pair<std::string, Reads>::first);
    if (found == known.end()) {
      std::vector<std::string> names;
      for (const auto& [one, unused] : known) names.push_back(one);
      throw ModelError(text("block '", leaf.name(), "': ", what, " reads '", word, "'",
                            known_names(word, names)));
    }
    all = all | found->second;
  }
  const bool rest = (all | Reads::relations) == Reads::everything;
  return rest && !leaf.declarations().relations.empty() ? Reads::everything : all;
}

int declare_relation(py::handle self, py::object guard, std::string name, bool true_at_zero,
                     Index size, const InputList& inputs, const std::vector<std::string>& reads,
                     bool formula) {
  PythonLeaf& leaf = leaf_of(self);
  const int index = count_of(leaf.declarations().relations);
  const std::string what = text("relation '", name.empty() ? text("relation_", index) : name, "'");
  if (size < 1)
    throw ModelError(
        text("block '", leaf.name(), "': ", what, ": size ", size, "; expected 1 or more"));
  Relation relation{.name = std::move(name),
                    .guard = {},
                    .true_at_zero = true_at_zero,
                    .size = size,
                    .reads = reads_of(leaf, what, reads),
                    .inputs = inputs,
                    .formula = {}};
  relation.guard = leaf.vector_function(leaf.add(self, std::move(guard),
                                                 {.inputs = inputs,
                                                  .what = text("guard of ", what),
                                                  .role = Role::relation,
                                                  .formula = formula,
                                                  .index = index}));
  return leaf.declare_relation(std::move(relation)).value;
}

/// The period and the offset of the ticks of a sampled output, and its value before the first one.
using Ticks = std::tuple<double, double, py::object>;

std::shared_ptr<const LeafSystem> sampler_of(const std::string& output,
                                             const std::optional<Ticks>& ticks) {
  if (!ticks) return {};
  const auto& [period, offset, before] = *ticks;
  return std::make_shared<RateTransition>(
      output, period,
      RateTransitionOptions{.initial_state = to_value(before, "default_value"), .offset = offset});
}

int declare_output_port(py::handle self, py::object function, std::string name,
                        const InputList& inputs, const std::optional<Dimensions>& shape,
                        std::optional<bool> boolean, const std::vector<std::string>& reads,
                        Convention convention, bool formula, const std::optional<Ticks>& ticks,
                        py::object derivatives) {
  PythonLeaf& leaf = leaf_of(self);
  if (name.empty()) name = text("out_", leaf.output_names().size());
  const std::string what = text("output '", name, "'");
  const Reads all = reads_of(leaf, what, reads);
  const auto sampler = sampler_of(name, ticks);
  DerivativesFunction declared;
  if (!derivatives.is_none())
    declared = leaf.derivatives_function(
        leaf.add(self, std::move(derivatives),
                 {.inputs = inputs, .what = "derivatives of " + what, .role = Role::derivatives}));
  return leaf.add_output(std::move(name),
                         leaf.add(self, std::move(function),
                                  {.convention = convention,
                                   .inputs = inputs,
                                   .what = what,
                                   .role = Role::output,
                                   .formula = formula,
                                   .index = count_of(leaf.declarations().outputs)}),
                         shape_from(shape, text("block '", leaf.name(), "': ", what)), boolean, all,
                         sampler, std::move(declared));
}

/// A state without a copy and without a call.
int declare_view(py::handle self, std::string name, Space space) {
  PythonLeaf& leaf = leaf_of(self);
  const bool x = space == Space::x;
  const Declarations& d = leaf.declarations();
  const Shape shape = shape_of_state(x ? leaf.state_dimensions() : leaf.discrete_dimensions(),
                                     x ? d.continuous.initial.size() : d.discrete.size());
  return leaf.declare_output_port({.name = std::move(name),
                                   .shape = shape,
                                   .reads = x ? Reads::continuous_state : Reads::discrete_state,
                                   .view = Place{space, 0, shape.size}});
}

/// `what` and `prefix` name an update: "periodic update 'periodic_0'".
ResetMap update_of(py::handle self, py::object callback, const char* what, const char* prefix,
                   const std::string& name) {
  PythonLeaf& leaf = leaf_of(self);
  if (callback.is_none()) return {};
  const int index = count_of(leaf.declarations().time_events);
  const std::string called = name.empty() ? text(prefix, index) : name;
  return leaf.reset_map(
      leaf.add(self, std::move(callback),
               {.what = text(what, " '", called, "'"), .role = Role::update, .index = index}));
}

}  // namespace

void bind_leaf_system(py::module_& module) {
  bind_callback_state(module);
  py::enum_<Convention>(module, "Convention")
      .value("state", Convention::state)
      .value("inputs", Convention::inputs)
      .value("input", Convention::input);

  py::class_<PythonLeaf, System>(module, "LeafSystem", py::custom_type_setup(&let_collect))
      .def(py::init<std::string>())
      .def("declare_continuous_state", &declare_continuous_state)
      .def("declare_discrete_state",
           [](PythonLeaf& leaf, py::handle initial) {
             const Array values =
                 to_array(initial, text("block '", leaf.name(), "': discrete state"));
             leaf.declare_discrete_state(as_vector(values));
             leaf.set_discrete_dimensions(dimensions_of(values));
           })
      .def("declare_default_mode", &PythonLeaf::declare_default_mode)
      .def("declare_dynamic_parameter",
           [](PythonLeaf& leaf, const std::string& name, py::handle value) {
             leaf.add_parameter(
                 name, to_array(value, text("block '", leaf.name(), "': parameter '", name, "'")));
           })
      .def("declare_input_port",
           [](PythonLeaf& leaf, std::string name, const std::optional<Dimensions>& shape) {
             const std::string what =
                 text("block '", leaf.name(), "': input '",
                      name.empty() ? text("in_", leaf.input_names().size()) : name, "'");
             return leaf.add_input(std::move(name), shape_from(shape, what));
           })
      .def("declare_output_port", &declare_output_port)
      .def("declare_continuous_state_output",
           [](py::handle self, std::string name) {
             return declare_view(self, std::move(name), Space::x);
           })
      .def("declare_discrete_state_output",
           [](py::handle self, std::string name) {
             return declare_view(self, std::move(name), Space::z);
           })
      .def("declare_mode_output", &PythonLeaf::declare_mode_output)
      .def("declare_zero_crossing", &declare_zero_crossing)
      .def("declare_relation", &declare_relation)
      .def("declare_edge_reset", &declare_edge_reset)
      .def("declare_event_input", &declare_event_input)
      .def("declare_periodic_update",
           [](py::handle self, py::object callback, double period, double offset,
              const std::string& name) {
             leaf_of(self).declare_periodic_update(
                 update_of(self, std::move(callback), "periodic update", "periodic_", name), period,
                 offset, name);
           })
      .def("declare_time_event",
           [](py::handle self, py::object callback, std::optional<double> period, double offset,
              std::optional<std::vector<double>> times, double end,
              std::optional<std::int64_t> count, const std::string& name) {
             TimeEvent event{.name = name,
                             .offset = offset,
                             .times = std::move(times),
                             .end = end,
                             .count = count};
             if (period) event.period = *period;
             event.update = update_of(self, std::move(callback), "time event", "time_event_", name);
             leaf_of(self).declare_time_event(std::move(event));
           })
      .def("declare_one_shot", [](py::handle self, py::object callback, double time,
                                  const std::string& name) {
        leaf_of(self).declare_one_shot(
            time, update_of(self, std::move(callback), "one-shot update", "one_shot_", name), name);
      });
}

}  // namespace saltus::python
