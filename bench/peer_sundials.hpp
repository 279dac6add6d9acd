// A solver of SUNDIALS on a plain problem, as in its manual: the dense or band matrix and solver of
// SUNDIALS, the Jacobian of the problem, defaults otherwise. Here is CVODE's BDF.
#pragma once

#include <sunlinsol/sunlinsol_band.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_band.h>
#include <sunmatrix/sunmatrix_dense.h>

#include "../src/solver/sundials_compat.hpp"
#include "peer.hpp"

namespace bench {

/// The common part of the solvers of SUNDIALS: state, matrix, rows. A derived class makes its
/// memory in its constructor.
class SundialsPeer : public Peer {
 public:
  bool run() final {
    std::copy_n(problem().start.data(), problem().start.size(), data(y_));
    if (!begin()) return false;
    for (std::size_t k = 0; k < rows_.size(); ++k) {
      if (!advance(scene_.answer[k].time)) return false;
      rows_[k] = Eigen::Map<const Eigen::VectorXd>(data(y_), problem().start.size());
    }
    return true;
  }
  double error() final { return error_of(scene_, rows_); }
  /// The states of the last run at the times of the answer.
  const std::vector<Eigen::VectorXd>& rows() const { return rows_; }

 protected:
  static constexpr long most_steps = 1'000'000;  // from one row to the next

  explicit SundialsPeer(const StiffScene& scene)
      : scene_(scene),
        context_(saltus::sun::make_context()),
        y_(N_VNew_Serial(scene.problem.start.size(), context_.get())),
        rows_(scene.answer.size()) {
    const auto n = static_cast<sunindextype>(problem().start.size());
    if (problem().band < 0) {
      matrix_.reset(SUNDenseMatrix(n, n, context_.get()));
      linear_.reset(SUNLinSol_Dense(y_.get(), matrix_.get(), context_.get()));
    } else {
      matrix_.reset(SUNBandMatrix(n, problem().band, problem().band, context_.get()));
      linear_.reset(SUNLinSol_Band(y_.get(), matrix_.get(), context_.get()));
    }
    std::copy_n(problem().start.data(), n, data(y_));
  }

  virtual bool begin() = 0;
  virtual bool advance(double t) = 0;

  static double* data(const saltus::sun::Vector& v) { return N_VGetArrayPointer(v.get()); }
  const StiffProblem& problem() const { return scene_.problem; }
  double end() const { return problem().t_end; }
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

  StiffScene scene_;
  saltus::sun::Context context_;
  saltus::sun::Vector y_;
  saltus::sun::Matrix matrix_;
  saltus::sun::Linear linear_;
  std::vector<Eigen::VectorXd> rows_;
};

/// Rows between the ends of steps are CVODE's own interpolation, which has the order of the step.
class CvodePeer final : public SundialsPeer {
 public:
  CvodePeer(const StiffScene& scene, double rtol)
      : SundialsPeer(scene), cvode_(CVodeCreate(CV_BDF, context_.get())) {
    CVodeInit(cvode_.get(), rate, 0.0, y_.get());
    CVodeSStolerances(cvode_.get(), rtol, rtol * scene.scale);
    CVodeSetUserData(cvode_.get(), &scene_.problem);
    CVodeSetMaxNumSteps(cvode_.get(), most_steps);
    CVodeSetMaxHnilWarns(cvode_.get(), -1);  // they are printed
    CVodeSetLinearSolver(cvode_.get(), linear_.get(), matrix_.get());
    if (problem().jacobian != nullptr) CVodeSetJacFn(cvode_.get(), jacobian);
  }
  Counts counts() const override {
    Counts c;
    long differences = 0;
    CVodeGetNumSteps(cvode_.get(), &c.steps);
    CVodeGetNumRhsEvals(cvode_.get(), &c.calls);
    CVodeGetNumLinRhsEvals(cvode_.get(), &differences);
    CVodeGetNumJacEvals(cvode_.get(), &c.jacobians);
    CVodeGetNumLinSolvSetups(cvode_.get(), &c.factorisations);
    c.calls += differences;
    return c;
  }

 private:
  bool begin() override {
    return CVodeReInit(cvode_.get(), 0.0, y_.get()) == 0 &&
           CVodeSetStopTime(cvode_.get(), end()) == 0;
  }
  bool advance(double t) override {
    double reached = 0.0;
    return CVode(cvode_.get(), t, y_.get(), &reached, CV_NORMAL) >= 0;
  }

  saltus::sun::Cvode cvode_;
};

}  // namespace bench
