// IDA on F(t, y, y') = y' - f(t, y) = 0.
#pragma once

#include <idas/idas.h>

#include "peer_sundials.hpp"

/// A hook of SUNDIALS's Python layer, which is not there; see src/solver/sundials_hooks.c.
extern "C" [[gnu::weak]] void idas_user_supplied_fn_table_destroy(void*) {}

namespace bench {

struct FreeIda {
  void operator()(void* memory) const { IDAFree(&memory); }
};

class IdaPeer final : public SundialsPeer {
 public:
  IdaPeer(const StiffScene& scene, double rtol)
      : SundialsPeer(scene), slope_(N_VClone(y_.get())), ida_(IDACreate(context_.get())) {
    rate(0.0, y_.get(), slope_.get(), &scene_.problem);
    IDAInit(ida_.get(), residual, 0.0, y_.get(), slope_.get());
    IDASStolerances(ida_.get(), rtol, rtol * scene.scale);
    IDASetUserData(ida_.get(), &scene_.problem);
    IDASetMaxNumSteps(ida_.get(), most_steps);
    IDASetLinearSolver(ida_.get(), linear_.get(), matrix_.get());
    if (problem().jacobian != nullptr) IDASetJacFn(ida_.get(), of_residual);
  }
  Counts counts() const override {
    Counts c;
    long differences = 0;
    IDAGetNumSteps(ida_.get(), &c.steps);
    IDAGetNumResEvals(ida_.get(), &c.calls);
    IDAGetNumLinResEvals(ida_.get(), &differences);
    IDAGetNumJacEvals(ida_.get(), &c.jacobians);
    IDAGetNumLinSolvSetups(ida_.get(), &c.factorisations);
    c.calls += differences;
    return c;
  }

 private:
  bool begin() override {
    rate(0.0, y_.get(), slope_.get(), &scene_.problem);
    return IDAReInit(ida_.get(), 0.0, y_.get(), slope_.get()) == 0 &&
           IDASetStopTime(ida_.get(), end()) == 0;
  }
  bool advance(double t) override {
    double reached = 0.0;
    return IDASolve(ida_.get(), t, &reached, y_.get(), slope_.get(), IDA_NORMAL) >= 0;
  }
  static int residual(double t, N_Vector y, N_Vector slope, N_Vector out, void* user) {
    rate(t, y, out, user);
    N_VLinearSum(1.0, slope, -1.0, out, out);
    return 0;
  }
  /// cj I - J.
  static int of_residual(double t, double cj, N_Vector y, N_Vector, N_Vector, SUNMatrix out,
                         void* user, N_Vector a, N_Vector b, N_Vector c) {
    jacobian(t, y, nullptr, out, user, a, b, c);
    SUNMatScaleAddI(-1.0, out);
    const auto n = SUNDenseMatrix_Columns(out);
    for (sunindextype i = 0; i < n; ++i) SUNDenseMatrix_Data(out)[i * n + i] += cj - 1.0;
    return 0;
  }

  saltus::sun::Vector slope_;
  std::unique_ptr<void, FreeIda> ida_;
};

}  // namespace bench
