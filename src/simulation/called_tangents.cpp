// The derivatives of what a pass calls: declared, or differences of the call.
#include "saltus/simulation/detail/called_tangents.hpp"

#include <algorithm>
#include <new>

#include "saltus/simulation/detail/declared_derivatives.hpp"

namespace saltus {

namespace {

/// The declared derivatives of a reset map; null if there are none.
const DerivativesFunction* derivatives_of(const PlanLeaf& leaf, const Transition::Call& call) {
  for (const ZeroCrossing& crossing : leaf.declared().zero_crossings)
    if (&crossing.reset_map == call.map && crossing.reset_derivatives)
      return &crossing.reset_derivatives;
  return nullptr;
}

/// Sets the outputs of a function that writes states to the present ones.
Next begin_next(const PlanLeaf& leaf, const At& at, double* to, int& mode) {
  std::copy_n(at.x.data(), leaf.nx, to), std::copy_n(at.z.data(), leaf.nz, to + leaf.nx);
  return {VectorRef(to, leaf.nx), VectorRef(to + leaf.nx, leaf.nz), mode, leaf.path};
}

}  // namespace

void CalledTangents::open(double t) {
  t_ = t;
  if (machine_->plan().reads_before) inputs_before_.keep(*machine_, *columns_, t_, *probe_);
}

/// The derivatives of `rows` numbers that a function of a leaf computes from what it sees in a pass.
Eigen::MatrixXd CalledTangents::of_seen(const Transition::Seen& seen, Index rows,
                                        const OnSeen& function) {
  const PlanLeaf& leaf = machine_->plan().leaf(seen.leaf);
  Eigen::VectorXd x(leaf.nx), z(leaf.nz);
  Eigen::MatrixXd by(rows, columns_->size());
  for (Index k = 0; k < columns_->size(); ++k) {
    const auto read = [&](Machine& probe, double shift, double* to) {
      for (Index i = 0; i < leaf.nx; ++i) x[i] = seen.x[i] + shift * next_->x(leaf.x + i, k);
      for (Index i = 0; i < leaf.nz; ++i) z[i] = seen.z[i] + shift * next_->z(leaf.z + i, k);
      At at = probe.at(seen.leaf, t_ + shift * columns_->t[k], probe.x.data());
      at.entry = seen.entry, at.mode = seen.mode;
      new (&at.x) VectorView(x.data(), leaf.nx);
      new (&at.z) VectorView(z.data(), leaf.nz);
      function({&probe, k, shift}, at, to);
    };
    probe_->derivative(machine_->x.data(), columns_->column(k), rows, read, by.col(k).data());
  }
  return by;
}

Eigen::MatrixXd CalledTangents::of(const Transition::Call& call, const Transition::Seen& seen) {
  const PlanLeaf& leaf = machine_->plan().leaf(call.leaf);
  if (const DerivativesFunction* declared = derivatives_of(leaf, call))
    return of_declared(call, seen, *declared);
  return of_seen(seen, leaf.nx + leaf.nz, [&](const MovedAlong& by, At& at, double* to) {
    if (call.before) at.u = inputs_before_.moved(*by.probe, call.leaf, by.column, by.shift);
    int mode = seen.mode;
    Next next = begin_next(leaf, at, to, mode);
    (*call.map)(*leaf.system, at, next);
  });
}

/// The weight of the wire is one more input, as in Transition::receive.
Eigen::MatrixXd CalledTangents::of(const Transition::Arrival& arrival,
                                   const Transition::Seen& seen) {
  const Plan& plan = machine_->plan();
  const PlanLeaf& leaf = plan.leaf(arrival.leaf);
  const EventInputDeclaration& input = nth(leaf.declared().event_inputs, arrival.input);
  return of_seen(seen, leaf.nx + leaf.nz, [&](const MovedAlong& by, At& at, double* to) {
    Machine& probe = *by.probe;
    probe.y[plan.event_wires.weight.offset] = arrival.weight;
    const Bases bases = {probe.x.data(), probe.z.data(), probe.p.data(), probe.y.data()};
    at.u = {leaf.delivery_places.data(), static_cast<int>(leaf.delivery_places.size()), &bases};
    int mode = seen.mode;
    begin_next(leaf, at, to, mode);
    Delivery next(VectorRef(to, leaf.nx), VectorRef(to + leaf.nx, leaf.nz), mode, leaf.path,
                  arrival.weight);
    input.reset_map(*leaf.system, at, next);
  });
}

Eigen::RowVectorXd CalledTangents::of(const NumberOf& number, const Transition::Seen& seen) {
  const LeafSystem& system = *machine_->plan().leaf(seen.leaf).system;
  return of_seen(seen, 1, [&](const MovedAlong&, At& at, double* to) { *to = number(system, at); });
}

Eigen::RowVectorXd CalledTangents::of(const PriorityOf& one) {
  Eigen::RowVectorXd by = Eigen::RowVectorXd::Zero(columns_->size());
  if (one.priority == nullptr || one.priority->is_constant()) return by;
  const LeafSystem& system = *machine_->plan().leaf(one.leaf).system;
  for (Index k = 0; k < columns_->size(); ++k) {
    const auto read = [&](Machine& probe, double shift, double* to) {
      At at = probe.at(one.leaf, t_ + shift * columns_->t[k], probe.x.data());
      at.entry = one.entry;
      *to = (*one.priority)(system, at);
    };
    probe_->derivative(machine_->x.data(), columns_->column(k), 1, read, &by[k]);
  }
  return by;
}

/// The derivatives of the states by declared ones. The inputs are those of the state before the pass.
Eigen::MatrixXd CalledTangents::of_declared(const Transition::Call& call,
                                            const Transition::Seen& seen,
                                            const DerivativesFunction& derivatives) {
  const PlanLeaf& leaf = machine_->plan().leaf(call.leaf);
  Machine& probe = probe_->at(machine_->x.data());
  At at = probe.at(call.leaf, call.t, probe.x.data());
  at.entry = call.entry, at.mode = seen.mode;
  new (&at.x) VectorView(seen.x, leaf.nx);
  new (&at.z) VectorView(seen.z, leaf.nz);
  const Eigen::MatrixXd by = declared_derivatives(leaf, derivatives, at, leaf.nx + leaf.nz,
                                                  text("the reset map of '", call.source, "'"));
  return by * values_of(leaf, by.cols());
}

/// The columns of the `count` values by which a block declares derivatives; the last is the time.
Eigen::MatrixXd CalledTangents::values_of(const PlanLeaf& leaf, Index count) const {
  Eigen::MatrixXd values = Eigen::MatrixXd::Zero(count, columns_->size());
  each_column(leaf, [&](Index column, const Place& place) {
    const bool own = column < leaf.nx + leaf.nz;
    for (Index k = 0; k < columns_->size(); ++k) {
      if (place.space == Space::x)
        values(column, k) = (own ? next_->x : columns_->x)(place.offset, k);
      else if (place.space == Space::z)
        values(column, k) = (own ? next_->z : columns_->z)(place.offset, k);
      else if (place.space == Space::p)
        values(column, k) = columns_->p->at(place.offset, k);
      else
        values(column, k) = columns_->y(place.offset, k);
    }
  });
  values.bottomRows(1) = columns_->t;
  return values;
}

}  // namespace saltus
