// Blocks that change at ticks.
#include "blocks.hpp"
#include "saltus/library/delay_n.hpp"
#include "saltus/library/discrete_clock.hpp"
#include "saltus/library/edge_detection.hpp"
#include "saltus/library/rate_limiter.hpp"
#include "saltus/library/rate_transition.hpp"
#include "saltus/library/transport_delay.hpp"
#include "saltus/library/unit_delay.hpp"
#include "saltus/library/zero_order_hold.hpp"

namespace saltus::python {

void bind_discrete(py::module_& module) {
  using Handle = const py::object&;
  py::class_<DelayN, System>(module, "DelayN")
      .def(py::init([](const std::string& name, double dt, int n, Handle initial_state) {
        return std::make_unique<DelayN>(
            name, dt, n, DelayNOptions{Arguments(name).value(initial_state, "initial_state")});
      }));
  py::class_<DiscreteClock, System>(module, "DiscreteClock").def(py::init<std::string, double>());
  py::class_<EdgeDetection, System>(module, "EdgeDetection")
      .def(py::init([](std::string name, double dt, std::string_view edge, bool initial_state) {
        const Edge which = edge_from(name, edge);
        return std::make_unique<EdgeDetection>(std::move(name), dt,
                                               EdgeDetectionOptions{which, initial_state});
      }));
  py::class_<RateLimiter, System>(module, "RateLimiter")
      .def(py::init([](const std::string& name, double dt, double upper_limit, double lower_limit,
                       Handle initial_state) {
        return std::make_unique<RateLimiter>(
            name, dt,
            RateLimiterOptions{
                .lower_limit = lower_limit,
                .upper_limit = upper_limit,
                .initial_state = Arguments(name).value(initial_state, "initial_state")});
      }));
  py::class_<RateTransition, System>(module, "RateTransition")
      .def(py::init([](const std::string& name, double dt, Handle initial_state, double offset) {
        return std::make_unique<RateTransition>(
            name, dt,
            RateTransitionOptions{Arguments(name).value(initial_state, "initial_state"), offset});
      }));
  py::class_<TransportDelay, System>(module, "TransportDelay")
      .def(py::init([](const std::string& name, double delay, Handle initial_output, int capacity) {
        return std::make_unique<TransportDelay>(
            name, delay,
            TransportDelayOptions{Arguments(name).value(initial_output, "initial_output"),
                                  capacity});
      }));
  py::class_<UnitDelay, System>(module, "UnitDelay")
      .def(py::init([](const std::string& name, double dt, Handle initial_state) {
        return std::make_unique<UnitDelay>(
            name, dt, UnitDelayOptions{Arguments(name).value(initial_state, "initial_state")});
      }));
  py::class_<ZeroOrderHold, System>(module, "ZeroOrderHold")
      .def(py::init([](const std::string& name, double dt, Handle initial_state) {
        return std::make_unique<ZeroOrderHold>(
            name, dt, ZeroOrderHoldOptions{Arguments(name).value(initial_state, "initial_state")});
      }));
  bind_discrete_linear(module);
}

}  // namespace saltus::python
