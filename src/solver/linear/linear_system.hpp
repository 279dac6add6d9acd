// What BDF needs for its Newton iteration: a Jacobian, a matrix and a linear solver, as the scene
// asks for them.
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
  /// For a run that starts at (t, x). What is thrown inside SUNDIALS is kept in `error`. Throws
  /// ModelError for a sparsity that cannot be.
  LinearSystem(Machine& machine, const SolverOptions& options, std::exception_ptr& error, double t,
               const double* x);

  /// Functions that are to call ours.
  struct Callbacks {
    CVLsJacFn jacobian;
    CVLsPrecSetupFn prepare;
    CVLsPrecSolveFn precondition;
  };
  /// Gives CVODE its linear solver.
  void attach(void* cvode, N_Vector y, SUNContext context, const Callbacks& callbacks);

  /// After a step that failed with this flag of CVODE: whether the system is another one now, to
  /// be attached anew, since places it had been told by calls were not all there are.
  bool renew(int flag);

  // What CVODE calls: 0 well, 1 try a shorter step, -1 renew.
  int jacobian(double t, N_Vector x, N_Vector xdot, SUNMatrix out);
  int prepare(double t, N_Vector x, N_Vector xdot, bool keep, bool& renewed, double gamma);
  int precondition(N_Vector r, N_Vector z);

  /// Which solver and why, in words; put together again only where that has changed.
  const std::string& describe() const;

 private:
  static constexpr Index small = 16;  // states: see refresh_often
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
  bool news_ = false;  // of the probe, not yet built in
  int renewals_ = 0;
  int wait_ = 1, until_check_ = 1;  // Jacobians from one look at the probe's places to the next
  std::optional<Jacobian> jacobian_;
  LinearChoice choice_;
  mutable std::string words_;
  mutable int told_ = 0;  // evaluations of Jacobians that were mended, as words_ has it
  MatrixLayout layout_;
  std::unique_ptr<Factorisation> factorisation_;
  std::optional<Preconditioner> preconditioner_;
  sun::Matrix matrix_;
  sun::Linear linear_;
};

}  // namespace saltus
