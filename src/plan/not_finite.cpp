// Searches for the first number that is not finite, after a step has found one.
#include <cmath>

#include "saltus/base/detail/listed.hpp"
#include "saltus/plan/detail/machine.hpp"

namespace saltus {

namespace {

/// The arguments of a block, "x = [10, -3], in = [2]". If i is given, a long state is shown by its
/// entry i only.
std::string seen_by_block(const PlanLeaf& leaf, const At& at, Index i) {
  std::string seen;
  if (at.x.size() > 6 && i >= 0)
    seen = text("x[", i, "] = ", at.x[i]);
  else if (at.x.size() > 0)
    seen = text("x = ", listed(at.x));
  for (int k = 0; k < at.u.size(); ++k) {
    const std::string& name = leaf.declared().inputs[k].name;
    seen += text(seen.empty() ? "" : ", ", name, " = ", listed(at.u[k]));
  }
  return seen.empty() ? seen : text(" where ", seen);
}

/// "nan" or "inf": the sign of a NaN has no meaning.
double shown(double value) { return std::isnan(value) ? std::abs(value) : value; }

Index first_not_finite(const VectorView& values) {
  Index i = 0;
  while (i < values.size() && std::isfinite(values[i])) ++i;
  return i;
}

}  // namespace

std::optional<NotFinite> Machine::not_finite(double t, const double* state) {
  const Seen seen = arguments_.of(carried(t, state));
  for (std::size_t k = 0; k < calls_.needs_of_derivatives.size(); ++k) {
    const OutputCall& call = calls_.needs_of_derivatives[k];
    const VectorRef out(y.data() + call.to, call.width);
    (*call.function)(*call.system, seen.at(call, t), out);
    const PlanLeaf& leaf = plan_->leaves[call.leaf];
    if (const Index i = first_not_finite({out.data(), out.size()}); i < out.size()) {
      const std::string name = plan_->name_of(plan_->node(plan_->needs.derivatives[k]));
      return NotFinite{leaf.path, text("output '", name, "', which a derivative reads,"),
                       text("entry ", i, " is ", shown(out[i]), seen_by_block(leaf, *call.at, -1))};
    }
  }
  Eigen::VectorXd xdot(plan_->nx);
  for (const Call& ode : calls_.single_odes) {
    ode_with_rest(ode, seen, t, xdot.data());
    const PlanLeaf& leaf = plan_->leaves[ode.leaf];
    const VectorView own(xdot.data() + ode.x, ode.size);
    if (const Index i = first_not_finite(own); i < own.size()) {
      return NotFinite{leaf.path, text("the derivative of block '", leaf.path, "'"),
                       text("xdot[", i, "] = ", shown(own[i]), seen_by_block(leaf, *ode.at, i))};
    }
  }
  return {};
}

}  // namespace saltus
