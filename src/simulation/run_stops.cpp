// RunLoop: a root that is apart from a time event by rounding alone.
#include "saltus/simulation/detail/run_loop.hpp"

namespace saltus {

/// A root that is at the next time event but for rounding belongs to its instant.
void RunLoop::finish_at_event(double from, double t_end) {
  const double event = calendar_.stop_at_root(from, time_);
  if (event == time_) return;
  struct Kept {
    explicit Kept(Eigen::VectorXd& of) : x(of), values(of) {}
    ~Kept() { x = values; }
    Eigen::VectorXd &x, values;
  };
  const Kept kept(machine_.x);
  machine_.x = integration_.at(time_);
  if (!instant_.stops().roots_are_at(event, time_, t_end - event)) return;
  time_ = event;
  if (integration_.finish_step(event)) return;
  guards_.beside_stop = guards_.active().all;  // the state is that at the root
  behind_event_ = true;
}

}  // namespace saltus
