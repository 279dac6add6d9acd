// Contexts as plain data: for JSON, in the format of saltus/model/context_json.hpp, and for pickle.
#include <pybind11/stl.h>

#include "bindings.hpp"
#include "context_docs.hpp"
#include "numbers.hpp"
#include "saltus/model/system.hpp"

namespace saltus::python {

namespace {

using py::literals::operator""_a;
constexpr const char* format = "saltus context 1";

std::vector<double> list(const Eigen::Ref<const Eigen::VectorXd>& values) {
  return {values.begin(), values.end()};
}

py::dict data_of(const Continuation& c) {
  py::list guards, firings;
  for (const auto& g : c.guards)
    guards.append(py::make_tuple(g.side, g.from, g.fresh, g.resting, g.band, g.base));
  for (const auto& f : c.firings)
    firings.append(py::dict("times"_a = f.times, "after"_a = f.after, "holding"_a = f.holding));
  return py::dict("jump"_a = c.jump, "relations"_a = c.relations, "guards"_a = guards,
                  "firings"_a = firings, "edges"_a = c.edges, "counts"_a = c.counts);
}

Continuation continuation_from(const py::dict& data) {
  Continuation c{.jump = data["jump"].cast<int>(),
                 .relations = data["relations"].cast<std::vector<double>>(),
                 .edges = data["edges"].cast<std::vector<int>>(),
                 .counts = data["counts"].cast<std::vector<std::int64_t>>()};
  for (const py::handle item : data["guards"]) {
    const auto g = item.cast<py::sequence>();
    c.guards.push_back({g[0].cast<int>(), g[1].cast<int>(), g[2].cast<bool>(), g[3].cast<bool>(),
                        g[4].cast<double>(), g[5].cast<double>()});
  }
  for (const py::handle item : data["firings"]) {
    const auto f = item.cast<py::dict>();
    c.firings.push_back({f["times"].cast<std::vector<double>>(),
                         f["after"].cast<std::vector<double>>(), f["holding"].cast<bool>()});
  }
  return c;
}

py::dict data_of(const Context& context) {
  const ContextValues v = context.values();
  py::list blocks;
  for (std::size_t i = 0; i < v.modes.size(); ++i) {
    const Layout::Leaf& leaf = context.layout().leaves[i];
    blocks.append(py::dict("block"_a = leaf.path,
                           "continuous_state"_a = list(v.continuous_state.segment(leaf.x, leaf.nx)),
                           "discrete_state"_a = list(v.discrete_state.segment(leaf.z, leaf.nz)),
                           "parameters"_a = list(v.parameters.segment(leaf.p, leaf.np)),
                           "mode"_a = v.modes[i]));
  }
  py::dict data("format"_a = format, "time"_a = v.time, "settled"_a = v.settled,
                "blocks"_a = blocks);
  if (v.continuation) data["continuation"] = data_of(*v.continuation);
  return data;
}

void read_numbers(const py::dict& block, const char* key, Eigen::Ref<Eigen::VectorXd> into,
                  const std::string& path) {
  const auto numbers = block[key].cast<std::vector<double>>();
  if (static_cast<Index>(numbers.size()) != into.size()) {
    throw ModelError(text("block '", path, "': expected ", into.size(), " numbers under '", key,
                          "', found ", numbers.size()));
  }
  std::ranges::copy(numbers, into.begin());
}

Context filled(const Context& blank, const py::dict& data) {
  const auto& leaves = blank.layout().leaves;
  ContextValues v = blank.values();
  if (data["format"].cast<std::string>() != format)
    throw ModelError(
        text("expected format '", format, "', found ", std::string(py::repr(data["format"]))));
  const auto blocks = data["blocks"].cast<std::vector<py::dict>>();
  if (blocks.size() != leaves.size()) {
    throw ModelError(text("the context is not one of this system: expected ", leaves.size(),
                          " blocks, found ", blocks.size()));
  }
  v.time = data["time"].cast<double>(), v.settled = data["settled"].cast<bool>();
  for (std::size_t i = 0; i < leaves.size(); ++i) {
    const Layout::Leaf& leaf = leaves[i];
    const auto found = blocks[i]["block"].cast<std::string>();
    if (found != leaf.path)
      throw ModelError(text("expected block '", leaf.path, "', found '", found, "'"));
    read_numbers(blocks[i], "continuous_state", v.continuous_state.segment(leaf.x, leaf.nx), found);
    read_numbers(blocks[i], "discrete_state", v.discrete_state.segment(leaf.z, leaf.nz), found);
    read_numbers(blocks[i], "parameters", v.parameters.segment(leaf.p, leaf.np), found);
    v.modes[i] = blocks[i]["mode"].cast<int>();
  }
  if (data.contains("continuation"))
    v.continuation = std::make_shared<const Continuation>(
        continuation_from(data["continuation"].cast<py::dict>()));
  return blank.with_values(v);
}

/// Data in another format has a missing key or a wrong type.
Context from_data(const Context& blank, const py::dict& data) {
  try {
    return filled(blank, data);
  } catch (const py::error_already_set& error) {
    if (!error.matches(PyExc_KeyError)) throw;
    throw ModelError(text("a context needs ", error.what()));
  } catch (const py::cast_error& error) {
    throw ModelError(text("a context holds something else than expected: ", error.what()));
  }
}

py::tuple layout_data(const Layout& layout) {
  py::list leaves, systems;
  for (const Layout::Leaf& leaf : layout.leaves) {
    py::list parameters;
    for (const auto& p : leaf.parameters)
      parameters.append(py::make_tuple(p.name, p.offset, p.size));
    leaves.append(
        py::make_tuple(leaf.path, leaf.x, leaf.nx, leaf.z, leaf.nz, leaf.p, leaf.np, parameters));
  }
  for (const Layout::Range& r : layout.systems)
    systems.append(py::make_tuple(r.id.value, r.path, r.first, r.last));
  return py::make_tuple(leaves, systems);
}

std::shared_ptr<const Layout> layout_from(const py::tuple& data) {
  auto layout = std::make_shared<Layout>();
  for (const py::handle item : data[0]) {
    const auto l = item.cast<py::tuple>();
    Layout::Leaf leaf{.path = l[0].cast<std::string>(),
                      .x = l[1].cast<Index>(),
                      .nx = l[2].cast<Index>(),
                      .z = l[3].cast<Index>(),
                      .nz = l[4].cast<Index>(),
                      .p = l[5].cast<Index>(),
                      .np = l[6].cast<Index>(),
                      .parameters = {}};
    for (const py::handle p : l[7]) {
      const auto parameter = p.cast<py::tuple>();
      leaf.parameters.push_back({parameter[0].cast<std::string>(), parameter[1].cast<Index>(),
                                 parameter[2].cast<Index>()});
    }
    layout->leaves.push_back(std::move(leaf));
  }
  for (const py::handle item : data[1]) {
    const auto r = item.cast<py::tuple>();
    layout->systems.push_back({SystemId{r[0].cast<int>()}, r[1].cast<std::string>(),
                               r[2].cast<std::size_t>(), r[3].cast<std::size_t>()});
  }
  return layout;
}

/// A context of a layout with all values zero, which `filled` fills.
Context blank_of(const std::shared_ptr<const Layout>& layout) { return Context::zero(layout); }

}  // namespace

void bind_context_saving(py::class_<Context>& context) {
  context.def(
             "to_dict", [](const Context& c) { return data_of(c); }, docs::to_dict)
      .def(
          "to_json",
          [](const Context& c) {
            return py::module_::import("json").attr("dumps")(data_of(c), "indent"_a = 1);
          },
          docs::to_json)
      .def(py::pickle(
          [](const Context& c) { return py::make_tuple(layout_data(c.layout()), data_of(c)); },
          [](const py::tuple& state) {
            return from_data(blank_of(layout_from(state[0].cast<py::tuple>())),
                             state[1].cast<py::dict>());
          }));
}

void bind_context_reading(py::module_& module) {
  module.def(
      "context_from_dict",
      [](const System& system, const py::dict& data) {
        return from_data(system.create_context(), data);
      },
      py::arg("system"), py::arg("data"),
      "The context of `system` that Context.to_dict gave. Raises ModelError for other data.");
}

}  // namespace saltus::python
