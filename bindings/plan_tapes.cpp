#include "plan_tapes.hpp"

#include <pybind11/stl.h>

#include "interpreter.hpp"
#include "saltus/base/error.hpp"
#include "saltus/plan/detail/flow_series.hpp"
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
    Tapes tapes = of_list(walk, plan_.needs.derivatives);
    for (std::size_t i = 0; i < plan_.odes.size(); ++i) {
      if (walk.fuses() && walk.fused[i]) continue;
      add(tapes, plan_.leaf(plan_.odes[i]).declared().continuous.ode.function);
    }
    return tapes;
  }

  Tapes guards() const {
    const Walk& walk = plan_.walks.guards;
    Tapes tapes = of_list(walk, plan_.needs.guards);
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
    for (const int node : plan_.needs.instants) add_node(tapes, node);
    for (const int node : plan_.needs.taps) add_node(tapes, node);
    for (const PlanLeaf& leaf : plan_.leaves) {
      for (const auto& crossing : leaf.declared().zero_crossings) add(tapes, crossing.reset_map);
      for (const auto& edge : leaf.declared().edge_resets) add(tapes, edge.reset_map);
      for (const auto& event : leaf.declared().time_events) add(tapes, event.update);
      for (const auto& input : leaf.declared().event_inputs) add(tapes, input.reset_map);
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
                     std::shared_ptr<Interpreted> interpreted, int order)
    : plan_(&plan), when_(when), interpreted_(std::move(interpreted)), order_(order) {
  read_plan();
}

void PlanTapes::read_plan() {
  const Reader read(*plan_);
  run_ = jacobians_ = {};
  const auto take = [](TapeGroup& group, const Tapes& more) {
    group.tapes.insert(group.tapes.end(), more.begin(), more.end());
    const double instructions = instructions_of(more);
    group.instructions += instructions;
    return instructions;
  };
  by_derivative_ = take(run_, read.derivatives());
  by_guards_ = take(run_, read.guards());
  take(run_, read.others());
  take(jacobians_, read.jacobians());
  read_series();
  for (TapeGroup* group : {&run_, &jacobians_})
    group->done =
        when_ == MachineCodeWhen::never || (group->tapes.empty() && group->series.empty());
}

void PlanTapes::read_series() {
  by_step_ = 0.0;
  if (order_ == 0 || plan_->nx == 0) return;
  const auto kept = flow_series(*plan_);
  if (!kept->series) return;
  run_.series = {kept->series->at_order(order_)};
  const double interpreted = run_.series[0].instruction_count();
  const tape::CompileCost cost;
  by_step_ = interpreted * cost.series_instruction / cost.instruction;
  run_.instructions += interpreted * order_ * cost.series_line / cost.line;
}

double PlanTapes::run_instructions(const Evaluations& evaluations) const {
  return by_derivative_ * static_cast<double>(evaluations.derivatives) +
         by_guards_ * static_cast<double>(evaluations.guards) +
         by_step_ * static_cast<double>(evaluations.steps);
}

void PlanTapes::begin() {
  compile_if_pays(run_, std::max(interpreted_->last_run.load(), interpreted_->all.load()));
}

void PlanTapes::renew() { read_plan(); }

void PlanTapes::consider(const Evaluations& now, double counted) {
  compile_if_pays(run_, interpreted_->all + run_instructions(now) - counted);
  if (now.jacobians > 0)
    compile_if_pays(jacobians_, jacobians_.instructions * static_cast<double>(now.jacobians));
}

void PlanTapes::end(const Evaluations& now, double& counted) {
  const double run = run_instructions(now);
  interpreted_->last_run = run;
  interpreted_->all += run - counted;
  counted = run;
}

/// Without `always` it is tried once. The interpreted instructions are then counted from zero:
/// tapes of another plan of the system are compiled when as much has been interpreted again.
void PlanTapes::compile_if_pays(TapeGroup& group, double interpreted) {
  // Another run may hold the lock and wait for the interpreter, which this run may hold.
  const std::unique_lock lock(compiling_, std::try_to_lock);
  if (!lock || group.done) return;
  if (!always() && !tape::compiling_pays(interpreted, group.instructions, compiler_is_loaded()))
    return;
  group.done = !always();
  locked([&] { compile_tapes(group.tapes, group.series, always()); });
  group.done = true;
  interpreted_->all = 0.0;
}

namespace {

std::string described(std::string_view what, const Tapes& tapes) {
  if (tapes.empty()) return "";
  const auto compiled = std::ranges::count_if(tapes, &tape::Tape::is_machine_code);
  const auto interpreted = static_cast<std::ptrdiff_t>(tapes.size()) - compiled;
  const std::string how =
      interpreted == 0 ? "run as machine code"
      : compiled == 0  ? "interpreted"
                       : text(compiled, " run as machine code, ", interpreted, " interpreted");
  return text(what, ": ", tapes.size(), ", ", how, "\n");
}

std::string described(const std::vector<tape::SeriesOrder>& series) {
  if (series.empty()) return "";
  return text("Taylor series: of order ", series[0].order,
              series[0].is_machine_code() ? ", run as machine code\n" : ", interpreted\n");
}

}  // namespace

std::string PlanTapes::describe() const {
  return described("tapes of Jacobians", jacobians_.tapes) + described(run_.series) +
         described("tapes", run_.tapes);
}

}  // namespace saltus::python
