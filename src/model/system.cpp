// The parts that a leaf and a diagram share: ports by name, the default context, the kind.
#include "saltus/model/system.hpp"

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <memory>
#include <typeinfo>
#include <unordered_map>

#if __has_include(<cxxabi.h>)
#include <cxxabi.h>
#endif

#include "saltus/model/computed_parameter.hpp"
#include "saltus/model/detail/diagram_parameters.hpp"
#include "saltus/model/leaf_system.hpp"

namespace saltus {

namespace {

std::string readable(const char* mangled) {
#if __has_include(<cxxabi.h>)
  int status = 0;
  const std::unique_ptr<char, void (*)(void*)> name(
      abi::__cxa_demangle(mangled, nullptr, nullptr, &status), std::free);
  if (status == 0) return name.get();
#endif
  return mangled;
}

}  // namespace

/// The name of the class, without namespaces, enclosing functions and template arguments.
std::string System::kind() const {
  std::string name = readable(typeid(*this).name());
  int depth = 0;
  std::size_t begin = 0, end = name.size();
  for (std::size_t i = 0; i < name.size(); ++i) {
    const char c = name[i];
    if (c == '<' && depth == 0) end = i;
    if (c == '<' || c == '(' || c == '{') ++depth;
    if (c == '>' || c == ')' || c == '}') --depth;
    if (c == ':' && depth == 0) begin = i + 1, end = name.size();
  }
  return name.substr(begin, end - begin);
}

InputPort System::input(int index) const { return {this, checked(index, input_names(), "input")}; }

InputPort System::input(std::string_view port) const {
  return {this, find(port, input_names(), "input")};
}

OutputPort System::output(int index) const {
  return {this, checked(index, output_names(), "output")};
}

OutputPort System::output(std::string_view port) const {
  return {this, find(port, output_names(), "output")};
}

void System::fix_input(int index, double value) {
  fix(index, {Eigen::VectorXd::Constant(1, value), Shape::scalar()});
}

void System::fix_input(int index, Eigen::VectorXd entries, const Shape& shape) {
  fix(index, {std::move(entries), shape});
}

namespace {

std::atomic<int>& fix_count() {
  static std::atomic<int> count{0};
  return count;
}

}  // namespace

void System::free_input(int index) {
  if (fixed_.erase(checked(index, input_names(), "input")) > 0) ++fix_count();
}

int System::fixes() noexcept { return fix_count(); }

void System::fix(int index, Fixed fixed) {
  const List<std::string> names(input_names());
  const auto& name = names[checked(index, names, "input")];
  const std::string what = text("the value of input '", name, "' of block '", name_, "'");
  if (fixed.value.size() == 0)
    throw ModelError(text(what, ": expected a number or a vector, found an empty vector"));
  detail::require_finite(fixed.value, what);
  fixed_.insert_or_assign(index, std::move(fixed));
  ++fix_count();
}

void System::collect_fixed(Structure& out) const {
  for (const auto& [index, fixed] : fixed_)
    out.fixed.push_back({input_target(index), fixed.value, fixed.shape});
}

int System::checked(int index, const std::vector<std::string>& names, std::string_view kind) const {
  if (index >= 0 && index < static_cast<int>(names.size())) return index;
  throw ModelError(text("block '", name_, "' has no ", kind, " ", index, ": it has ", names.size(),
                        names.empty() ? std::string() : text(" (", quoted_list(names), ")")));
}

int System::find(std::string_view port, const std::vector<std::string>& names,
                 std::string_view kind) const {
  const auto found = std::ranges::find(names, port);
  if (found != names.end()) return static_cast<int>(found - names.begin());
  throw ModelError(
      text("block '", name_, "' has no ", kind, " '", port, "'", known_names(port, names)));
}

int System::next_id() {
  static std::atomic<int> counter{0};
  return ++counter;
}

Structure structure_of(const System& root) {
  Structure structure;
  root.collect(structure, "");
  return structure;
}

namespace {

/// Notes in the layout which parameters are of diagrams, and which are computed from them.
void add_roles(const Structure& structure, Layout& layout) {
  using Role = Layout::Role;
  std::unordered_map<const LeafSystem*, Layout::Leaf*> known;
  for (std::size_t i = 0; i < structure.leaves.size(); ++i) {
    Layout::Leaf& leaf = layout.leaves[i];
    known.emplace(structure.leaves[i].system, &leaf);
    for (Layout::Parameter& one : leaf.parameters)
      one.role = leaf.of_diagram ? Role::of_diagram : Role::own;
  }
  for (const Structure::Computed& one : structure.computed)
    std::ranges::find(known.at(one.leaf)->parameters, one.parameter, &Layout::Parameter::name)
        ->role = Role::computed;
}

}  // namespace

Context System::create_context(double t) const {
  const Structure structure = structure_of(*this);
  auto layout = std::make_shared<Layout>();
  layout->systems = structure.systems;
  Index nx = 0, nz = 0, np = 0;
  for (const auto& [leaf, path] : structure.leaves) {
    const Declarations& d = leaf->declarations();
    layout->leaves.push_back({path, nx, d.continuous.initial.size(), nz, d.discrete.size(), np,
                              d.parameter_values.size(), d.parameters, d.continuous.names,
                              dynamic_cast<const DiagramParameters*>(leaf) != nullptr});
    nx += d.continuous.initial.size(), nz += d.discrete.size(), np += d.parameter_values.size();
  }
  layout->computed = computed_parameters(structure);
  if (!structure.computed.empty()) add_roles(structure, *layout);
  Context context(layout);
  context.x_.resize(nx), context.z_.resize(nz), context.p_.resize(np);
  for (std::size_t i = 0; i < structure.leaves.size(); ++i) {
    const Declarations& d = structure.leaves[i].system->declarations();
    const Layout::Leaf& where = layout->leaves[i];
    context.x_.segment(where.x, where.nx) = d.continuous.initial;
    context.z_.segment(where.z, where.nz) = d.discrete;
    context.p_.segment(where.p, where.np) = d.parameter_values;
    context.modes_.push_back(d.mode);
  }
  context.compute_parameters();
  return context.with_time(t);
}

}  // namespace saltus
