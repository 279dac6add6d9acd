// The linear system of BDF's Newton iteration: a Jacobian, a matrix and a linear solver that suit
// the scene.
#pragma once

#include <optional>

#include "choice.hpp"
#include "direct.hpp"
#include "krylov.hpp"
#include "saltus/solver/detail/probe.hpp"
#include "saltus/solver/detail/solver.hpp"

namespace saltus {

class LinearSystem {
 public:
  /// The system of a run that starts at (t, x). Exceptions inside SUNDIALS are kept in `error`.
  /// Throws ModelError for an impossible sparsity.
  LinearSystem(Machine& machine, const SolverOptions& options, std::exception_ptr& error, double t,
               const double* x);

  /// C functions that have to call the members of this class.
  struct Callbacks {
    CVLsJacFn jacobian;
    CVLsPrecSetupFn prepare;
    CVLsPrecSolveFn precondition;
  };
  /// Gives CVODE its linear solver.
  void attach(void* cvode, N_Vector y, SUNContext context, const Callbacks& callbacks);

  /// Handles a step that failed with this flag of CVODE. True if the system was built anew, because
  /// the probe had missed places; then it has to be attached again.
  bool renew(int flag);

  // CVODE calls these. They return 0 for success, 1 for a shorter step, -1 to renew the system.
  int jacobian(double t, N_Vector x, N_Vector xdot, SUNMatrix out);
  int prepare(double t, N_Vector x, N_Vector xdot, bool keep, bool& renewed, double gamma);
  int precondition(N_Vector r, N_Vector z);

  /// The solver and the reason, in words. The text is made again only if it has changed.
  const std::string& describe() const;

 private:
  void build();
  void make_factorisation();
  void refresh_often();
  bool doubtful(double t, const double* x, const double* xdot, const double* values);
  Increments increments() const;

  Machine* machine_;
  SolverOptions options_;
  std::exception_ptr* error_;
  void* cvode_ = nullptr;
  Probe probe_;
  bool news_ = false;  // the probe has found places that are not built in yet
  int renewals_ = 0;
  int wait_ = 1, until_check_ = 1;  // Jacobians between two checks of the probe's places
  std::optional<Jacobian> jacobian_;
  LinearChoice choice_;
  mutable std::string words_;
  mutable int told_ = 0;  // count of mended Jacobians in words_
  MatrixLayout layout_;
  std::unique_ptr<Factorisation> factorisation_;
  std::optional<Preconditioner> preconditioner_;
  sun::Matrix matrix_;
  sun::Linear linear_;
};

}  // namespace saltus
