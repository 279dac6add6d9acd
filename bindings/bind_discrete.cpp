// Blocks that change at ticks.
#include "blocks.hpp"
#include "saltus/library/rate_limiter.hpp"
#include "saltus/library/unit_delay.hpp"
#include "saltus/library/zero_order_hold.hpp"

namespace saltus::python {

void bind_discrete(py::module_& module) {
  using Handle = const py::object&;
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
}

}  // namespace saltus::python
