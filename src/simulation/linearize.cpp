// Linearizer: the columns and rows of the matrices, and their values.
#include "saltus/simulation/linearize.hpp"

#include <algorithm>

#include "linear_limits.hpp"
#include "linear_names.hpp"
#include "linear_parameters.hpp"
#include "saltus/model/context_entry.hpp"
#include "saltus/plan/detail/fixed_inputs.hpp"
#include "saltus/simulation/detail/given_inputs.hpp"

namespace saltus {

namespace {

RecordedSignals all_outputs(const System& system) {
  RecordedSignals signals;
  for (const std::string& name : system.output_names())
    signals.push_back({name, system.output(name)});
  return signals;
}

/// The number of an open input with this name, or -1.
int port_of(const System& system, const std::string& name) {
  const std::vector<std::string> names = system.input_names();
  const auto found = std::ranges::find(names, name);
  return found == names.end() ? -1 : static_cast<int>(found - names.begin());
}

/// The system with the values that the inputs were given.
GivenInputs given(const System& system, const std::vector<LinearInput>& inputs) {
  GivenInputs with(system);
  for (const LinearInput& input : inputs) {
    const int port = port_of(system, input.name);
    if (port < 0) continue;
    if (input.value) with.fix_input(port, *input.value, input.shape);
    if (!with.fixes_input(port))
      throw ModelError(text("linearize: input '", input.name, "' of system '", system.name(),
                            "' is open and has no value; expected the value at which to linearise, "
                            "as in {\"",
                            input.name, "\", 0.0}, or a call of fix_input"));
  }
  return with;
}

void require_no_history(const Plan& plan) {
  if (plan.histories.empty()) return;
  throw ModelError(text("linearize: block '", plan.leaf(plan.histories.front()).path,
                        "' keeps a history of its input, so no finite number of states describes "
                        "it; replace it, for example by a Pade approximation (TransferFunction)"));
}

}  // namespace

/// The plan of the system, and where its inputs are.
class Linearizer::Parts {
 public:
  Parts(const System& system, LinearizeOptions options)
      : options_(std::move(options)),
        system_(given(system, options_.inputs)),
        at_(compile(system_, options_.outputs ? *options_.outputs : all_outputs(system),
                    options_.refinement.get())),
        layout_(system.create_context()) {
    options_.refinement.reset();
    require_no_history(plan());
    parameters_ = LinearParameters(plan().computed);
    columns_ = {ParameterMoves(plan().np), List<Index>(plan().ny, Index{-1}), plan().nx};
    for (const LinearInput& input : options_.inputs) add(input);
    rule_.emplace(at_.machine(), columns_);
    for (const Tap& tap : plan().taps) {
      const Shape& shape = plan().node(tap.node).shape;
      add_entries(outputs_, tap.name, shape);
    }
  }

  Linearization at(const Context& context) {
    at_.begin(parameters_.written(context));
    rule_->set_parameters(parameters_.moves(at_.machine().p));
    const LinearLimits limits(at_, *rule_);
    limits.require_motion();
    rule_->at(at_.time(), {});
    Linearization found = matrices();
    if (!options_.one_sided) {
      limits.require_smooth();
      limits.require_guards_off_zero();
      limits.require_relations_off_roots([&] { return matrices(); }, found);
    }
    limits.require_finite(found);
    add_frozen(found);
    add_guards(found);
    return found;
  }

 private:
  const Plan& plan() { return at_.machine().plan(); }

  void add(const LinearInput& input) {
    const int port = port_of(system_, input.name);
    port < 0 ? add_parameter(input) : add_port(input, port);
  }

  void add_port(const LinearInput& input, int port) {
    const LeafPort to = system_.input_target(port);
    const auto leaf = detail::LeafNumbers(plan()).find(to.leaf).value();
    const Node& node = plan().node(plan().leaf(leaf).inputs[to.index]);
    add_columns(input.name, columns_.of_signal, node.place.offset, node.shape);
  }

  void add_parameter(const LinearInput& input) {
    const ContextEntry entry = find_input(input.name);
    if (entry.kind != ContextEntry::Kind::parameter)
      throw ModelError(text("linearize: '", input.name,
                            "' is a state or a mode; expected an open input of the system or a "
                            "parameter; A has the derivatives by the continuous states"));
    LinearParameters::write(layout_, input, entry);  // refuses a wrong number of values
    require_once(!parameters_.has(entry), input.name);
    parameters_.add({input, entry, columns_.size});
    columns_.size += entry.size;
    add_entries(inputs_, input.name, {entry.size, entry.size > 1, 0});
  }

  static void require_once(bool once, const std::string& name) {
    if (!once) throw ModelError(text("linearize: input '", name, "' is named twice"));
  }

