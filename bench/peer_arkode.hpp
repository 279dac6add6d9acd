// ARKODE's diagonally implicit Runge-Kutta methods, by the name of their table. With the
// defaults of ARKODE they are up to a hundred times slower on these scenes, or give up. Some ten
// combinations of settings were tried, and the best is used here: stage derivatives from the
// stages, Newton's iteration to a thousandth of the tolerance, a new Jacobian for each step.
#pragma once

#include <arkode/arkode_arkstep.h>

#include "peer_sundials.hpp"

/// Hooks of SUNDIALS's Python layer, which are not there; see src/solver/sundials_hooks.c.
extern "C" [[gnu::weak]] void arkode_user_supplied_fn_table_destroy(void*) {}
extern "C" [[gnu::weak]] void mristepinnerstepper_user_supplied_fn_table_destroy(void*) {}

namespace bench {

struct FreeArkode {
  void operator()(void* memory) const { ARKodeFree(&memory); }
};

/// It steps onto each row, because its interpolation may have a lower order than its steps.
class ArkodePeer final : public SundialsPeer {
 public:
  ArkodePeer(const StiffScene& scene, const std::string& table, double rtol)
      : SundialsPeer(scene), arkode_(ARKStepCreate(nullptr, rate, 0.0, y_.get(), context_.get())) {
    ARKStepSetTableName(arkode_.get(), ("ARKODE_" + table).c_str(), "ARKODE_ERK_NONE");
    ARKodeSStolerances(arkode_.get(), rtol, rtol * scene.scale);
    ARKodeSetUserData(arkode_.get(), &scene_.problem);
    ARKodeSetMaxNumSteps(arkode_.get(), most_steps);
    ARKodeSetMaxHnilWarns(arkode_.get(), -1);
    ARKodeSetLinearSolver(arkode_.get(), linear_.get(), matrix_.get());
    if (problem().jacobian != nullptr) ARKodeSetJacFn(arkode_.get(), jacobian);
    set_best();
  }
  Counts counts() const override {
    Counts c;
    long differences = 0;
    ARKodeGetNumSteps(arkode_.get(), &c.steps);
    ARKodeGetNumRhsEvals(arkode_.get(), 1, &c.calls);
    ARKodeGetNumLinRhsEvals(arkode_.get(), &differences);
    ARKodeGetNumJacEvals(arkode_.get(), &c.jacobians);
    ARKodeGetNumLinSolvSetups(arkode_.get(), &c.factorisations);
    c.calls += differences;
    return c;
  }

 private:
  void set_best() {
    void* a = arkode_.get();
    const int refused = ARKodeSetDeduceImplicitRhs(a, 1) | ARKodeSetNonlinConvCoef(a, 1e-3) |
                        ARKodeSetMaxNonlinIters(a, 10) | ARKodeSetMaxErrTestFails(a, 50) |
                        ARKodeSetJacEvalFrequency(a, 1) | ARKodeSetLSetupFrequency(a, 1);
    if (refused != 0) throw saltus::Error("ARKODE refused a setting");
  }
  bool begin() override { return ARKStepReInit(arkode_.get(), nullptr, rate, 0.0, y_.get()) == 0; }
  bool advance(double t) override {
    double reached = 0.0;
    ARKodeSetStopTime(arkode_.get(), t);
    return ARKodeEvolve(arkode_.get(), t, y_.get(), &reached, ARK_NORMAL) >= 0;
  }

  std::unique_ptr<void, FreeArkode> arkode_;
};

}  // namespace bench
