#include "zero_crossing.hpp"

#include <functional>

#include <pybind11/stl.h>

namespace saltus::python {

namespace {

/// The options of one zero crossing, as python/saltus/leaf_system/guards.py passes them. Messages
/// name the block, the zero crossing and the option.
class Options {
 public:
  Options(const py::dict& given, std::string whose) : given_(given), whose_(std::move(whose)) {}

  template <class T>
  T get(const char* name, std::string_view expected) const {
    const py::object value = given_[name];
    try {
      return value.cast<T>();
    } catch (const py::cast_error&) {
      refuse(name, expected, value);
    }
  }

  /// The value that `from` knows by a name; the message of an unknown one begins with the block.
  template <class From>
  auto named(const char* name, const From& from) const {
    const auto found = get<std::string>(name, "a name");
    try {
      return from(found);
    } catch (const ModelError& error) {
      throw ModelError(text(whose_, error.what()));
    }
  }

  std::optional<int> mode(const char* name) const {
    return get<std::optional<int>>(name, "a mode, an integer");
  }

  std::optional<bool> truth(const char* name) const {
    return get<std::optional<bool>>(name, "True, False or None");
  }

  py::object raw(const char* name) const { return given_[name]; }

  OnZeno on_zeno() const {
    const py::object value = given_["on_zeno"];
    if (!py::isinstance<py::str>(value))
      return OnZeno::enter(get<int>("on_zeno", "'hold', 'stop', 'error' or a mode, an integer"));
    return named("on_zeno", [](std::string_view name) {
      static const std::vector<std::pair<std::string_view, OnZeno>> names{
          {"hold", OnZeno::hold()}, {"stop", OnZeno::stop()}, {"error", OnZeno::error()}};
      return detail::value_of(names, "on_zeno", name);
    });
  }

  std::vector<std::vector<int>> holds() const {
    using Lists = std::optional<std::vector<std::vector<int>>>;
    return get<Lists>("holds", "a list for each guard, of positions in the continuous state")
        .value_or(std::vector<std::vector<int>>{});
  }

 private:
  [[noreturn]] void refuse(const char* name, std::string_view expected, py::handle found) const {
    throw ModelError(
        text(whose_, name, ": expected ", expected, ", found ", std::string(py::repr(found))));
  }

