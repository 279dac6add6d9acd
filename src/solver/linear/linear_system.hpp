// What BDF needs for its Newton iteration: a Jacobian, a matrix and a linear solver, as the scene
// asks for them.
#pragma once

#include <optional>

#include "choice.hpp"
#include "direct.hpp"
#include "krylov.hpp"
#include "saltus/solver/solver.hpp"

namespace saltus {

class LinearSystem {
 public:
  /// What is thrown inside SUNDIALS is kept in `error`. Throws ModelError for a sparsity that
  /// cannot be.
  LinearSystem(Machine& machine, const SolverOptions& options, std::exception_ptr& error);

  /// Functions that are to call ours.
  struct Callbacks {
    CVLsJacFn jacobian;
    CVLsPrecSetupFn prepare;
    CVLsPrecSolveFn precondition;
  };
  /// Gives CVODE its linear solver.
  void attach(void* cvode, N_Vector y, SUNContext context, const Callbacks& callbacks);

  // What CVODE calls: 0 well, 1 try a shorter step.
  int jacobian(double t, N_Vector x, N_Vector xdot, SUNMatrix out);
  int prepare(double t, N_Vector x, N_Vector xdot, bool keep, bool& renewed, double gamma);
  int precondition(N_Vector r, N_Vector z);

  /// Which solver and why, in words.
  const std::string& describe() const { return words_; }

 private:
  static constexpr Index small = 16;  // states: see refresh_often
  void make_factorisation();
  void refresh_often();
  Increments increments() const;

  Machine* machine_;
  SolverOptions options_;
  std::exception_ptr* error_;
  void* cvode_ = nullptr;
  Jacobian jacobian_;
  LinearChoice choice_;
  std::string words_;
  MatrixLayout layout_;
  std::unique_ptr<Factorisation> factorisation_;
  std::optional<Preconditioner> preconditioner_;
  sun::Matrix matrix_;
  sun::Linear linear_;
};

}  // namespace saltus
