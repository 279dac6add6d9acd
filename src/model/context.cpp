// Context: the checks of the with_* methods, and parameters by name.
#include "saltus/model/context.hpp"

#include <cmath>

#include "saltus/model/computed_parameter.hpp"
#include "saltus/model/detail/sound.hpp"

namespace saltus {

namespace detail {

void require_finite(const Eigen::VectorXd& values, std::string_view what) {
  for (Index i = 0; i < values.size(); ++i) {
    if (!std::isfinite(values[i])) {
      throw ModelError(text(what, ": entry ", i, " is ", values[i], "; give a finite value"));
    }
  }
}

}  // namespace detail

void detail::require_settable(Layout::Role role, std::string_view name) {
  if (role != Layout::Role::computed) return;
  throw ModelError(
      text("parameter '", name, "' is computed from the parameters of a diagram; set those"));
}

Context Context::with_computed(std::shared_ptr<const ComputedParameters> computed) const {
  if (!computed || layout().computed) return *this;
  Context next = *this;
  Layout known = layout();
  known.computed = std::move(computed);
  next.layout_ = std::make_shared<const Layout>(std::move(known));
  next.compute_parameters();
  return next;
}

void Context::compute_parameters() {
  if (layout_ && layout_->computed) layout_->computed->compute(p_);
}

void Context::replace(Eigen::VectorXd& values, const Eigen::VectorXd& with, std::string_view what) {
  if (values.size() != with.size()) {
    throw ModelError(text(what, ": expected ", values.size(), " values, found ", with.size()));
  }
  detail::require_finite(with, what);
  values = with;
}

Context Context::zero(std::shared_ptr<const Layout> layout) {
  Context context(std::move(layout));
  Index nx = 0, nz = 0, np = 0;
  for (const Layout::Leaf& leaf : context.layout().leaves)
    nx += leaf.nx, nz += leaf.nz, np += leaf.np;
  context.x_.setZero(nx), context.z_.setZero(nz), context.p_.setZero(np);
  context.modes_.assign(context.layout().leaves.size(), 0);
  return context;
}

const Layout& Context::layout() const {
  static const Layout none;
  return layout_ ? *layout_ : none;
}

/// A context that was made from saved values may not know its leaves.
bool Context::has_one_mode() const {
  const auto& leaves = layout().leaves;
  return modes_.size() == 1 || (!leaves.empty() && layout().is_alone(leaves.front()));
}

int Context::mode() const {
  if (!has_one_mode())
    throw ModelError("mode(): this is the context of several blocks; take context[id] first");
  return modes_.front();
}

Context Context::with_values(const ContextValues& values) const {
  if (!std::isfinite(values.time)) throw ModelError(text("time: ", values.time, " is not finite"));
  Context next = *this;
  replace(next.x_, values.continuous_state, "continuous state");
  replace(next.z_, values.discrete_state, "discrete state");
  replace(next.p_, values.parameters, "parameters");
  if (values.modes.size() != modes_.size()) {
    throw ModelError(
        text("modes: expected ", modes_.size(), " values, found ", values.modes.size()));
  }
  next.modes_ = values.modes, next.time_ = values.time, next.settled_ = values.settled;
  if (values.continuation) detail::require_sound(*values.continuation);
  next.continuation_ = values.continuation;
  if (values.pending) detail::require_sound(*values.pending, layout());
  next.pending_ = values.pending;
  return next;
}

Context Context::with_time(double t) const {
  if (!std::isfinite(t)) throw ModelError(text("time: ", t, " is not finite"));
  Context next = changed();
  next.time_ = t;
  next.settled_ = false;
  return next;
}

Context Context::with_continuous_state(const Eigen::VectorXd& x) const {
  Context next = changed();
  replace(next.x_, x, "continuous state");
  return next;
}

Context Context::with_discrete_state(const Eigen::VectorXd& z) const {
  Context next = changed();
  replace(next.z_, z, "discrete state");
  return next;
}

Context Context::with_mode(int mode) const {
  if (!has_one_mode())
    throw ModelError("with_mode: this is the context of several blocks; take context[id] first");
  Context next = changed();
  next.modes_.front() = mode;
  return next;
}

std::pair<const Layout::Leaf*, const Layout::Parameter*> Context::find_parameter(
    std::string_view name) const {
  std::vector<std::string> known;
  for (const auto& leaf : layout().leaves) {
    for (const auto& parameter : leaf.parameters) {
      const std::string full = layout().name_of(leaf, parameter.name);
      if (full == name) return {&leaf, &parameter};
      known.push_back(full);
    }
  }
  throw ModelError(text("unknown parameter '", name, "'", known_names(name, known)));
}

Context Context::with_parameter(std::string_view name, const Eigen::VectorXd& value) const {
  const auto [leaf, parameter] = find_parameter(name);
  detail::require_settable(parameter->role, name);
  detail::require_finite(value, text("parameter '", name, "'"));
  if (value.size() != 1 && value.size() != parameter->size) {
    throw ModelError(text("parameter '", name, "': expected ", parameter->size, " values, found ",
                          value.size()));
  }
  Context next = changed();
  for (Index i = 0; i < parameter->size; ++i) {
    next.p_[leaf->p + parameter->offset + i] = value[value.size() == 1 ? 0 : i];
  }
  next.compute_parameters();
  return next;
}

Context Context::with_parameter(std::string_view name, double value) const {
  return with_parameter(name, Eigen::VectorXd::Constant(1, value));
}

Eigen::VectorXd Context::parameter(std::string_view name) const {
  const auto [leaf, parameter] = find_parameter(name);
  return p_.segment(leaf->p + parameter->offset, parameter->size);
}

const Layout::Range& Context::range(SystemId id) const {
  std::vector<std::string> known;
  for (const auto& system : layout().systems) {
    if (system.id == id) return system;
    known.push_back(text(system.path, " (", system.id.value, ")"));
  }
  throw ModelError(
      text("no system with id ", id.value, " in this context. Known: ", quoted_list(known)));
}

}  // namespace saltus
