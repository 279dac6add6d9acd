// Memory: the values of one run, in flat vectors.
#pragma once

#include <memory>
#include <vector>

#include "saltus/base/list.hpp"
#include "saltus/plan/compile.hpp"

namespace saltus {

/// The places of values after an evaluation. It is a view that lasts until the next evaluation.
class Values {
 public:
  Values() = default;
  explicit Values(const Bases& bases) : bases_(bases) {}
  const double* operator()(const Place& place) const {
    return nth(bases_, place.space) + place.offset;
  }
  /// The continuous state that the evaluation saw, with carried entries on their surfaces.
  const double* state() const noexcept { return bases_[0]; }

 private:
  Bases bases_{};
};

/// Throws ModelError, with the first difference, unless the context is one of the plan's system.
void require_context_of(const Plan& plan, const Context& context);

/// x, z, p, modes and signals y of a plan. Threads share a plan; each has its own memory. Nothing
/// in this class allocates after construction.
class Memory {
 public:
  explicit Memory(std::shared_ptr<const Plan> plan);
  Memory(const Memory&) = delete;  // views point into it
  Memory& operator=(const Memory&) = delete;

  /// The present values, as a context of the same layout. `settled`: the events at t have happened.
  Context save(const Context& like, double t, std::shared_ptr<const Continuation> continuation,
               bool settled = true, std::shared_ptr<const PendingExecutions> pending = {}) const;

  /// The places of the present values.
  Values values() const { return Values({x.data(), z.data(), p.data(), y.data()}); }
  /// The place of one present value.
  const double* value(const Place& place) const { return values()(place); }
  double* signal(int node) { return y.data() + plan_->node(node).place.offset; }
  bool truth(int node) const { return *value(plan_->node(node).place) != 0.0; }
  /// The held truth of one entry of a relation, 0 or 1.
  double& truth_at(int node, Index entry) { return signal(node)[entry]; }
  const Plan& plan() const noexcept { return *plan_; }
  const std::shared_ptr<const Plan>& shared_plan() const noexcept { return plan_; }

  Eigen::VectorXd x, z, p, y;
  List<int> modes;

 protected:
  /// The values of a context. ModelError for a context of another system, and for parameters that a
  /// block refuses.
  void take(const Context& context);

  std::shared_ptr<const Plan> plan_;

 private:
  void check_parameters() const;

  std::shared_ptr<const Layout> known_;  // a layout that is known to fit the plan
};

}  // namespace saltus
