// Machine: the flat memory of one run, and the walks over the plan's lists.
#pragma once

#include <cmath>
#include <cstdint>
#include <memory>
#include <new>
#include <optional>
#include <string>
#include <vector>

#include "saltus/plan/compile.hpp"

namespace saltus {

/// Moves the states of blocks that rest on a moving surface with that surface.
class Carrier {
 public:
  virtual ~Carrier() = default;
  /// Sets the states it carries, from t and all other states.
  virtual void carry(double t, double* x) = 0;
  /// The derivatives of these states with their surface, for the control of the step size.
  virtual void rates(double t, const double* x, double* xdot) = 0;
  /// The guards in place of those of the carried blocks: below zero while a block presses on its
  /// surface.
  virtual void lift(double t, const double* x, double* g) = 0;
};

/// Describes a number that is NaN or Inf.
struct NotFinite {
  std::string block = {};  ///< path
  std::string what = {};   ///< "the derivative of block 'ball'"
  std::string entry = {};  ///< "xdot[1] = nan where x = [10, -3]"
};

/// Where values are after an evaluation: a view that lasts until the next one.
class Values {
 public:
  Values() = default;
  explicit Values(const Bases& bases) : bases_(bases) {}
  const double* operator()(const Place& place) const {
    return bases_[static_cast<std::size_t>(place.space)] + place.offset;
  }
  /// The continuous state that the evaluation saw, with carried entries on their surfaces.
  const double* state() const noexcept { return bases_[0]; }

 private:
  Bases bases_{};
};

/// x, z, p, modes and signals of one run. Threads share a plan; each has its own machine. Nothing
/// in this class allocates after construction.
class Machine {
 public:
  explicit Machine(std::shared_ptr<const Plan> plan);
  Machine(const Machine&) = delete;  // views_ point into it
  Machine& operator=(const Machine&) = delete;

  /// Copies a context to the machine and computes the constant outputs.
  void load(const Context& context);
  /// The present values, as a context of the same layout.
  Context save(const Context& like, double t,
               std::shared_ptr<const Continuation> continuation) const;

  /// xdot(t, x), with everything else held.
  [[gnu::always_inline]] void derivative(double t, const double* state, double* xdot) {
    if (lone_ode_ == nullptr || at_rest_ > 0 || carrier_ != nullptr)
      return carried_derivative(t, state, xdot);
    ++rhs_calls;
    bases_[0] = state;
    const VectorRef out(xdot, lone_ode_->size);
    (*lone_ode_->function)(*lone_ode_->system, seen_by(*lone_ode_, t), out);
  }
  /// Evaluates all guards that can fire now, into their slots of g.
  void guards(double t, const double* state, double* g) {
    if (lone_guard_ == nullptr || carrier_ != nullptr) return carried_guards(t, state, g);
    ++guard_calls;
    bases_[0] = state;
    const VectorRef out(g + lone_guard_->slot, lone_guard_->width);
    (*lone_guard_->function)(*lone_guard_->system, seen_by(*lone_guard_, t), out);
  }

  /// The right-hand side, if a step that was compiled together with it may call it directly: one
  /// leaf, no needed outputs, nothing held or carried. Otherwise null.
  const RightHandSide* inlined() const noexcept {
    return at_rest_ > 0 || carrier_ != nullptr ? nullptr : inlined_;
  }
  /// Its arguments except t and x.
  const At& inlined_at() { return seen_by(*lone_ode_, 0.0); }
  const LeafSystem& inlined_leaf() const { return *lone_ode_->system; }

  /// Derivative and guards at exactly this state, even while a block is carried.
  void flow(double t, const double* state, double* xdot);
  void guards_at(double t, const double* state, double* g);

  /// Computes the held outputs, and the values that resets, updates and edges read, at (t, x) of
  /// the machine.
  void evaluate_instant(double t) { run(instant_calls_, t, x.data()); }
  /// Of these values, computes again those that change between instants too, at (t, x).
  void evaluate_moving(double t, const double* state) { run(moving_calls_, t, state); }
  /// Computes the values that the recorded rows show, at (t, x), and returns where they are.
  Values evaluate_taps(double t, const double* state) {
    run(tap_calls_, t, carried(t, state));
    return Values(bases_);
  }

  /// The arguments of a leaf's functions at time t and this state of the whole machine; a view that
  /// lasts until the next evaluation. Inputs are those of the last evaluation.
  At at(std::size_t leaf, double t, const double* state) {
    bases_[0] = state;
    const PlanLeaf& of = plan_->leaves[leaf];
    return seen_by({nullptr, of.system, leaf, &views_[leaf], of.x, of.nx}, t);
  }
  /// The same at the machine's own state.
  At at(std::size_t leaf, double t) { return at(leaf, t, x.data()); }
  /// xdot of one leaf at time t and this state of the whole machine.
  void leaf_derivative(std::size_t leaf, double t, const double* state, VectorRef xdot) {
    ++rhs_calls;
    const PlanLeaf& of = plan_->leaves[leaf];
    of.declared().continuous.ode.function(*of.system, at(leaf, t, state), xdot);
  }

  /// The state with all carried entries moved to their surface.
  const double* carried(double t, const double* state) {
    return carrier_ == nullptr ? state : carry(t, state);
  }
  /// Computes the values that the derivatives read at (t, x), so that `at` shows them.
  void evaluate_derivative_needs(double t, const double* state) {
    run(needs_of_derivatives_, t, state);
  }

