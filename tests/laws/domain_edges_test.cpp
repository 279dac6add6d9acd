// Guards at the edge of what a derivative is defined for, as x of sqrt(x): no step can end beyond
// the edge, and the guard fires all the same.
#include "support/cases.hpp"

using namespace saltus;
using namespace support;

namespace {

/// x' = f(x) for x >= 0, NaN below; from 1 it reaches 0 at `time`.
struct Domain {
  const char* name;
  double (*f)(double x);
  double time;  // [s]
};

// With u = sqrt(x) the times are those of integrals of 2 u / f over u from 0 to 1.
const Domain domains[] = {
    {"-1", [](double) { return -1.0; }, 1.0},
    {"-1 - sqrt(x)", [](double x) { return -1.0 - std::sqrt(x); }, 2.0 * (1.0 - std::log(2.0))},
    {"-1 / (1 + sqrt(x))", [](double x) { return -1.0 / (1.0 + std::sqrt(x)); }, 5.0 / 3.0},
    {"-2 + sqrt(x)", [](double x) { return -2.0 + std::sqrt(x); }, 4.0 * std::log(2.0) - 2.0},
};

/// The same at any place, upwards or downwards, with a guard of any size, at the edge or just before
/// it, beside some oscillators, with the edge at some place.
struct Seen {
  double sign, begin, size, before;
  int beside = 1;
  double place = 0.0;
};
const Seen views[] = {
    {1.0, 0.0, 1.0, 0.0},         {-1.0, 0.0, 1.0, 0.0},         {1.0, 1e3, 1.0, 0.0},
    {1.0, 0.0, 1e-200, 0.0},      {1.0, 0.0, 1.0, 1e-12},        {1.0, 0.0, 1.0, 0.0, 20},
    {1.0, 0.0, 1.0, 0.0, 1, 5.0}, {-1.0, 0.0, 1.0, 0.0, 1, 5.0}, {-1.0, 0.0, 1.0, 0.0, 1, -20.0}};

enum class End { reset, mode, terminal };

std::shared_ptr<Leaf> to_edge(const Domain& domain, const Seen& seen, End end) {
  return make_leaf("tank", [=](Leaf& l) {
    l.declare_default_mode(0);
    Eigen::VectorXd initial = Eigen::VectorXd::Ones(1 + 2 * seen.beside);
    initial[0] = seen.place + seen.sign;
    l.declare_continuous_state({.initial = initial, .ode = [=](const At& at, VectorRef xdot) {
                                  const double x = seen.sign * (at.x[0] - seen.place);
                                  const double f =
                                      x >= 0.0 ? seen.sign * domain.f(x) : not_a_number;
                                  xdot[0] = at.mode == 0 ? f : 0.0;
                                  for (Index i = 1; i < xdot.size(); i += 2)
                                    xdot[i] = at.x[i + 1], xdot[i + 1] = -at.x[i];
                                }});
    ZeroCrossing empty{
        .name = "empty",
        .guard = [=](const At& at) { return seen.size * (at.x[0] - seen.place - seen.before); },
        .direction = seen.sign > 0.0 ? Direction::positive_then_non_positive
                                     : Direction::negative_then_non_negative,
        .terminal = end == End::terminal};
    if (end == End::reset) {
      empty.reset_map = [=](const At& at, Next& next) {
        Eigen::VectorXd x = at.x;
        x[0] = seen.place + seen.sign;
        next.set_continuous_state(x);
      };
    }
    if (end == End::mode) empty.start_mode = 0, empty.end_mode = 1;
    l.declare_zero_crossing(std::move(empty));
  });
}

}  // namespace

TEST_CASE("a guard at the edge of the domain of a derivative fires", "[laws][guards]") {
  const auto method = GENERATE(from_range(methods));
  const auto end = GENERATE(End::reset, End::mode, End::terminal);
  const double rtol = GENERATE(1e-3, 1e-6, 1e-10), atol = 1e-2 * rtol;
  for (const Domain& domain : domains) {
    for (const Seen& seen : views) {
      const auto leaf = to_edge(domain, seen, end);
      const double t0 = seen.begin, t_end = t0 + 3.5 * domain.time;
      INFO(method << ", rtol " << rtol << ", x' = " << domain.name << ", sign " << seen.sign
                  << ", place " << seen.place);
      const auto results = simulate(*leaf, leaf->create_context(t0), {t0, t_end},
                                    {.rtol = rtol, .atol = atol, .ode_solver_method = method});
      INFO(to_string(results.status)
           << ", " << results.message << " "
           << Catch::StringMaker<std::vector<double>>::convert(firing_times(results.events)));
      if (end == End::terminal) CHECK(results.status == Status::terminal);
      std::vector<double> expected;
      for (int lap = 1; lap <= (end == End::reset ? 3 : 1); ++lap)
        expected.push_back(t0 + lap * domain.time);
      // |x'| >= 1 / 2 at all times, so an error of the time is at most twice that of the state. A
      // multistep method takes many short steps towards the root of x, as BDF does; so does radau
      // where the rounding of the state hides how far the edge is.
      const bool hidden = method == Method::radau && seen.place != 0.0;
      const Method counted = one_step(method) && !hidden ? method : Method::bdf;
      const double tolerance = 2.0 * allowed(counted, rtol, atol, 1.0 + std::abs(seen.place),
                                             static_cast<double>(expected.size()));
      within(text("x' = ", domain.name, ", sign ", seen.sign, " from ", t0, ", guard ", seen.size,
                  ", before ", seen.before, ", beside ", seen.beside, ", place ", seen.place),
             method,
             end == End::terminal ? std::abs(results.context.time() - expected[0])
                                  : worst(firing_times(results.events), expected),
             tolerance + 400.0 * eps * t_end);
    }
  }
}

TEST_CASE("a tank that empties by Torricelli's law ends its flow", "[laws][guards]") {
  // x' = -sqrt(x): x = (1 - t / 2)^2, whose slope is zero at the domain. There an error of x is the
  // square of half the error of the time.
  const auto method = GENERATE(from_range(methods));
  const double rtol = GENERATE(1e-4, 1e-6, 1e-9), atol = 1e-2 * rtol;
  const Domain domain{"-sqrt(x)", [](double x) { return -std::sqrt(x); }, 2.0};
  const auto leaf = to_edge(domain, views[0], End::mode);
  const auto results = simulate(*leaf, leaf->create_context(), {0.0, 5.0},
                                {.rtol = rtol, .atol = atol, .ode_solver_method = method});
  within("x' = -sqrt(x)", method, worst(firing_times(results.events), {2.0}),
         2.0 * std::sqrt(allowed(method, rtol, atol, 1.0)));
  within("x' = -sqrt(x), rest", method, std::abs(results.context.continuous_state()[0]), eps);
}

TEST_CASE("beyond the edge, without a reset map, the run ends in the derivative's error",
          "[laws][guards]") {
  const auto method = GENERATE(from_range(methods));
  const bool watched = GENERATE(false, true);
  const auto leaf = make_leaf("tank", [=](Leaf& l) {
    l.declare_continuous_state({.initial = vec({1.0}), .ode = [](const At& at) {
                                  return at.x[0] >= 0.0 ? -1.0 : not_a_number;
                                }});
    if (watched)
      l.declare_zero_crossing({.name = "empty", .guard = [](const At& at) { return at.x[0]; }});
  });
  INFO("method " << method << ", watched " << watched);
  const auto ended = message<SimulationError>(
      [&] { simulate(*leaf, leaf->create_context(), {0.0, 2.0}, {.ode_solver_method = method}); });
  CHECK(contains(ended, "derivative of block 'tank' is not finite"));
}
