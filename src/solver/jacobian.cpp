// Jacobian: compressed differences, and the leaves' own Jacobians.
#include "saltus/solver/detail/jacobian.hpp"
#include "saltus/solver/detail/linear_thresholds.hpp"
#include "saltus/solver/detail/thresholds.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace saltus {

namespace {

using thresholds::eps, thresholds::unexplained;

/// Index of entry (row, column) in the pattern.
Index entry_of(const Sparsity& places, Index row, Index column) {
  const auto rows = places.column(column);
  const auto found = std::ranges::lower_bound(rows, static_cast<int>(row));
  return places.start[column] + (found - rows.begin());
}

}  // namespace

Jacobian::Jacobian(Machine& machine, const FoundBlocks& found)
    : machine_(&machine), pattern_(jacobian_pattern(machine.plan(), found)) {
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

/// Notes how the values of a leaf's own Jacobian are copied. They are in declared order, or they
/// are a dense block, column by column.
void Jacobian::add_own(int number) {
  const PlanLeaf& leaf = machine_->plan().leaves[number];
  const ContinuousState& state = leaf.declared().continuous;
  Own own{.leaf = number, .size = leaf.nx * leaf.nx, .copies = {}};
  const auto copy = [&](Index row, Index column, Index from) {
    own.copies.push_back({entry_of(pattern_.places, leaf.x + row, leaf.x + column), from,
                          static_cast<int>(leaf.x + row), static_cast<int>(leaf.x + column)});
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
  if (machine_->carries() || colours() > 0) xdot = begin_at(t, x, xdot);
  if (colours() > 0 && !differences(t, x, xdot, by, out)) return false;
  if (own_.empty()) return true;
  machine_->evaluate_derivative_needs(t, machine_->carries() ? x_.data() : x);
  return std::ranges::all_of(own_, [&](const Own& own) { return take(own, t, x, xdot, by, out); });
}

/// Copies the state, with carried blocks on their surfaces, to x_, and returns the derivative
/// there. `xdot` cannot be used if a block is carried, because it contains the speed of the
/// surface.
const double* Jacobian::begin_at(double t, const double* x, const double* xdot) {
  std::copy_n(machine_->carried(t, x), x_.size(), x_.data());
  if (!machine_->carries()) return xdot;
  machine_->flow(t, x_.data(), base_.data());
  return base_.data();
}

/// CVODE's least increment, in weights: f changes by about a thousand of its rounding errors.
double Jacobian::least_increment(const double* x, const double* xdot, const Increments& by) const {
  const Index n = x_.size();
  double sum = 0.0;
  for (Index i = 0; i < n; ++i) {
    const double scaled = xdot[i] / by.tolerance(i, std::abs(x[i]));
    sum += scaled * scaled;
  }
  const double norm = std::sqrt(sum / static_cast<double>(n));
  const double least =
      thresholds::difference_roundings * std::abs(by.h) * eps * static_cast<double>(n) * norm;
  return least > 0.0 && std::isfinite(least) ? least : 1.0;
}

double Jacobian::increment(Index j, double x, double least, const Increments& by) const {
  const double size = std::abs(x);
  return std::max(std::sqrt(eps) * size, least * by.tolerance(j, size));
}

/// Moves the states of a colour by their increments, downwards if `least` is negative, and evaluates
/// f there. If it is not finite, as beyond the edge of its domain, they are moved back: false.
bool Jacobian::move(double t, Index colour, double least, const Increments& by) {
  for (const int j : colouring_.of(colour)) {
    moved_[j] = x_[j];
    x_[j] += std::copysign(increment(j, x_[j], std::abs(least), by), least);
  }
  machine_->flow(t, x_.data(), f_.data());
  if (f_.allFinite()) return true;
  for (const int j : colouring_.of(colour)) x_[j] = moved_[j];
  return false;
}

bool Jacobian::differences(double t, const double* x, const double* xdot, const Increments& by,
                           double* out) {
  const double least = least_increment(x, xdot, by);
  const Sparsity& places = pattern_.places;
  for (Index colour = 0; colour < colours(); ++colour) {
    if (!move(t, colour, least, by) && !move(t, colour, -least, by)) return false;
    for (const int j : colouring_.of(colour)) {
      const double inverse = 1.0 / (x_[j] - moved_[j]);  // the rounded increment
      x_[j] = moved_[j];
      for (Index k = places.start[j]; k < places.start[j + 1]; ++k) {
        const int i = places.rows[k];
        if (pattern_.differences[k]) out[place(k)] = (f_[i] - xdot[i]) * inverse;
      }
    }
  }
  return true;
}

bool Jacobian::explains(double t, const double* x, const double* xdot, const Increments& by,
                        const double* values) {
  xdot = begin_at(t, x, xdot);
  moved_ = x_;
  const double size = std::min(1.0, std::sqrt(eps) / by.rtol);
  const auto tolerance = [&](Index j) { return by.tolerance(j, std::abs(moved_[j])); };
  for (Index j = 0; j < x_.size(); ++j) {
    const std::uint64_t bits = random_();
    const double part = 0.5 + 0.5 * std::ldexp(static_cast<double>(bits >> 11), -53);
    x_[j] += ((bits & 1U) != 0 ? size : -size) * part * tolerance(j);
  }
  machine_->flow(t, x_.data(), f_.data());
  move_by_values(values);
  for (Index i = 0; i < x_.size(); ++i) {
    const double rest = std::abs(f_[i] - xdot[i] - sum_[i]);
    if (rest > least_[i] + thresholds::unexplained_roundings * eps * std::abs(xdot[i]) &&
        std::abs(by.h) * rest > thresholds::unexplained * size * tolerance(i))
      return false;
  }
  return true;
}

/// Computes J v with v = x_ - moved_, which includes the rounding of x_, and for each row the error
/// bound of that sum.
void Jacobian::move_by_values(const double* values) {
  sum_.setZero(x_.size()), least_.setZero(x_.size());
  const Sparsity& places = pattern_.places;
  Index k = 0;
  for (Index j = 0; j < x_.size(); ++j) {
    const double v = x_[j] - moved_[j];
    const double share = thresholds::unexplained * std::abs(v) +
                         thresholds::unexplained_roundings * eps * std::abs(moved_[j]);
    for (const int i : places.column(j)) {
      const double value = values[place(k++)];
      sum_[i] += value * v, least_[i] += std::abs(value) * share;
    }
  }
}

bool Jacobian::take(const Own& own, double t, const double* x, const double* xdot,
                    const Increments& by, double* out) {
  const PlanLeaf& leaf = machine_->plan().leaves[own.leaf];
  const ContinuousState& state = leaf.declared().continuous;
  block_.head(own.size).setZero();
  const double* seen = machine_->carries() ? x_.data() : x;
  const At at = machine_->at(own.leaf, t, seen);
  if (state.sparse_jacobian)
    state.sparse_jacobian(*leaf.system, at, VectorRef(block_.data(), own.size));
  else
    state.jacobian(*leaf.system, at, MatrixRef(block_.data(), leaf.nx, leaf.nx));
  if ((distrusted_ || !block_.head(own.size).allFinite()) && !mend(own, t, x, xdot, by))
    return false;
  for (const Copy& copy : own.copies) {
    out[place(copy.entry)] = machine_->resting().rests(copy.row) ? 0.0 : block_[copy.from];
    block_[copy.from] = 0.0;
  }
  if (state.sparsity && !block_.head(own.size).isZero(0.0))
    refuse(own, t, "has values outside the sparsity that it declares; name those entries too");
  return true;
}

/// Replaces entries that are not finite, or all of them, by differences of the leaf alone, because
/// its inputs do not depend on its own states. False if a difference is not finite either.
bool Jacobian::mend(const Own& own, double t, const double* x, const double* xdot,
                    const Increments& by) {
  const PlanLeaf& leaf = machine_->plan().leaves[own.leaf];
  const double least = least_increment(x, xdot, by);
  begin_at(t, x, xdot);
  machine_->evaluate_derivative_needs(t, x_.data());
  ode_of(leaf, t, moved_);
  int column = -1;
  double moved = 0.0;
  for (const Copy& bad : own.copies) {
    const double declared = block_[bad.from];
    if (!distrusted_ && std::isfinite(declared)) continue;
    if (std::exchange(column, bad.column) != bad.column) {
      const double before = x_[column];
      x_[column] += increment(column, before, least, by);
      moved = x_[column] - before;  // the rounded increment
      ode_of(leaf, t, f_);
      x_[column] = before;
    }
    block_[bad.from] = (f_[bad.row] - moved_[bad.row]) / moved;
    if (!std::isfinite(block_[bad.from])) return false;
    note(bad, leaf, t, declared, block_[bad.from]);
  }
  ++mended_;
  return true;
}

/// Keeps the first entry that is not finite, or is not the difference that was found.
void Jacobian::note(const Copy& bad, const PlanLeaf& leaf, double t, double declared,
                    double found) {
  const double size = std::abs(declared) + std::abs(found);
  const bool finite = std::isfinite(declared);
  if (!first_mended_.empty() || (finite && std::abs(declared - found) <= unexplained * size))
    return;
  first_mended_ =
      text("entry (", bad.row - leaf.x, ", ", bad.column - leaf.x, ") of the Jacobian of block '",
           leaf.path, "' was ",
           finite ? text(declared, ", and the difference ", found, ",") : std::string("not finite"),
           " at t = ", t, " s: differences stood in, in ");
}

void Jacobian::ode_of(const PlanLeaf& leaf, double t, Eigen::VectorXd& xdot) {
  const auto number = &leaf - machine_->plan().leaves.data();
  machine_->leaf_derivative(number, t, x_.data(), VectorRef(xdot.data() + leaf.x, leaf.nx));
}

std::string Jacobian::words() const {
  return first_mended_.empty() ? std::string()
                               : text("; ", first_mended_, mended_, " evaluation(s)");
}

void Jacobian::refuse(const Own& own, double t, const char* what) const {
  const std::string& path = machine_->plan().leaves[own.leaf].path;
  throw SimulationError(text("t = ", t, " s: the Jacobian of block '", path, "' ", what), t, path);
}

}  // namespace saltus
