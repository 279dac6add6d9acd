// Machine: the flat memory of one run, and the walks over the plan's lists.
#pragma once

#include <cmath>
#include <concepts>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "saltus/plan/detail/arguments.hpp"
#include "saltus/plan/detail/carried_memory.hpp"
#include "saltus/plan/detail/resting_states.hpp"
#include "saltus/plan/detail/seen_guards.hpp"

namespace saltus {

/// Describes a number that is NaN or Inf.
struct NotFinite {
  std::string block = {};  ///< path
  std::string what = {};   ///< "the derivative of block 'ball'"
  std::string entry = {};  ///< "xdot[1] = nan where x = [10, -3]"
};

/// Evaluates the lists of a plan on its memory: derivatives, guards, held outputs, recorded
/// signals. The caller of each evaluation names the state. The result is a view that lasts until
/// the next evaluation. Nothing in this class allocates after construction.
class Machine : public CarriedMemory {
 public:
  explicit Machine(std::shared_ptr<const Plan> plan);

  /// Copies a context to the memory and computes the constant outputs.
  void load(const Context& context);

  /// xdot(t, x), with everything else held.
  [[gnu::always_inline]] void derivative(double t, const double* state, double* xdot) {
    if (lone_ode_ == nullptr || resting_.any() || carrier_ != nullptr)
      return carried_derivative(t, state, xdot);
    ++rhs_calls;
    const VectorRef out(xdot, lone_ode_->size);
    (*lone_ode_->function)(*lone_ode_->system, arguments_.of(state).at(*lone_ode_, t), out);
  }
  /// Evaluates all guards that can fire now, into their slots of g, which has Plan::look_slots.
  [[gnu::always_inline]] void guards(double t, const double* state, double* g) {
    if (lone_guard_ == nullptr || carrier_ != nullptr) return carried_guards(t, state, g);
    ++guard_calls;
    const VectorRef out(g + lone_guard_->slot, lone_guard_->width);
    (*lone_guard_->function)(*lone_guard_->system, arguments_.of(state).at(*lone_guard_, t), out);
  }

  /// Evaluates the guards of some of the groups that can fire now, into their slots of g. Other
  /// slots may be written too.
  void guards_of(std::span<const int> groups, double t, const double* state, double* g);

  /// The right-hand side with its arguments except t and x, if a step that was compiled together
  /// with it may call it directly: one leaf, no needed outputs, nothing held or carried. Otherwise
  /// null.
  struct Inlined {
    const RightHandSide* function = nullptr;
    const LeafSystem* leaf = nullptr;
    const At* at = nullptr;
  };
  Inlined inlined() {
    if (inlined_.function == nullptr || resting_.any() || carrier_ != nullptr) return {};
    lone_ode_->at->mode = modes[lone_ode_->leaf];
    return inlined_;
  }

  /// Derivative and guards at exactly this state, even while a block is carried.
  void flow(double t, const double* state, double* xdot);
  void guards_at(double t, const double* state, double* g);

  /// Computes the held outputs, and the values that resets, updates and edges read, at (t, x) of
  /// the machine.
  void evaluate_instant(double t) { run(calls_.instants, t, x.data()); }
  /// Computes those of these values again, at (t, x), that also change between instants.
  void evaluate_moving(double t, const double* state) { run(calls_.moving, t, state); }
  /// Computes the values that the recorded rows show, at (t, x), and returns where they are.
  Values evaluate_taps(double t, const double* state) {
    return run(calls_.taps, t, carried(t, state)).values();
  }
  /// Computes the values whose history leaves keep, at (t, x), and returns where they are.
  Values evaluate_histories(double t, const double* state) {
    return run(calls_.histories, t, carried(t, state)).values();
  }

  /// The arguments of a leaf's functions at time t and this state of the whole machine; a view that
  /// lasts until the next evaluation. Inputs are those of the last evaluation.
  At at(std::integral auto number, double t, const double* state) {
    const PlanLeaf& of = plan_->leaves[number];
    const auto leaf = static_cast<std::size_t>(number);
    return arguments_.of(state).at(
        {nullptr, of.system, leaf, &arguments_.views()[leaf], of.x, of.nx}, t);
  }
  /// xdot of one leaf at time t and this state of the whole machine.
  void leaf_derivative(std::integral auto leaf, double t, const double* state, VectorRef xdot) {
    ++rhs_calls;
    const PlanLeaf& of = plan_->leaves[leaf];
    of.declared().continuous.ode.function(*of.system, at(leaf, t, state), xdot);
  }

  /// Computes the values that the derivatives read at (t, x), so that `at` shows them.
  void evaluate_derivative_needs(double t, const double* state) {
    run(calls_.needs_of_derivatives, t, state);
  }

  /// Announces that some leaves have other functions from now on. The owner of a value made from
  /// formulas, such as a series, compares `functions()` with the number it saw last, and makes the
  /// value anew if they differ.
  void functions_replaced() noexcept { ++functions_; }
  int functions() const noexcept { return functions_; }

  /// The entries of x that are held.
  RestingStates& resting() noexcept { return resting_; }
  const RestingStates& resting() const noexcept { return resting_; }

  /// Chooses the guards that can fire in the present modes, and by the present control signals.
  void select_guards();
  const SeenGuards& seen_guards() const noexcept { return seen_; }

  /// The first number that is not finite at (t, x): first among the values that derivatives read,
  /// then among the derivatives.
  std::optional<NotFinite> not_finite(double t, const double* state);

  std::int64_t rhs_calls = 0, guard_calls = 0, jacobian_calls = 0;

 private:
  using Seen = Arguments::OfState;

  void carried_derivative(double t, const double* state, double* xdot);
  void carried_guards(double t, const double* state, double* g);
  void ode_with_rest(const Call& ode, Seen seen, double t, double* xdot) const;
  /// A group of guards that is not computed with others, and what it reads.
  void copy_reads(int group, Seen seen, double* g) const;

  /// Makes calls at a state, and returns the arguments at this state for further calls.
  Seen run(const std::vector<OutputCall>& calls, double t, const double* state) {
    const Seen seen = arguments_.of(state);
    for (const OutputCall& call : calls) run(call, seen, t);
    return seen;
  }
  [[gnu::always_inline]] void run(const OutputCall& call, Seen seen, double t) {
    const VectorRef out(y.data() + call.to, call.width);
    (*call.function)(*call.system, seen.at(call, t), out);
    if (!call.relation) return;
    const bool at_zero = call.true_at_zero;
    for (double& value : VectorRef(out)) value = value > 0.0 || (at_zero && value == 0.0);
  }
  Seen run_needs_of(std::span<const int> groups, double t, const double* state);

  Arguments arguments_;
  Calls calls_;
  List<std::int64_t> looked_;  // of each call that guards need: the look that made it last
  std::int64_t look_ = 0;      // looks at some of the groups
  /// If this is the only ode, and it needs no computed values, it is called without a walk.
  const Call* lone_ode_ = nullptr;
  const GuardCall* lone_guard_ = nullptr;
  Inlined inlined_;  // if it has no function, no step may call it directly
  SeenGuards seen_;
  RestingStates resting_;
  int functions_ = 0;  // how often they were replaced
};

}  // namespace saltus
