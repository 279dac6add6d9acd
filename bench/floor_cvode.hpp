// Floor for adams: a loop over CVODE as in its manual, with the same linked library. Adams with
// fixed-point iteration, CVODE's own root-finding on the falling guard, one ReInit for each bounce.
#pragma once

#include "../src/solver/sundials_compat.hpp"
#include "ball.hpp"

namespace bench {

class FloorCvode {
 public:
  FloorCvode(const Ball& ball, double rtol, double atol)
      : ball_(ball),
        context_(saltus::sun::make_context()),
        y_(N_VNew_Serial(2, context_.get())),
        cvode_(CVodeCreate(CV_ADAMS, context_.get())),
        nonlinear_(SUNNonlinSol_FixedPoint(y_.get(), 0, context_.get())) {
    put({ball_.y0, 0.0});
    CVodeInit(cvode_.get(), rate, 0.0, y_.get());
    CVodeSStolerances(cvode_.get(), rtol, atol);
    CVodeSetUserData(cvode_.get(), &ball_);
    CVodeSetMaxNumSteps(cvode_.get(), 1000000);
    CVodeSetNonlinearSolver(cvode_.get(), nonlinear_.get());
    CVodeRootInit(cvode_.get(), 1, height);
    int falling = -1;
    CVodeSetRootDirection(cvode_.get(), &falling);
    CVodeSetNoInactiveRootWarn(cvode_.get());
  }

  void operator()() {
    out_ = {};
    double t = 0.0;
    put({ball_.y0, 0.0});
    CVodeReInit(cvode_.get(), 0.0, y_.get());
    while (CVode(cvode_.get(), ball_.t_end, y_.get(), &t, CV_NORMAL) == CV_ROOT_RETURN) {
      out_.bounced(t);
      count();
      put({std::abs(x()[0]), -ball_.e * x()[1]});
      CVodeReInit(cvode_.get(), t, y_.get());
    }
    count();
    out_.y = x()[0], out_.v = x()[1];
  }

  const Outcome& outcome() const { return out_; }

 private:
  static int rate(double, N_Vector x, N_Vector xdot, void* user) {
    static_cast<const Ball*>(user)->derivative(N_VGetArrayPointer(x), N_VGetArrayPointer(xdot));
    return 0;
  }
  static int height(double, N_Vector x, double* g, void*) {
    g[0] = N_VGetArrayPointer(x)[0];
    return 0;
  }
  double* x() { return N_VGetArrayPointer(y_.get()); }
  void put(const std::array<double, 2>& values) { std::copy(values.begin(), values.end(), x()); }

  /// ReInit sets the counts to zero.
  void count() {
    long steps = 0, calls = 0, guards = 0;
    CVodeGetNumSteps(cvode_.get(), &steps);
    CVodeGetNumRhsEvals(cvode_.get(), &calls);
    CVodeGetNumGEvals(cvode_.get(), &guards);
    out_.steps += steps, out_.right_hand_side_calls += calls, out_.guard_calls += guards;
  }

  Ball ball_;
  saltus::sun::Context context_;
  saltus::sun::Vector y_;
  saltus::sun::Cvode cvode_;
  saltus::sun::Nonlinear nonlinear_;
  Outcome out_;
};

}  // namespace bench
