// The linear system of BDF's Newton iteration: a Jacobian, a matrix and a linear solver that suit
// the scene.
#pragma once

#include <optional>

#include "direct.hpp"
#include "krylov.hpp"
#include "structure.hpp"

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
  const std::string& describe() const { return structure_.describe(); }

 private:
  void build();
  void refresh_often();
  Increments increments() const;

  Index n_;
  std::exception_ptr* error_;
  void* cvode_ = nullptr;
  LinearStructure structure_;
  std::unique_ptr<Factorisation> factorisation_;
  std::optional<Preconditioner> preconditioner_;
  sun::Matrix matrix_;
  sun::Linear linear_;
};

}  // namespace saltus
