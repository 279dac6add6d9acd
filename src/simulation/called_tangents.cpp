// Tangents: the functions that a pass calls.
#include <algorithm>
#include <new>

#include "saltus/simulation/detail/declared_derivatives.hpp"
#include "saltus/simulation/detail/tangents.hpp"

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

/// The derivatives of `size` numbers that a function of a leaf computes from what it sees in a pass.
Eigen::MatrixXd Tangents::of_seen(const Transition::Seen& seen, Index rows,
                                  const OnSeen& function) {
  const PlanLeaf& leaf = machine_->plan().leaf(seen.leaf);
  Eigen::VectorXd x(leaf.nx), z(leaf.nz);
  Eigen::MatrixXd by(rows, size());
  for (Index k = 0; k < size(); ++k) {
    const auto read = [&](Machine& probe, double shift, double* to) {
      for (Index i = 0; i < leaf.nx; ++i) x[i] = seen.x[i] + shift * next_x_(leaf.x + i, k);
      for (Index i = 0; i < leaf.nz; ++i) z[i] = seen.z[i] + shift * next_z_(leaf.z + i, k);
      At at = probe.at(seen.leaf, t_ + shift * columns_.t[k], probe.x.data());
      at.entry = seen.entry, at.mode = seen.mode;
      new (&at.x) VectorView(x.data(), leaf.nx);
      new (&at.z) VectorView(z.data(), leaf.nz);
      function({&probe, k, shift}, at, to);
    };
    probe_.derivative(machine_->x.data(), columns_.column(k), rows, read, by.col(k).data());
  }
  return by;
}

/// The derivatives of all states of the leaf that a reset map or an update writes.
Eigen::MatrixXd Tangents::of_call(const Transition::Call& call, const Transition::Seen& seen) {
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

void Tangents::write(const PlanLeaf& leaf, const Eigen::MatrixXd& by) {
  next_x_.middleRows(leaf.x, leaf.nx) = by.topRows(leaf.nx);
  next_z_.middleRows(leaf.z, leaf.nz) = by.bottomRows(leaf.nz);
}

void Tangents::call(const Transition::Call& call, const Transition::Seen& seen) {
  write(machine_->plan().leaf(call.leaf), of_call(call, seen));
}

/// The weight of the wire is one more input, as in Transition::receive.
void Tangents::deliver(const Transition::Arrival& arrival, const Transition::Seen& seen) {
  const Plan& plan = machine_->plan();
  const PlanLeaf& leaf = plan.leaf(arrival.leaf);
  const EventInputDeclaration& input = nth(leaf.declared().event_inputs, arrival.input);
  write(leaf, of_seen(seen, leaf.nx + leaf.nz, [&](const MovedAlong& by, At& at, double* to) {
          Machine& probe = *by.probe;
          probe.y[plan.event_wires.weight.offset] = arrival.weight;
          const Bases bases = {probe.x.data(), probe.z.data(), probe.p.data(), probe.y.data()};
          at.u = {leaf.delivery_places.data(), static_cast<int>(leaf.delivery_places.size()),
                  &bases};
          int mode = seen.mode;
          begin_next(leaf, at, to, mode);
          Delivery next(VectorRef(to, leaf.nx), VectorRef(to + leaf.nx, leaf.nz), mode, leaf.path,
                        arrival.weight);
          input.reset_map(*leaf.system, at, next);
        }));
}

/// The same by declared derivatives. The inputs are those of the state before the pass.
Eigen::MatrixXd Tangents::of_declared(const Transition::Call& call, const Transition::Seen& seen,
                                      const DerivativesFunction& derivatives) {
  const PlanLeaf& leaf = machine_->plan().leaf(call.leaf);
  Machine& probe = probe_.at(machine_->x.data());
  At at = probe.at(call.leaf, call.t, probe.x.data());
  at.entry = call.entry, at.mode = seen.mode;
  new (&at.x) VectorView(seen.x, leaf.nx);
  new (&at.z) VectorView(seen.z, leaf.nz);
  const Eigen::MatrixXd by = declared_derivatives(leaf, derivatives, at, leaf.nx + leaf.nz,
                                                  text("the reset map of '", call.source, "'"));
  Eigen::MatrixXd values = Eigen::MatrixXd::Zero(by.cols(), size());
  each_column(leaf, [&](Index column, const Place& place) {
    const bool own = column < leaf.nx + leaf.nz;
    for (Index k = 0; k < size(); ++k) {
      if (place.space == Space::x)
        values(column, k) = (own ? next_x_ : columns_.x)(place.offset, k);
      else if (place.space == Space::z)
        values(column, k) = (own ? next_z_ : columns_.z)(place.offset, k);
      else if (place.space == Space::p)
        values(column, k) = columns_.p->at(place.offset, k);
      else
        values(column, k) = columns_.y(place.offset, k);
    }
  });
  values.bottomRows(1) = columns_.t;
  return by * values;
}

}  // namespace saltus