  /// Entry i of x has zero derivative from now on, until `move` was called as often as `rest`.
  void rest(Index i) { change_rest(i, 1); }
  void move(Index i) { change_rest(i, -1); }
  bool rests(Index i) const { return rests_[static_cast<std::size_t>(i)] > 0; }

  /// Who puts blocks on a moving surface where it is, while there are any; null: nobody.
  void carry_by(Carrier* carrier) noexcept { carrier_ = carrier; }
  bool carries() const noexcept { return carrier_ != nullptr; }
  /// Puts the blocks that are carried where their surfaces are at t.
  void put_carried(double t, double* state) {
    if (carrier_ != nullptr) carrier_->carry(t, state);
  }

  /// Chooses the guards that can fire in the present modes.
  void select_guards();
  const std::vector<int>& active_guards() const noexcept { return active_; }

  /// A value at the machine's own state.
  const double* value(const Place& place) const {
    return place.space == Space::x ? x.data() + place.offset : Values(bases_)(place);
  }
  double* signal(int node) { return y.data() + plan_->node(node).place.offset; }
  bool truth(int node) const { return *value(plan_->node(node).place) != 0.0; }
  /// The held truth of one entry of a relation, 0 or 1.
  double& truth_at(int node, Index entry) { return signal(node)[entry]; }
  const Plan& plan() const noexcept { return *plan_; }
  const std::shared_ptr<const Plan>& shared_plan() const noexcept { return plan_; }

  /// The first number that is not finite at (t, x): first among the values that derivatives read,
  /// then among the derivatives.
  std::optional<NotFinite> not_finite(double t, const double* state);

  Eigen::VectorXd x, z, p, y;
  std::vector<int> modes;
  std::int64_t rhs_calls = 0, guard_calls = 0, jacobian_calls = 0;

 private:
  /// A function of a leaf with everything that a call needs, because it is called some ten times a
  /// step.
  struct Call {
    const VectorFunction* function;
    const LeafSystem* system;
    std::size_t leaf;
    At* at;         // the arguments of the leaf, in views_
    Index x, size;  // the first of its states, and their number
  };
  struct OutputCall : Call {
    Index to, width;  // in y
    bool relation, true_at_zero;
  };
  struct GuardCall : Call {
    Index slot, width;
    bool opaque;
  };

  void carried_derivative(double t, const double* state, double* xdot);
  void carried_guards(double t, const double* state, double* g);
  const double* carry(double t, const double* state);

  /// The present arguments of leaf i. Only the values that change from call to call are set again.
  const At& seen_by(const Call& call, double t) {
    At& at = *call.at;
    at.time = t;
    new (&at.x) VectorView(bases_[0] + call.x, call.size);
    at.mode = modes[call.leaf];
    return at;
  }
  Call call_of(const VectorFunction& function, std::size_t leaf) {
    const PlanLeaf& of = plan_->leaves[leaf];
    return {&function, of.system, leaf, &views_[leaf], of.x, of.nx};
  }
  void run(const std::vector<OutputCall>& calls, double t, const double* state) {
    bases_[0] = state;
    for (const OutputCall& call : calls) {
      const VectorRef out(y.data() + call.to, call.width);
      (*call.function)(*call.system, seen_by(call, t), out);
      if (call.relation) make_truth(out, call.true_at_zero);
    }
  }
  static void make_truth(VectorRef values, bool at_zero) {
    for (double& value : values) value = value > 0.0 || (at_zero && value == 0.0) ? 1.0 : 0.0;
  }
  void ode_of(const Call& ode, double t, double* xdot) {
    const VectorRef out(xdot + ode.x, ode.size);
    (*ode.function)(*ode.system, seen_by(ode, t), out);
  }
  void ode_with_rest(const Call& ode, double t, double* xdot);
  void change_rest(Index i, int by);
  void guard(const GuardCall& call, double t, double* g);
  bool reads_states(std::size_t leaf) const;
  std::vector<OutputCall> calls_of(const std::vector<int>& nodes);
  std::vector<OutputCall> calls_of(const Walk& walk, const std::vector<int>& nodes);
  std::vector<Call> odes_of(const Walk& walk);
  Call whole_call(const VectorFunction& fused);

  std::shared_ptr<const Plan> plan_;
  Bases bases_{};
  Place place_of_z_;       // all of z, for fused functions
  std::vector<At> views_;  // one for each leaf, and one of the whole machine for fused functions
  std::vector<const double*> relation_values_;
  std::vector<OutputCall> constant_calls_, instant_calls_, moving_calls_, derivative_calls_,
      guard_calls_list_, tap_calls_;
  std::vector<Call> odes_;                        // of leaves that have one, and the fused function
  std::vector<OutputCall> needs_of_derivatives_;  // each with its own call
  std::vector<GuardCall> groups_;
  std::optional<GuardCall> fused_guards_;
  /// If this is the only ode, and it needs no computed values, it is called without a walk.
  const Call* lone_ode_ = nullptr;
  const GuardCall* lone_guard_ = nullptr;
  const RightHandSide* inlined_ = nullptr;
  std::vector<int> active_, called_;  // groups that can fire, and those of them that are not fused
  std::vector<int> rests_;            // entries of x: the number of holds on each
  std::vector<Index> resting_of_;     // leaves: the number of their states at rest
  Index at_rest_ = 0;                 // in total
  std::vector<std::size_t> leaf_of_state_;
  Carrier* carrier_ = nullptr;  // while a block rests on a surface that moves
  Eigen::VectorXd carried_x_;
};

}  // namespace saltus
