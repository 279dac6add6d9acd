// y(t) = u(t - delay), and initial_output before.
#include "saltus/library/transport_delay.hpp"

#include "saltus/library/detail/past.hpp"

namespace saltus {

TransportDelay::TransportDelay(std::string name, double delay, const Options& options)
    : LeafSystem(std::move(name)), delay_(delay), n_(options.initial_output.values.size()) {
  detail::require_period(this->name(), "delay", delay);
  detail::require_count(this->name(), "pieces of capacity", options.capacity, 4);
  const Value& initial = options.initial_output;
  initial_ = declare_dynamic_parameter("initial_output", initial.values);
  declare_discrete_state(Eigen::VectorXd::Zero(detail::Past::size(n_, options.capacity)));
  declare_input_port({.name = "in", .shape = initial.shape()});
  declare_output_port({.name = "out",
                       .calc = &TransportDelay::delayed,
                       .shape = initial.shape(),
                       .reads = Reads::time | Reads::discrete_state});
  const auto append = [block = this->name(), delay, n = n_](const AcceptedStep& step, VectorRef z) {
    detail::PastWriter(z, n).append(step, step.from - delay, block);
  };
  declare_history({.input = 0, .append = append, .longest_step = delay});
  declare_time_event({.name = "break",
                      .update = &TransportDelay::pass_break,
                      .inputs = std::vector<int>{},
                      .next = [delay, n = n_](const VectorView& z) {
                        return detail::Past(z, n).next_break() + delay;
                      }});
}

void TransportDelay::delayed(const At& at, VectorRef out) const {
  const detail::Past past(at.z, n_);
  if (past.none_open())
    out = at.parameter(initial_);
  else
    past.value(at.time - delay_, out);
}

/// Opens at least the break that is due, and all breaks that are due within rounding of it.
void TransportDelay::pass_break(const At& at, Next& next) const {
  Eigen::VectorXd z = at.z;
  detail::PastWriter past(VectorRef(z.data(), z.size()), n_);
  const double now = at.time + 4.0 * std::numeric_limits<double>::epsilon() * std::abs(at.time);
  do {
    past.open_next();
  } while (past.next_break() + delay_ <= now);
  next.set_discrete_state(z);
}

}  // namespace saltus
