// RunLoop: what is kept of a step.
#include <utility>

#include "saltus/simulation/detail/run_loop.hpp"

namespace saltus {

/// The step from `from` to time_ is accepted: its rows, monitors and histories are kept.
void RunLoop::accept(double from) {
  accepted_.settled = false;
  accepted_.place = integration_.started() ? Place::solver : Place::machine;
  if (options_.dense_output) keep_step(from);
  if (tangents_) tangents_->step(from, time_, integration_);
  if (!guards_.monitors.empty()) log_monitors();
  rows_.record_step(from, time_, instant_.jump(), integration_);
  if (histories_.any()) keep_histories(from);
}

/// The trajectory needs the histories with which the next step begins.
void RunLoop::keep_histories(double from) {
  histories_.add(from, time_, integration_);
  results_.trajectory.instant();
}

/// Logs the monitors that crossed inside the last step.
void RunLoop::log_monitors() {
  for (const MonitorHit& hit : guards_.monitors) {
    if (instant_.monitors().judges(hit, time_, guards_.fired_at_root)) continue;
    Eigen::VectorXd& x = integration_.at(hit.t);
    machine_.put_carried(hit.t, x.data());
    instant_.monitors().log(hit, x.data());
  }
}

/// Keeps the one or two polynomials of the step from `from` to now for dense output.
void RunLoop::keep_step(double from) {
  if (!integration_.started())
    return results_.trajectory.add(from, time_, 0, machine_, instant_.contacts(), machine_.x,
                                   [](double, double*) {});
  const auto add = [&](double begin, double end, const Eigen::VectorXd& x_end) {
    results_.trajectory.add(begin, end, integration_.degree(), machine_, instant_.contacts(), x_end,
                            [this](double t, double* x) { integration_.interpolate(t, x); });
  };
  const double joint = integration_.joint(from);
  if (from < joint && joint < time_) {
    const Eigen::VectorXd& middle = integration_.at(joint);
    add(from, joint, middle);
    results_.trajectory.depart(middle);
    from = joint;
  }
  add(from, time_, integration_.state());
}

/// The step is taken back: the run ends at its begin, the last state before the pole.
void RunLoop::fail_at_pole(double from) {
  const double to = std::exchange(time_, from);
  machine_.x = endings_.departed_from();
  accepted_.place = Place::machine;
  throw endings_.pole_error(from, to);
}

}  // namespace saltus
