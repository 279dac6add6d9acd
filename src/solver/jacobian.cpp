// Compressed differences, and the leaves' own Jacobians.
#include "saltus/solver/jacobian.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace saltus {

namespace {

/// Where entry (row, column) stands in the pattern.
Index entry_of(const Sparsity& places, Index row, Index column) {
  const auto rows = places.column(column);
  const auto found = std::ranges::lower_bound(rows, static_cast<int>(row));
  return places.start[static_cast<std::size_t>(column)] + (found - rows.begin());
}

}  // namespace

Jacobian::Jacobian(Machine& machine)
    : machine_(&machine), pattern_(jacobian_pattern(machine.plan())) {
  if (!pattern_.overflow) prepare();
}

void Jacobian::fill_up() {
  pattern_ = {.places = full_sparsity(machine_->plan().nx),
              .own = {},
              .differences = {},
              .overflow = false};
  pattern_.differences.assign(pattern_.places.rows.size(), 1);
  prepare();
}

void Jacobian::prepare() {
  colouring_ = colour(pattern_);
  Index widest = 0;
  for (const int leaf : pattern_.own) {
    add_own(leaf);
    widest = std::max(widest, own_.back().size);
  }
  block_.resize(widest);
  for (auto* v : {&x_, &f_, &base_, &moved_}) v->resize(machine_->plan().nx);
}

/// Values by their declared order; else those of the dense block, column by column.
void Jacobian::add_own(int number) {
  const PlanLeaf& leaf = machine_->plan().leaves[static_cast<std::size_t>(number)];
  const ContinuousState& state = leaf.declared().continuous;
  Own own{.leaf = number, .size = leaf.nx * leaf.nx, .copies = {}};
  const auto copy = [&](Index row, Index column, Index from) {
    own.copies.push_back({entry_of(pattern_.places, leaf.x + row, leaf.x + column), from,
                          static_cast<int>(leaf.x + row)});
  };
  if (state.sparsity) {
    const auto& entries = *state.sparsity;
    if (state.sparse_jacobian) own.size = static_cast<Index>(entries.size());
    for (std::size_t k = 0; k < entries.size(); ++k) {
      const auto [row, column] = entries[k];
      copy(row, column, state.sparse_jacobian ? static_cast<Index>(k) : row + leaf.nx * column);
    }
  } else {
    for (Index column = 0; column < leaf.nx; ++column)
      for (Index row = 0; row < leaf.nx; ++row) copy(row, column, row + leaf.nx * column);
  }
  own_.push_back(std::move(own));
}

bool Jacobian::operator()(double t, const double* x, const double* xdot, const Increments& by,
                          double* out) {
  ++machine_->jacobian_calls;
  if (machine_->carrier != nullptr) {  // the derivative at hand has the speed of the surface in it
    std::copy_n(machine_->carried(t, x), x_.size(), x_.data());
    machine_->flow(t, x_.data(), base_.data());
    xdot = base_.data();
  } else if (colours() > 0) {
    std::copy_n(x, x_.size(), x_.data());
  }
  if (colours() > 0 && !differences(t, x, xdot, by, out)) return false;
  if (own_.empty()) return true;
  machine_->evaluate_derivative_needs(t, machine_->carrier != nullptr ? x_.data() : x);
  for (const Own& own : own_) take(own, t, out);
  return true;
}

/// CVODE's: what makes the change of f about a thousand of its rounding errors, over the weight.
double Jacobian::least_increment(const double* x, const double* xdot, const Increments& by) const {
  const Index n = x_.size();
  double sum = 0.0;
  for (Index i = 0; i < n; ++i) {
    const double scaled = xdot[i] / (by.rtol * std::abs(x[i]) + by.atol);
    sum += scaled * scaled;
  }
  const double norm = std::sqrt(sum / static_cast<double>(n));
  const double least = 1000.0 * std::abs(by.h) * std::numeric_limits<double>::epsilon() *
                       static_cast<double>(n) * norm;
  return least > 0.0 && std::isfinite(least) ? least : 1.0;
}

bool Jacobian::differences(double t, const double* x, const double* xdot, const Increments& by,
                           double* out) {
  const double root = std::sqrt(std::numeric_limits<double>::epsilon());
  const double least = least_increment(x, xdot, by);
  const Sparsity& places = pattern_.places;
  for (Index colour = 0; colour < colours(); ++colour) {
    for (const int j : colouring_.of(colour)) {
      const double before = x_[j];
      const double size = std::abs(before);
      x_[j] += std::max(root * size, least * (by.rtol * size + by.atol));
      moved_[j] = before;
    }
    machine_->flow(t, x_.data(), f_.data());
    if (!f_.allFinite()) return false;
    for (const int j : colouring_.of(colour)) {
      const double inverse = 1.0 / (x_[j] - moved_[j]);  // as it was rounded
      x_[j] = moved_[j];
      const auto first = static_cast<std::size_t>(places.start[static_cast<std::size_t>(j)]),
                 last = static_cast<std::size_t>(places.start[static_cast<std::size_t>(j) + 1]);
      for (std::size_t k = first; k < last; ++k) {
        const int i = places.rows[k];
        if (pattern_.differences[k])
          out[place(static_cast<Index>(k))] = (f_[i] - xdot[i]) * inverse;
      }
    }
  }
  return true;
}

void Jacobian::take(const Own& own, double t, double* out) {
  const PlanLeaf& leaf = machine_->plan().leaves[static_cast<std::size_t>(own.leaf)];
  const ContinuousState& state = leaf.declared().continuous;
  block_.head(own.size).setZero();
  const At at = machine_->at(static_cast<std::size_t>(own.leaf), t);
  if (state.sparse_jacobian)
    state.sparse_jacobian(*leaf.system, at, VectorRef(block_.data(), own.size));
  else
    state.jacobian(*leaf.system, at, MatrixRef(block_.data(), leaf.nx, leaf.nx));
  if (!block_.head(own.size).allFinite())
    refuse(own, t, "is not finite (NaN or Inf); check its function at this state");
  for (const Copy& copy : own.copies) {
    out[place(copy.entry)] = machine_->rests(copy.row) ? 0.0 : block_[copy.from];
    block_[copy.from] = 0.0;
  }
  if (state.sparsity && !block_.head(own.size).isZero(0.0))
    refuse(own, t, "has values outside the sparsity that it declares; name those entries too");
}

void Jacobian::refuse(const Own& own, double t, const char* what) const {
  const std::string& path = machine_->plan().leaves[static_cast<std::size_t>(own.leaf)].path;
  throw SimulationError(text("t = ", t, " s: the Jacobian of block '", path, "' ", what), t, path);
}

}  // namespace saltus
