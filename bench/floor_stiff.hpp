// Floor for bdf: a loop over CVODE as in its manual, with the same linked library: BDF, SUNDIALS's
// own dense or band matrix and solver, the user's Jacobian or CVODE's own differences, no guard.
#pragma once

#include <sunlinsol/sunlinsol_band.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_band.h>
#include <sunmatrix/sunmatrix_dense.h>

#include "../src/solver/sundials_compat.hpp"
#include "saltus/saltus.hpp"

namespace bench {

/// x' = f(t, x), written by hand.
struct StiffProblem {
  const char* name;
  Eigen::VectorXd start;
  double t_end;
  void (*f)(double t, const double* x, double* xdot, long n);
  void (*jacobian)(double t, const double* x, double* j) = nullptr;  ///< dense, by columns
  long band = -1;                                                    ///< of it; -1: dense
};

class FloorStiff {
 public:
  FloorStiff(const StiffProblem& problem, double rtol, double atol)
      : problem_(problem),
        context_(saltus::sun::make_context()),
        y_(N_VNew_Serial(problem.start.size(), context_.get())),
        cvode_(CVodeCreate(CV_BDF, context_.get())) {
    const auto n = static_cast<sunindextype>(problem.start.size());
    put();
    CVodeInit(cvode_.get(), rate, 0.0, y_.get());
    CVodeSStolerances(cvode_.get(), rtol, atol);
    CVodeSetUserData(cvode_.get(), &problem_);
    CVodeSetMaxNumSteps(cvode_.get(), 1000000);
    if (problem.band < 0) {
      matrix_.reset(SUNDenseMatrix(n, n, context_.get()));
      linear_.reset(SUNLinSol_Dense(y_.get(), matrix_.get(), context_.get()));
    } else {
      matrix_.reset(SUNBandMatrix(n, problem.band, problem.band, context_.get()));
      linear_.reset(SUNLinSol_Band(y_.get(), matrix_.get(), context_.get()));
    }
    CVodeSetLinearSolver(cvode_.get(), linear_.get(), matrix_.get());
    if (problem.jacobian != nullptr) CVodeSetJacFn(cvode_.get(), jacobian);
  }

  void operator()() {
    double t = 0.0;
    put();
    CVodeReInit(cvode_.get(), 0.0, y_.get());
    CVodeSetStopTime(cvode_.get(), problem_.t_end);
    CVode(cvode_.get(), problem_.t_end, y_.get(), &t, CV_NORMAL);
  }

  long steps() const {
    long steps = 0;
    CVodeGetNumSteps(cvode_.get(), &steps);
    return steps;
  }
  long calls() const {
    long rates = 0, differences = 0;
    CVodeGetNumRhsEvals(cvode_.get(), &rates);
    CVodeGetNumLinRhsEvals(cvode_.get(), &differences);
    return rates + differences;
  }
  Eigen::VectorXd state() const {
    return Eigen::Map<const Eigen::VectorXd>(N_VGetArrayPointer(y_.get()), problem_.start.size());
  }

 private:
  static int rate(double t, N_Vector x, N_Vector xdot, void* user) {
    static_cast<const StiffProblem*>(user)->f(t, N_VGetArrayPointer(x), N_VGetArrayPointer(xdot),
                                              static_cast<long>(N_VGetLength(x)));
    return 0;
  }
  static int jacobian(double t, N_Vector x, N_Vector, SUNMatrix out, void* user, N_Vector, N_Vector,
                      N_Vector) {
    static_cast<const StiffProblem*>(user)->jacobian(t, N_VGetArrayPointer(x),
                                                     SUNDenseMatrix_Data(out));
    return 0;
  }
  void put() {
    std::copy_n(problem_.start.data(), problem_.start.size(), N_VGetArrayPointer(y_.get()));
  }

  StiffProblem problem_;
  saltus::sun::Context context_;
  saltus::sun::Vector y_;
  saltus::sun::Matrix matrix_;
  saltus::sun::Linear linear_;
  saltus::sun::Cvode cvode_;
};

/// The same problem as a leaf: a band is declared as the sparsity, the Jacobian directly.
class StiffLeaf final : public saltus::LeafSystem {
 public:
  explicit StiffLeaf(const StiffProblem& problem) : LeafSystem(problem.name) {
    using saltus::At, saltus::VectorRef, saltus::MatrixRef;
    const auto n = problem.start.size();
    declare_continuous_state(
        {.initial = problem.start, .ode = [f = problem.f, n](const At& at, VectorRef xdot) {
           f(at.time, at.x.data(), xdot.data(), static_cast<long>(n));
         }});
    declare_continuous_state_output("y");
    if (problem.jacobian != nullptr)
      declare_jacobian([j = problem.jacobian](const At& at, MatrixRef out) {
        j(at.time, at.x.data(), out.data());
      });
    if (problem.band >= 0)
      declare_jacobian_sparsity(saltus::band_entries(n, problem.band, problem.band));
  }
};

}  // namespace bench
