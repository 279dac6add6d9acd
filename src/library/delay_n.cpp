// y[k] = u[k-n], and initial_state for k < n; held from tick k, at t = k dt, to the next tick.
#include "saltus/library/delay_n.hpp"

namespace saltus {

DelayN::DelayN(std::string name, double dt, int n, const Options& options)
    : SampledSystem(std::move(name)) {
  detail::require_count(this->name(), "ticks of delay", n, 1);
  const Value& initial = options.initial_state;
  const Index width = initial.values.size();
  declare_input_port({.name = "in", .shape = initial.shape()});
  declare_law({.dt = dt,
               .may_inherit = true,
               .before = initial,
               .state = initial.values.replicate(n, 1),  // u[k-n], ..., u[k-1]
               .output = [=](const At&, const VectorView& s, VectorRef y) { y = s.head(width); },
               .next = [=](const At& at, const VectorView& s,
                           VectorRef next) { next << s.tail((n - 1) * width), at.u[0]; }});
}

}  // namespace saltus
