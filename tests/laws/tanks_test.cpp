// Two draining tanks, one inflow switched between them: the switches accumulate at
// (x1 + x2 - r1 - r2) / (v1 + v2 - w), with both tanks at their marks.
#include "support/cases.hpp"

using namespace saltus;
using namespace support;

namespace {

struct Tanks {
  double w, v1, v2, r1, r2;  // inflow, outflows [m^3/s]; marks [m^3]
  double x1, x2;             // at t = 0, inflow in tank 1

  double accumulation() const { return (x1 + x2 - r1 - r2) / (v1 + v2 - w); }

  /// The first n switches: the tank without inflow drains to its mark.
  std::vector<double> switches(int n) const {
    std::vector<double> times;
    double a = x1 - r1, b = x2 - r2, t = 0.0;
    for (int k = 0; k < n; ++k) {
      const bool first = k % 2 == 0;
      const double dt = first ? b / v2 : a / v1;
      a = first ? a + (w - v1) * dt : 0.0;
      b = first ? 0.0 : b + (w - v2) * dt;
      times.push_back(t += dt);
    }
    return times;
  }

  std::shared_ptr<Leaf> leaf() const {
    return make_leaf("tanks", [self = *this](Leaf& l) {
      l.declare_continuous_state(
          {.initial = vec({self.x1, self.x2}), .ode = [=](const At& at, VectorRef xdot) {
             xdot << (at.mode == 1 ? self.w : 0.0) - self.v1,
                 (at.mode == 2 ? self.w : 0.0) - self.v2;
           }});
      l.declare_default_mode(1);
      l.declare_zero_crossing({.name = "second_low",
                               .guard = [=](const At& at) { return at.x[1] - self.r2; },
                               .direction = Direction::positive_then_non_positive,
                               .start_mode = 1,
                               .end_mode = 2});
      l.declare_zero_crossing({.name = "first_low",
                               .guard = [=](const At& at) { return at.x[0] - self.r1; },
                               .direction = Direction::positive_then_non_positive,
                               .start_mode = 2,
                               .end_mode = 1});
    });
  }
};

const std::array scenes{Tanks{0.75, 0.5, 0.5, 0.0, 0.0, 1.0, 1.0},
                        Tanks{1.8, 1.0, 1.0, 0.3, 0.7, 2.0, 5.0}};

}  // namespace

TEST_CASE("water tanks switch when their closed form says", "[laws][zeno]") {
  const auto method = GENERATE(from_range(methods));
  for (const Tanks& tanks : scenes) {
    const auto expected = tanks.switches(15);
    const double end = expected.back() + 0.4 * (tanks.switches(16).back() - expected.back());
    for (const Form& form : forms(tanks.leaf())) {
      const auto results = simulate(*form.system, form.context(), {0.0, end},
                                    {.ode_solver_method = method, .throw_errors = false});
      CHECK(results.status == Status::reached_end);
      // Constant rates: every method is exact. A location errs by 100 eps (t + h), and each switch
      // carries on what the one before did, with a factor w / v - 1 < 1.
      within(text("tanks switches w=", tanks.w, " ", form.name), method,
             worst(firing_times(results.events), expected), 15.0 * 400.0 * eps * end);
    }
  }
}

TEST_CASE("past their Zeno time the tanks rest at their marks", "[laws][zeno]") {
  const auto method = GENERATE(from_range(methods));
  for (const Tanks& tanks : scenes) {
    for (const Form& form : forms(tanks.leaf())) {
      const double end = 1.5 * tanks.accumulation();
      const auto results = simulate(*form.system, form.context(), {0.0, end},
                                    {.ode_solver_method = method, .throw_errors = false});
      CHECK(results.status == Status::reached_end);
      CHECK(results.message == "");
      const auto& x = results.context.continuous_state();
      // The time and the state of rest to 1e-9; q is off by 400 eps t / gap, amplified as for a
      // ball, which is less.
      within(text("tanks level w=", tanks.w, " ", form.name), method,
             std::max(std::abs(x[0] - tanks.r1), std::abs(x[1] - tanks.r2)), 1e-9);
      CHECK(count(results.events, EventKind::zeno_enter) >= 1);
      for (std::size_t i = 0; i < results.events.size(); ++i) {
        if (results.events[i].kind == EventKind::zeno_enter)
          within(text("tanks Zeno time w=", tanks.w, " ", form.name), method,
                 std::abs(results.events[i].predicted - tanks.accumulation()), 1e-9);
      }
    }
  }
}
