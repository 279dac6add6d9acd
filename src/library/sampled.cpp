// Blocks that read their inputs at ticks and hold their output in between.
#include "saltus/library/detail/sampled.hpp"

#include "saltus/library/detail/schedule.hpp"

namespace saltus::detail {

/// From the beginning of the instant the output is that of the tick, before the state has changed.
/// So a block that reads it at this tick gets y[k], not y[k-1].
void SampledSystem::declare_law(const Law& law) {
  if (law.dt == inherited_period && law.may_inherit) return declare_inherited_law(law);
  require_period(name(), "dt", law.dt);
  const Index n = law.before.values.size(), states = law.state.size();
  Eigen::VectorXd z(1 + n + states);
  z << -1.0, law.before.values, law.state;
  declare_discrete_state(z);
  const auto state = [=](const At& at) { return VectorView(at.z.data() + 1 + n, states); };
  const auto show = [=, output = law.output, dt = law.dt, offset = law.offset](const At& at,
                                                                               VectorRef out) {
    if (is_due(at.time, at.z[0], dt, offset))
      output(at, state(at), out);
    else
      out = at.z.segment(1, n);
  };
  const auto tick = [=, output = law.output, move = law.next, dt = law.dt, offset = law.offset](
                        const At& at, Next& next) {
    Eigen::VectorXd now(1 + n + states);
    now[0] = last_tick(at.time, dt, offset);
    // A run that begins at a tick of an earlier run, with a state changed by hand, has had this
    // tick.
    if (now[0] == at.z[0]) return;
    output(at, state(at), VectorRef(now.data() + 1, n));
    if (states > 0) move(at, state(at), VectorRef(now.data() + 1 + n, states));
    next.set_discrete_state(now);
  };
  Reads reads = Reads::discrete_state | Reads::schedule;
  if (!law.feedthrough.empty()) reads = reads | Reads::inputs;
  declare_output_port({.name = "out",
                       .calc = show,
                       .shape = law.before.shape(),
                       .reads = reads,
                       .inputs = law.feedthrough,
                       .boolean = law.boolean});
  declare_periodic_update(tick, law.dt, law.offset, "tick");
}

/// A TriggeredSubsystem reads the output at a trigger, before the states change.
void SampledSystem::declare_inherited_law(const Law& law) {
  const Index states = law.state.size();
  declare_discrete_state(law.state);
  const auto state = [=](const At& at) { return VectorView(at.z.data(), states); };
  const auto show = [=, output = law.output](const At& at, VectorRef out) {
    output(at, state(at), out);
  };
  const auto tick = [=, move = law.next](const At& at, Next& next) {
    Eigen::VectorXd now(states);
    if (states > 0) move(at, state(at), VectorRef(now.data(), states));
    next.set_discrete_state(now);
  };
  const bool reads_inputs = !law.feedthrough.empty();
  declare_output_port(
      {.name = "out",
       .calc = show,
       .shape = law.before.shape(),
       .reads = reads_inputs ? Reads::discrete_state | Reads::inputs : Reads::discrete_state,
       .inputs = law.feedthrough,
       .boolean = law.boolean});
  declare_periodic_update(tick, inherited_period, 0.0, "tick");
}

}  // namespace saltus::detail