  const py::dict& given_;
  std::string whose_;
};

Edge edge_from(std::string_view name) {
  static const std::vector<std::pair<std::string_view, Edge>> names{
      {"rising", Edge::rising}, {"falling", Edge::falling}, {"either", Edge::either}};
  return detail::value_of(names, "edge", name);
}

std::optional<double> zeno_tolerance(const Options& options) {
  return options.get<std::optional<double>>("zeno_tolerance", "a time [s]");
}

InputList inputs(const Options& options) {
  return options.get<InputList>("inputs", "True, False or a list of positions");
}

ZeroCrossing read(const Options& options) {
  return {.direction = options.named("direction", direction_from),
          .start_mode = options.mode("start_mode"),
          .end_mode = options.mode("end_mode"),
          .terminal = options.get<bool>("terminal", "True or False"),
          .max_count = options.get<int>("max_count", "a count, 1 or more"),
          .size = options.get<Index>("size", "a number of guards, 1 or more"),
          .at_start = options.named("at_start", at_start_from),
          .on_zeno = options.on_zeno(),
          .zeno_tolerance = zeno_tolerance(options),
          .holds = options.holds(),
          .inputs = inputs(options),
          .persistent = options.truth("persistent"),
          .initial_value = options.truth("initial_value"),
          .use_values_from_trigger_time = options.truth("use_values_from_trigger_time"),
          .yields = options.get<bool>("yields", "True or False"),
          .follows_updates = options.get<bool>("follows_updates", "True or False")};
}

/// A number or a function of the block; nothing for None.
std::optional<NumberOf> number(const Options& options, const char* name, PythonLeaf& leaf,
                               const std::function<int(py::object)>& add) {
  const py::object given = options.raw(name);
  if (given.is_none()) return {};
  if (PyNumber_Check(given.ptr()) != 0 && PyCallable_Check(given.ptr()) == 0)
    return NumberOf(options.get<double>(name, "a number or a function"));
  return NumberOf(leaf.vector_function(add(given)));
}

}  // namespace

void declare_zero_crossing(py::handle self, py::object guard, py::object reset_map,
                           std::string name, const py::dict& given) {
  auto& leaf = self.cast<PythonLeaf&>();
  const std::string called =
      name.empty() ? text("zero_crossing_", leaf.declarations().zero_crossings.size()) : name;
  const Options options(given, text("block '", leaf.name(), "': zero crossing '", called, "': "));
  ZeroCrossing crossing = read(options);
  const bool formula = options.get<bool>("formula", "True or False");
  crossing.name = std::move(name);
  const auto add = [&](py::object function, std::string_view what, Role role) {
    return leaf.add(self, std::move(function),
                    {.inputs = crossing.inputs,
                     .what = text(what, " of '", called, "'"),
                     .role = role,
                     .formula = role == Role::guard && formula,
                     .index = count_of(leaf.declarations().zero_crossings)});
  };
  crossing.guard = leaf.vector_function(add(std::move(guard), "guard", Role::guard));
  if (!reset_map.is_none())
    crossing.reset_map = leaf.reset_map(add(std::move(reset_map), "reset map", Role::reset_map));
  const auto derivatives = [&](const char* option, std::string_view what) {
    const py::object function = options.raw(option);
    if (function.is_none()) return DerivativesFunction();
    return leaf.derivatives_function(add(function, what, Role::derivatives));
  };
  crossing.guard_derivatives = derivatives("guard_derivatives", "derivatives of guard");
  crossing.reset_derivatives = derivatives("reset_derivatives", "derivatives of reset map");
  crossing.delay = number(options, "delay", leaf, [&](py::object function) {
    return add(std::move(function), "delay", Role::delay);
  });
  crossing.priority = number(options, "priority", leaf, [&](py::object function) {
    return add(std::move(function), "priority", Role::priority);
  });
  leaf.declare_zero_crossing(std::move(crossing));
}

void declare_edge_reset(py::handle self, py::object reset_map, int input, std::string name,
                        const py::dict& given) {
  auto& leaf = self.cast<PythonLeaf&>();
  const int index = count_of(leaf.declarations().edge_resets);
  const std::string called = name.empty() ? text("edge_reset_", index) : name;
  const Options options(given, text("block '", leaf.name(), "': edge reset '", called, "': "));
  EdgeReset reset{.name = std::move(name),
                  .input = input,
                  .edge = options.named("edge", edge_from),
                  .reset_map = {},
                  .on_zeno = options.on_zeno(),
                  .zeno_tolerance = zeno_tolerance(options),
                  .inputs = inputs(options)};
  reset.reset_map = leaf.reset_map(leaf.add(self, std::move(reset_map),
                                            {.inputs = reset.inputs,
                                             .what = text("reset map of '", called, "'"),
                                             .role = Role::edge_reset,
                                             .index = index}));
  leaf.declare_edge_reset(std::move(reset));
}

void declare_event_input(py::handle self, py::object reset_map, std::string name, Index size,
                         const InputList& inputs) {
  auto& leaf = self.cast<PythonLeaf&>();
  const int index = count_of(leaf.declarations().event_inputs);
  const std::string called = name.empty() ? text("event_in_", index) : name;
  EventInputDeclaration input{
      .name = std::move(name), .reset_map = {}, .size = size, .inputs = inputs};
  input.reset_map = leaf.delivery_map(leaf.add(self, std::move(reset_map),
                                               {.inputs = inputs,
                                                .what = text("reset map of '", called, "'"),
                                                .role = Role::event_input,
                                                .index = index}));
  leaf.declare_event_input(std::move(input));
}

}  // namespace saltus::python
