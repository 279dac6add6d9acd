#include "plan_tapes.hpp"

#include <pybind11/stl.h>

#include "interpreter.hpp"
#include "saltus/base/error.hpp"
#include "saltus/tape/compile_cost.hpp"
#include "tape_compiler.hpp"
#include "taped.hpp"

namespace saltus::python {

namespace {

using Tapes = std::vector<tape::Tape>;

double instructions_of(const Tapes& tapes) {
  double sum = 0.0;
  for (const tape::Tape& tape : tapes) sum += tape.instruction_count();
  return sum;
}

template <class Function>
void add(Tapes& tapes, const Function& function) {
  const Tapes more = tapes_of(function);
  tapes.insert(tapes.end(), more.begin(), more.end());
}

/// The functions that one evaluation of a list calls.
class Reader {
 public:
  explicit Reader(const Plan& plan) : plan_(plan) {}

  Tapes derivatives() const {
    const Walk& walk = plan_.walks.derivatives;
    Tapes tapes = of_list(walk, plan_.derivatives);
    for (std::size_t i = 0; i < plan_.odes.size(); ++i) {
      if (walk.fuses() && walk.fused[i]) continue;
      add(tapes, plan_.leaf(plan_.odes[i]).declared().continuous.ode.function);
    }
    return tapes;
  }

  Tapes guards() const {
    const Walk& walk = plan_.walks.guards;
    Tapes tapes = of_list(walk, plan_.guard_needs);
    for (std::size_t i = 0; i < plan_.guards.size(); ++i) {
      if (walk.fuses() && walk.fused[i]) continue;
      const GuardGroup& group = plan_.guards[i];
      if (group.is_crossing())
        add(tapes, plan_.crossing_of(group).guard);
      else
        add_node(tapes, group.index);
    }
    return tapes;
  }

  Tapes jacobians() const {
    Tapes tapes;
    for (const int ode : plan_.odes) {
      add(tapes, plan_.leaf(ode).declared().continuous.sparse_jacobian);
      add(tapes, plan_.leaf(ode).declared().continuous.jacobian);
    }
    return tapes;
  }

  /// At instants and at recorded rows.
  Tapes others() const {
    Tapes tapes;
    for (const int node : plan_.instants) add_node(tapes, node);
    for (const int node : plan_.tap_needs) add_node(tapes, node);
    for (const PlanLeaf& leaf : plan_.leaves) {
      for (const auto& crossing : leaf.declared().zero_crossings) add(tapes, crossing.reset_map);
      for (const auto& edge : leaf.declared().edge_resets) add(tapes, edge.reset_map);
      for (const auto& event : leaf.declared().time_events) add(tapes, event.update);
    }
    return tapes;
  }

 private:
  void add_node(Tapes& tapes, int i) const {
    const Node& node = plan_.node(i);
    add(tapes, node.relation ? plan_.relation_of(node).guard : plan_.output_of(node).calc);
  }

  Tapes of_list(const Walk& walk, const std::vector<int>& nodes) const {
    Tapes tapes;
    if (walk.last) add(tapes, walk.last);
    for (const Walk::Stage& stage : walk.stages) {
      if (stage.fused) add(tapes, stage.fused);
      for (const int node : stage.calls) add_node(tapes, node);
    }
    if (!walk.fuses())
      for (const int node : nodes) add_node(tapes, node);
    return tapes;
  }

  const Plan& plan_;
};

}  // namespace

MachineCodeWhen machine_code_when(std::string_view word) {
  if (word == "always") return MachineCodeWhen::always;
  return word == "never" ? MachineCodeWhen::never : MachineCodeWhen::automatic;
}

PlanTapes::PlanTapes(const Plan& plan, MachineCodeWhen when,
                     std::shared_ptr<Interpreted> interpreted)
    : plan_(&plan), when_(when), interpreted_(std::move(interpreted)) {
  read_plan();
}

void PlanTapes::renew() {
  read_plan();
  compile_if_known_to_pay();
}

void PlanTapes::read_plan() {
  const Reader read(*plan_);
  tapes_.clear();
  const auto take = [this](const Tapes& more) {
    tapes_.insert(tapes_.end(), more.begin(), more.end());
    return instructions_of(more);
  };
  by_derivative_ = take(read.derivatives());
  by_guards_ = take(read.guards());
  by_jacobian_ = take(read.jacobians());
  all_ = by_derivative_ + by_guards_ + by_jacobian_ + take(read.others());
  done_ = when_ == MachineCodeWhen::never || tapes_.empty();
}

double PlanTapes::instructions(const Evaluations& evaluations) const {
  return by_derivative_ * static_cast<double>(evaluations.derivatives) +
         by_guards_ * static_cast<double>(evaluations.guards) +
         by_jacobian_ * static_cast<double>(evaluations.jacobians);
}

void PlanTapes::begin() {
  counted_ = 0.0;
  compile_if_known_to_pay();
}

void PlanTapes::compile_if_known_to_pay() {
  if (done_) return;
  const bool always = when_ == MachineCodeWhen::always;
  if (always || tape::compiling_pays(interpreted_->last_run, all_, compiler_is_loaded())) compile();
}

void PlanTapes::consider(const Evaluations& now) {
  if (done_) return;
  const double so_far = interpreted_->all + instructions(now) - counted_;
  if (tape::compiling_pays(so_far, all_, compiler_is_loaded())) compile();
}

void PlanTapes::end(const Evaluations& now) {
  if (when_ == MachineCodeWhen::never || tapes_.empty()) return;
  const double run = instructions(now);
  interpreted_->last_run = run;
  consider(now);
  interpreted_->all += run - counted_;
  counted_ = run;
}

void PlanTapes::compile() {
  done_ = true;
  locked([this] { compile_tapes(tapes_, when_ == MachineCodeWhen::always); });
}

std::string PlanTapes::describe() const {
  if (tapes_.empty()) return "";
  const auto compiled = std::ranges::count_if(tapes_, &tape::Tape::is_machine_code);
  const auto all = static_cast<std::ptrdiff_t>(tapes_.size());
  const std::string how =
      compiled == all ? "run as machine code"
      : compiled == 0 ? "interpreted"
                      : text(compiled, " run as machine code, ", all - compiled, " interpreted");
  return text("tapes: ", all, ", ", how, "\n");
}

}  // namespace saltus::python
