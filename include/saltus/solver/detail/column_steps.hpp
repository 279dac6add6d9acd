// ColumnSteps: a linear equation of columns through the stages of an explicit step.
#pragma once

#include <memory>

#include "saltus/base/view.hpp"

namespace saltus {

class ColumnSteps;

/// The last step of an explicit method, from t0 to t1, with all that it has computed. Column i of `k`,
/// the derivative of stage i, begins at k[i n]. The pointers last until the next step.
struct StepStages {
  /// Makes what carries columns through these stages: n states, m columns. Null: there are no stages.
  std::unique_ptr<ColumnSteps> (*make)(Index n, Index m) = nullptr;
  double t0 = 0.0, t1 = 0.0, h = 0.0;  // [s]
  const double *x0 = nullptr, *x1 = nullptr, *k = nullptr;
  bool dense = false;  // `k` has the stages that only the dense output reads

  explicit operator bool() const noexcept { return make != nullptr; }
};

/// The right-hand side of S' = A(t, x) S + b(t, x). S has n rows of m columns, row by row.
class ColumnRate {
 public:
  virtual ~ColumnRate() = default;
  /// Evaluates A and b at (t, x).
  virtual void go_to(double t, const double* x) = 0;
  /// S' where it has gone to.
  virtual void apply(const double* s, double* ds) const = 0;
};

/// The tangent of the steps of an explicit method, with their sizes frozen: the derivative of the
/// discrete step itself (H. G. Bock's internal differentiation; P. Eberhard, C. Bischof, "Automatic
/// differentiation of numerical integration algorithms", Math. Comp. 68 (1999) 717). Stage i has
/// dY_i = S + h sum_j a_ij dk_j and dk_i = A(t_i, Y_i) dY_i + b(t_i, Y_i). Y_i follows from the k of
/// the step, so f is not called.
class ColumnSteps {
 public:
  virtual ~ColumnSteps() = default;
  /// Goes from s0 to s1. `continues`: s0 is the end of the last step, at the begin of this one.
  virtual void step(const StepStages& step, ColumnRate& rate, const double* s0, double* s1,
                    bool continues) = 0;
  /// What counts as an error of one, in entry i: atol_i + rtol max(|s0_i|, |s1_i|).
  struct Tolerances {
    double rtol;
    const double* atol;
  };
  /// The error estimate of the method for the states [tolerances].
  virtual double state_error(const StepStages& step, const Tolerances& tolerances) = 0;
  /// The largest of those of the columns, infinite if an entry is not finite. A column that was not
  /// finite at the begin does not count.
  virtual double error(const StepStages& step, const Tolerances& tolerances, const double* s0,
                       const double* s1) = 0;
  /// Prepares `read`. `step.k` has the stages of the dense output too.
  virtual void prepare_dense(const StepStages& step, ColumnRate& rate, const double* s0,
                             const double* s1) = 0;
  /// S at the part `part` of the step: the tangent of the dense output.
  virtual void read(double part, const double* s0, double* s) const = 0;
  /// The degree of that polynomial.
  virtual int degree() const = 0;
};

/// Those of a method; instances for Dopri5 and Dop853.
template <class Method>
std::unique_ptr<ColumnSteps> make_column_steps(Index n, Index m);

}  // namespace saltus
