// The stiff methods of a run of "auto": made when they are first needed.
#pragma once

#include <memory>

#include "saltus/solver/detail/cvode.hpp"
#include "saltus/solver/detail/radau.hpp"
#include "saltus/solver/detail/stiff_choice.hpp"

namespace saltus {

/// See choose_stiff_method.
class StiffMethods {
 public:
  StiffMethods(Machine& machine, GuardSet& guards, const SolverOptions& options)
      : machine_(&machine), guards_(&guards), options_(options) {}

  void begin_run() {
    radau_.reset(), bdf_.reset();
    cost_known_ = false, brief_ = 0;
    scene_ = {.states = static_cast<double>(machine_->plan().nx), .rtol = options_.rtol};
  }

  /// The method for a scene at (t, x), and in `why` the reason; null if none suits.
  Solver* choose(double t, const Eigen::VectorXd& x, bool hardly_damped, const char*& why) {
    scene_.hardly_damped = hardly_damped;
    const auto cost = [&] {
      if (!cost_known_) cost_ = matrix_cost(*machine_, options_, t, x), cost_known_ = true;
      return cost_;
    };
    const StiffChoice choice = choose_stiff_method(scene_, cost);
    why = choice.why, brief_ = 0;
    return choice.method == StiffMethod::none ? nullptr : made(choice.method == StiffMethod::radau);
  }

  /// An event has ended a stretch of BDF after so many steps. BDF begins each stretch with order 1:
  /// if its stretches end before the order has risen, events count as frequent. True if they do
  /// from now on.
  bool count_event(int steps) {
    if (steps == 0) return false;
    brief_ = steps < thresholds::brief_stretch ? brief_ + 1 : 0;
    if (brief_ < thresholds::brief_stretches || scene_.many_events) return false;
    return scene_.many_events = true;
  }

  /// Radau could not factorise its matrices.
  void refuse_radau() { cost_ = {.direct = false}, cost_known_ = true; }

  const Solver* radau() const { return radau_.get(); }
  const Solver* bdf() const { return bdf_.get(); }

 private:
  Solver* made(bool radau) {
    auto& method = radau ? radau_ : bdf_;
    if (!method)
      method = radau ? make_radau(*machine_, *guards_, options_)
                     : make_cvode(*machine_, *guards_, options_, CvodeMethod::bdf);
    return method.get();
  }

  Machine* machine_;
  GuardSet* guards_;
  SolverOptions options_;
  std::unique_ptr<Solver> radau_, bdf_;
  StiffScene scene_;
  MatrixCost cost_;
  bool cost_known_ = false;
  int brief_ = 0;  // stretches of BDF in a row that events ended soon
};

}  // namespace saltus