  /// Adds the open inputs to the names of an unknown one.
  ContextEntry find_input(const std::string& name) {
    try {
      return find_entry(layout_.layout(), name);
    } catch (const ModelError& error) {
      std::string known = quoted_list(system_.input_names());
      throw ModelError(text("linearize: ", error.what(),
                            known.empty() ? std::string() : text("; open inputs: ", known)));
    }
  }

  void add_columns(const std::string& name, List<Index>& of, Index first, const Shape& shape) {
    for (Index i = 0; i < shape.size; ++i) {
      require_once(of[first + i] < 0, name);
      of[first + i] = columns_.size++;
    }
    add_entries(inputs_, name, shape);
  }

  Linearization matrices() {
    const Index n = plan().nx, m = columns_.size - n;
    Linearization found;
    found.A = rule_->rates_by().leftCols(n), found.B = rule_->rates_by().rightCols(m);
    const auto k = static_cast<Index>(outputs_.size());
    found.C.resize(k, n), found.D.resize(k, m), found.y.resize(k);
    Index row = 0;
    for (const Tap& tap : plan().taps) {
      const Eigen::MatrixXd by = rule_->by(tap.node);
      found.C.middleRows(row, by.rows()) = by.leftCols(n);
      found.D.middleRows(row, by.rows()) = by.rightCols(m);
      found.y.segment(row, by.rows()) = rule_->value(tap.node);
      row += by.rows();
    }
    found.states = state_names(plan()), found.inputs = inputs_, found.outputs = outputs_;
    found.differences = rule_->called();
    found.time = at_.time(), found.x = at_.machine().x, found.xdot = rule_->rates();
    found.u = input_values();
    return found;
  }

  Eigen::VectorXd input_values() {
    const Index n = plan().nx;
    Eigen::VectorXd u(columns_.size - n);
    for (Index i = 0; i < plan().ny; ++i)
      if (columns_.of_signal[i] >= 0) u[columns_.of_signal[i] - n] = at_.machine().y[i];
    for (const LinearParameters::One& one : parameters_.all())
      u.segment(one.column - n, one.entry.size) =
          at_.machine().p.segment(one.entry.first, one.entry.size);
    return u;
  }

  void add_frozen(Linearization& found) {
    for (std::size_t l = 0; l < plan().leaves.size(); ++l) {
      const PlanLeaf& leaf = plan().leaf(l);
      const std::string prefix = prefix_of(plan(), leaf);
      for (Index i = 0; i < leaf.nz; ++i)
        found.frozen.push_back({text(prefix, "z[", i, "]"), at_.machine().z[leaf.z + i]});
      if (leaf.declared().has_modes)
        found.frozen.push_back({prefix + "mode", static_cast<double>(at_.machine().modes[l])});
    }
    for (const int node : rule_->truths()) {
      const Shape& shape = plan().node(node).shape;
      std::vector<std::string> names;
      add_entries(names, plan().name_of(plan().node(node)), shape);
      const Eigen::VectorXd values = rule_->value(node);
      for (Index i = 0; i < shape.size; ++i) found.frozen.push_back({nth(names, i), values[i]});
    }
  }

  void add_guards(Linearization& found) {
    for (const GuardGroup& group : plan().guards) {
      if (!group.is_crossing() || !plan().crossing_of(group).has_effect()) continue;
      if (group.direction == Direction::edge_detection) continue;
      if (!is_seen(group, at_.machine())) continue;
      const Eigen::VectorXd values = rule_->level(function_of_guard(plan(), group)).value;
      std::vector<std::string> names;
      add_entries(names, group.name, {group.size, group.size > 1, 0});
      for (Index i = 0; i < group.size; ++i)
        found.guards.push_back({nth(names, i), values[i], group.direction});
    }
  }

  LinearizeOptions options_;
  GivenInputs system_;
  Standstill at_;
  Context layout_;  // to find names
  LinearColumns columns_;
  std::optional<ChainRule> rule_;
  LinearParameters parameters_;
  std::vector<std::string> inputs_, outputs_;
};

Linearizer::Linearizer(const System& system, LinearizeOptions options)
    : parts_(std::make_unique<Parts>(system, std::move(options))) {}
Linearizer::~Linearizer() = default;
Linearizer::Linearizer(Linearizer&&) noexcept = default;
Linearizer& Linearizer::operator=(Linearizer&&) noexcept = default;

Linearization Linearizer::at(const Context& context) { return parts_->at(context); }

Linearization linearize(const System& system, const Context& context,
                        const LinearizeOptions& options) {
  return Linearizer(system, options).at(context);
}

}  // namespace saltus
