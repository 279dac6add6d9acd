// The parts of the linear systems of a stiff method: the Jacobian, the choice of a solver, and
// the layout of its matrices.
#pragma once

#include <optional>
#include <string>

#include "choice.hpp"
#include "factorisation.hpp"
#include "saltus/solver/detail/probe.hpp"
#include "saltus/solver/detail/solver.hpp"

namespace saltus {

/// Each run has its own. It is built anew when the probe has missed places of the Jacobian.
class LinearStructure {
 public:
  /// The structure of a run that starts at (t, x). Throws ModelError for an impossible sparsity.
  LinearStructure(Machine& machine, const SolverOptions& options, double t, const double* x);

  Jacobian& jacobian() { return *jacobian_; }
  const JacobianPattern& pattern() const { return jacobian_->pattern(); }
  const LinearChoice& choice() const { return choice_; }
  bool direct() const { return choice_.solver != LinearSolver::gmres; }
  /// The layout of a matrix, if the solver is direct.
  const MatrixLayout& layout() const { return layout_; }
  /// A direct solver for matrices of this layout.
  template <class T>
  std::unique_ptr<FactorisationOf<T>> make_factorisation() const;

  /// How the differences for a Jacobian of a step of length h are made.
  Increments increments(double h) const;
  /// Whether the probe found new places: those found near one state may be too few near another. A
  /// false alarm, by a kink or by rounding, doubles the time to the next look. `values` are those
  /// of the Jacobian at (t, x).
  bool misses_places(double t, const double* x, const double* xdot, const Increments& by,
                     const double* values);
  /// Builds the structure with the new places. If Newton's iteration did not converge with what was
  /// found, the search is given up. False if there is nothing new.
  bool renew(bool did_not_converge);

  /// The solver and the reason, in words. The text is made again only if it has changed.
  const std::string& describe() const;

 private:
  void build();
  void lay_out();

  Machine* machine_;
  SolverOptions options_;
  Probe probe_;
  bool news_ = false;  // the probe has found places that are not built in yet
  int renewals_ = 0;
  int wait_ = 1, until_check_ = 1;  // Jacobians between two checks of the probe's places
  std::optional<Jacobian> jacobian_;
  LinearChoice choice_;
  MatrixLayout layout_;
  mutable std::string words_;
  mutable int mended_in_words_ = 0;  // mended Jacobians that words_ speaks of
};

}  // namespace saltus
