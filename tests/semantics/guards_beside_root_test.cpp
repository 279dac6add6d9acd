// Semantics 2.2, 3.4: a guard that comes to zero from its firing side at the root of another one.
#include "support/leaves.hpp"

using namespace saltus;
using namespace support;

namespace {

/// What the guard at the root does to the state.
enum class Effect { stop_by_mode, stop_by_state, stop_by_number, put_there, go_on, bounce };
constexpr std::array effects{Effect::stop_by_mode, Effect::stop_by_state, Effect::stop_by_number,
                             Effect::put_there,    Effect::go_on,         Effect::bounce};

/// The guard beside it: the same curve in other words, so that roundings differ.
enum class View { same, scaled, expanded };
constexpr std::array views{View::same, View::scaled, View::expanded};

constexpr Direction falling = Direction::positive_then_non_positive;
constexpr Direction rising = Direction::negative_then_non_negative;

double seen(View view, double x, double end) {
  if (view == View::same) return x - end;
  return view == View::scaled ? 3.7 * (x - end) : 1.1 * x - 1.1 * end;
}

struct Setup {
  double rate = 1.0, end = 1.0;
  Effect effect = Effect::stop_by_mode;
  View view = View::same;
  bool first = false;  ///< the guard beside the root is declared first
};

/// x' = v z0 in mode 0, and 0 in mode 1; at x = end the guard "root" has its effect.
void declare_root(Leaf& l, const Setup& setup) {
  const auto reset = [=](const At& at, Next& next) {
    if (setup.effect == Effect::stop_by_state) next.set_continuous_state({at.x[0], 0.0});
    if (setup.effect == Effect::put_there) next.set_continuous_state({setup.end, 0.0});
    if (setup.effect == Effect::bounce) next.set_continuous_state({at.x[0], -at.x[1]});
    if (setup.effect == Effect::go_on) next.set_continuous_state(at.x);
    if (setup.effect == Effect::stop_by_number) next.set_discrete_state({0.0, at.z[1]});
  };
  const bool mode = setup.effect == Effect::stop_by_mode;
  l.declare_zero_crossing({.name = "root",
                           .guard = [=](const At& at) { return at.x[0] - setup.end; },
                           .reset_map = mode ? ResetMap() : ResetMap(reset),
                           .start_mode = 0,
                           .end_mode = mode ? 1 : 0});
}

/// The guard that is watched. It has an effect, so that the solver stops at it: z1 counts.
void declare_beside(Leaf& l, const Setup& setup, Direction direction, bool negative) {
  l.declare_zero_crossing(
      {.name = "beside",
       .guard =
           [=](const At& at) {
             const double g = seen(setup.view, at.x[0], setup.end);
             return negative ? -g : g;
           },
       .reset_map = [](const At& at,
                       Next& next) { next.set_discrete_state({at.z[0], at.z[1] + 1.0}); },
       .direction = direction});
}

/// How often the guard beside the root fires while x goes to `end` and stays or goes on.
std::size_t firings(const Setup& setup, Direction direction, bool negative, Method method) {
  const Leaf leaf("leaf", [=](Leaf& l) {
    l.declare_continuous_state(
        {.initial = vec({0.0, setup.rate}), .ode = [](const At& at, VectorRef xdot) {
           xdot << (at.mode == 0 ? at.x[1] * at.z[0] : 0.0), 0.0;
         }});
    l.declare_discrete_state(vec({1.0, 0.0}));
    l.declare_default_mode(0);
    if (setup.first) declare_beside(l, setup, direction, negative);
    declare_root(l, setup);
    if (!setup.first) declare_beside(l, setup, direction, negative);
  });
  const double end = std::abs(setup.end / setup.rate);
  const Results results = simulate(leaf, leaf.create_context(), {0.0, 1.7 * end},
                                   {.rtol = 1e-9, .atol = 1e-12, .ode_solver_method = method});
  CHECK(results.events.times("root").size() == 1);
  return results.events.times("beside").size();
}

std::vector<Setup> setups() {
  std::vector<Setup> all;
  for (const double rate : {1.0, 0.1, 1.0 / 3.0, 7.3})
    for (const double end : {1.0, 0.3, 7.7, -2.2})
      for (const Effect effect : effects)
        for (const View view : views)
          for (const bool first : {true, false})
            all.push_back({end > 0.0 ? rate : -rate, end, effect, view, first});
  return all;
}

}  // namespace

TEST_CASE(
    "2.2 a guard that comes to zero from its firing side, at the root of another, never fires",
    "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  for (const Setup& setup : setups()) {
    INFO("method " << method << ", rate " << setup.rate << ", end " << setup.end << ", effect "
                   << static_cast<int>(setup.effect) << ", view " << static_cast<int>(setup.view)
                   << ", first " << setup.first);
    // x - end rises if the rate is positive. It is seen as it is, and with the other sign.
    const bool up = setup.rate > 0.0;
    CHECK(firings(setup, up ? falling : rising, false, method) == 0);
    CHECK(firings(setup, up ? rising : falling, true, method) == 0);
  }
}

TEST_CASE("2.2 a guard that reaches zero in its direction at the root of another fires once",
          "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  for (const Setup& setup : setups()) {
    INFO("method " << method << ", rate " << setup.rate << ", end " << setup.end << ", effect "
                   << static_cast<int>(setup.effect) << ", view " << static_cast<int>(setup.view)
                   << ", first " << setup.first);
    const bool up = setup.rate > 0.0;
    CHECK(firings(setup, up ? rising : falling, false, method) == 1);
    CHECK(firings(setup, Direction::crosses_zero, false, method) == 1);
  }
}
