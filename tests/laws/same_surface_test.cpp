// Several guards on one surface, or nearly on one: each in its direction, all in one pass, none
// twice.
#include "support/cases.hpp"

using namespace saltus;
using namespace support;

namespace {

const double pi = std::acos(-1.0);

std::string short_name(Direction direction) {
  return std::string(to_string(direction)).substr(0, 8);
}

}  // namespace

TEST_CASE("guards of each direction on one surface fire each in its own", "[laws][guards]") {
  const auto method = GENERATE(filter(one_step, from_range(methods)));
  const auto leaf = make_leaf("leaf", [](Leaf& l) {
    l.declare_continuous_state(
        {.initial = vec({0.5, -1.0}),
         .ode = [](const At& at, VectorRef xdot) { xdot << at.x[1], -at.x[0]; },
         .reads = Reads::continuous_state});
    l.declare_discrete_state(vec({0.0, 0.0, 0.0, 0.0}));
    int i = 0;
    for (const Direction direction :
         {Direction::crosses_zero, Direction::positive_then_non_positive,
          Direction::negative_then_non_negative, Direction::none}) {
      l.declare_zero_crossing({.name = short_name(direction),
                               .guard = [](const At& at) { return at.x[0]; },
                               .reset_map =
                                   [=](const At& at, Next& next) {
                                     next.set_discrete_state(at.z + Eigen::VectorXd::Unit(4, i));
                                   },
                               .direction = direction});
      ++i;
    }
  });
  for (const Form& form : forms(leaf)) {
    const auto results = simulate(*form.system, form.context(), {0.0, 100.0 * pi},
                                  {.rtol = 1e-9, .atol = 1e-11, .ode_solver_method = method});
    INFO(form.name << ", method " << method);
    CHECK(results.context.discrete_state() == vec({100.0, 50.0, 50.0, 0.0}));
    for (std::size_t i = 1; i < results.events.size(); i += 2)  // in pairs: both, and its direction
      CHECK(results.events[i].time == results.events[i - 1].time);
  }
}

TEST_CASE("guards at nearly equal levels fire in order, each before or with the next",
          "[laws][guards]") {
  const auto method = GENERATE(from_range(methods));
  const double apart = GENERATE(0.0, 1e-16, 1e-15, 1e-13, 1e-9);
  const auto leaf = make_leaf("leaf", [=](Leaf& l) {
    declare_ramp(l);
    l.declare_discrete_state(vec({0.0}));
    for (int i = 0; i < 10; ++i) {
      l.declare_zero_crossing({.name = text("guard_", i),
                               .guard = [=](const At& at) { return at.x[0] - (0.5 + i * apart); },
                               .reset_map = count_up});
    }
  });
  for (const Form& form : forms(leaf)) {
    const auto results =
        simulate(*form.system, form.context(), {0.0, 1.0}, {.ode_solver_method = method});
    INFO(form.name << ", method " << method << ", " << apart << " apart");
    CHECK(results.context.discrete_state()[0] == 10.0);
    std::vector<double> expected;
    for (int i = 0; i < 10; ++i) expected.push_back(0.5 + i * apart);
    // 100 eps (|t| + |h|) each; x = t after ten more steps, each rounded.
    within(text("ten guards ", apart, " apart ", form.name), method,
           worst(firing_times(results.events), expected), 210.0 * eps);
    for (std::size_t i = 0; i < results.events.size(); ++i)
      CHECK(results.events[i].name == text("guard_", i));
  }
}

TEST_CASE("a guard and its copies scaled by any power of ten fire in one pass", "[laws][guards]") {
  const auto method = GENERATE(from_range(methods));
  const auto leaf = make_leaf("leaf", [](Leaf& l) {
    declare_ramp(l);
    l.declare_discrete_state(vec({0.0}));
    for (const double scale : {1.0, 1e-200, 1e200, -1.0, -1e-300, 1e-10}) {
      l.declare_zero_crossing({.name = text("times_", scale),
                               .guard = [=](const At& at) { return scale * (at.x[0] - 0.537); },
                               .reset_map = count_up});
    }
  });
  for (const Form& form : forms(leaf)) {
    const auto results =
        simulate(*form.system, form.context(), {0.0, 1.0}, {.ode_solver_method = method});
    REQUIRE(results.events.size() == 6);
    for (std::size_t i = 0; i < 6; ++i) CHECK(results.events[i].jump == 1);
  }
}

TEST_CASE("a ball whose guard is scaled bounces and rests as if it were not",
          "[laws][ball][zeno][guards]") {
  const auto method = GENERATE(from_range(methods));
  const double scale = GENERATE(1e-200, 1e-10, 1e10, 1e200);
  const double e = GENERATE(0.0, 0.5);
  const auto ball = make_leaf("ball", [=](Leaf& l) {
    l.declare_continuous_state(
        {.initial = vec({1.0, 0.0}),
         .ode = [](const At& at, VectorRef xdot) { xdot << at.x[1], -9.81; }});
    l.declare_zero_crossing(
        {.name = "bounce",
         .guard = [=](const At& at) { return scale * at.x[0]; },
         .reset_map = [=](const At& at,
                          Next& next) { next.set_continuous_state({0.0, -e * at.x[1]}); },
         .direction = Direction::positive_then_non_positive});
  });
  for (const Form& form : forms(ball)) {
    const auto results =
        simulate(*form.system, form.context(), {0.0, 3.0},
                 {.rtol = 1e-9, .atol = 1e-11, .ode_solver_method = method, .throw_errors = false});
    INFO(form.name << ", scale " << scale << ", e " << e);
    CHECK(results.status == Status::reached_end);
    CHECK(count(results.events, EventKind::zeno_enter) == 1);
    // Rest to 1e-9; a multistep method is blind to flights lower than 40 (rtol + atol).
    const double blind = one_step(method) ? 0.0 : std::sqrt(2.0 * 9.81 * 40.0 * (1e-9 + 1e-11));
    within(text("scaled guard, rest, ", form.name), method,
           results.context.continuous_state().cwiseAbs().maxCoeff(), 1e-9 + blind);
  }
}
