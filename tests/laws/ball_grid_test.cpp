// A dropped ball, from a nanometre to a million kilometres, from feather to anvil: contact k at
// t1 + 2 t1 (e + ... + e^(k-1)), at rest from t1 (1 + e) / (1 - e) on. Tolerances move with the
// scene, so every corner of the grid is the same problem in other units.
#include "support/cases.hpp"

using namespace saltus;
using namespace support;

namespace {

struct Units {
  double y0, g;
};
constexpr std::array units{Units{1.0, 9.81}, Units{1e-9, 1e-6}, Units{1e-9, 1e6}, Units{1e9, 1e-6},
                           Units{1e9, 1e6}};

struct Problem {
  BallExact exact;
  SimulatorOptions options;
  double speed;  // [m/s] at the first contact
  double steps;  // a flight; 0 where the method makes no error on a parabola

  Problem(Units u, double e, Method method) : exact{u.g, e, u.y0} {
    const double t1 = exact.first();
    speed = u.g * t1;
    // Heights and speeds of one scene are up to 1e7 apart: atol goes by the smaller, as far as the
    // larger has digits for it.
    const double atol = std::max(1e-11 * std::min(u.y0, speed), 1e-14 * std::max(u.y0, speed));
    options = {.rtol = 1e-9,
               .atol = atol,
               .ode_solver_method = method,
               .zeno_tolerance = 1e-6 * t1,
               .throw_errors = false};
    steps = one_step(method) ? 0.0 : 40.0;
  }

  /// How wrong contact n may be: a flight adds its steps' errors of height, over the speed of the
  /// contact, and of speed, which the flights to come carry on as 2 dv / g each; a location adds
  /// 100 eps (|t| + |h|) <= 200 eps t.
  double time_error(int n) const {
    const double slowest = speed * std::pow(exact.e, n - 1), atol = options.atol,
                 rtol = options.rtol;
    const double flight =
        (rtol * exact.h + atol) / slowest + 2.0 * n * (rtol * speed + atol) / exact.g;
    return n * (steps * flight + 2.0 * n * 200.0 * eps * exact.contact(n));
  }
};

std::vector<BallScene> both_forms(const Problem& p) {
  const BallOptions options{.g = p.exact.g, .e = p.exact.e};
  return {leaf(options), blocks(Contact::comparator, options)};
}

}  // namespace

TEST_CASE("contacts of a ball in any units come when the closed form says", "[laws][ball]") {
  const auto method = GENERATE(from_range(methods));
  const Units u = GENERATE(from_range(units));
  for (const double e : {0.1, 0.5, 0.9, 1.0}) {
    const int n =
        e < 0.5 ? 3 : 6;  // after three contacts with e = 0.1 a flight is 1e-6 of the drop
    const Problem p(u, e, method);
    const double end = p.exact.contact(n) + p.exact.speed(n) / u.g;  // at the next apex
    for (const BallScene& scene : both_forms(p)) {
      INFO("y0 " << u.y0 << ", g " << u.g << ", e " << e);
      const auto results = simulate(*scene.system, scene.context(u.y0, 0.0), {0.0, end}, p.options);
      CHECK(results.status == Status::reached_end);
      std::vector<double> expected;
      for (int k = 1; k <= n; ++k) expected.push_back(p.exact.contact(k));
      const double t1 = p.exact.first();
      within(text("ball grid contacts e=", e, " ", scene.form), method,
             worst(contact_times(results.events), expected) / t1, p.time_error(n) / t1);
    }
  }
}

TEST_CASE("past its Zeno time a ball in any units rests, where and when the series says",
          "[laws][ball][zeno]") {
  const auto method = GENERATE(from_range(methods));
  const Units u = GENERATE(from_range(units));
  for (const double e : {0.0, 0.1, 0.5, 0.9}) {
    const Problem p(u, e, method);
    const double rest = p.exact.rest(), t1 = p.exact.first(), end = 1.5 * rest;
    // q is the ratio of two gaps, each known to 400 eps t, and the rest is gap q / (1 - q). A
    // multistep method sees nothing of flights lower than the errors of its steps.
    const double blind = p.steps * (p.options.rtol * u.y0 + p.options.atol);
    const double time = p.time_error(1) + 800.0 * eps * rest / ((1.0 - e) * (1.0 - e)) +
                        8.0 * std::sqrt(2.0 * blind / u.g) / (1.0 - e);
    for (const BallScene& scene : both_forms(p)) {
      INFO("y0 " << u.y0 << ", g " << u.g << ", e " << e);
      const auto results = simulate(*scene.system, scene.context(u.y0, 0.0), {0.0, end}, p.options);
      CHECK(results.status == Status::reached_end);
      CHECK(results.message == "");
      CHECK(count(results.events, EventKind::zeno_enter) == scene.monitors);
      const auto& x = results.context.continuous_state();
      within(text("ball grid rest y e=", e, " ", scene.form), method, std::abs(x[0]) / u.y0,
             blind / u.y0);
      within(text("ball grid rest v e=", e, " ", scene.form), method, std::abs(x[1]) / p.speed,
             u.g * time / p.speed);
      for (std::size_t i = 0; i < results.events.size(); ++i) {
        if (results.events[i].kind != EventKind::zeno_enter) continue;
        const double predicted = results.events[i].predicted;
        within(text("ball grid Zeno time e=", e, " ", scene.form), method,
               std::abs(predicted - rest) / t1, time / t1);
      }
    }
  }
}

TEST_CASE("with e = 1 the ten thousandth bounce is as high as the first", "[laws][ball]") {
  const auto method = GENERATE(from_range(methods));
  const int n = one_step(method) ? 10000 : 1000;
  const Problem p({1.0, 2.0}, 1.0, method);  // t1 = 1 s, contacts at 1, 3, 5, ...
  const BallScene scene = leaf({.g = 2.0, .e = 1.0});
  const auto results = simulate(*scene.system, scene.context(1.0, 0.0), {0.0, 2.0 * n}, p.options);
  CHECK(results.status == Status::reached_end);
  CHECK(results.statistics.events == n);
  // The reset puts the ball on the floor from where the step left it, beyond by v 100 eps (t + h):
  // an error of speed of g / v times that, the same sign each time.
  const double speed = 2.0 + n * 2.0 * 200.0 * eps;
  const double tolerance =
      p.steps * n * (p.options.rtol * 2.0 + p.options.atol) + n * 2.0 * 200.0 * eps * 2.0 * n;
  const double v = results.events[results.events.size() - 1].after[1];
  within("ball e=1, energy of the last bounce", method, std::abs(0.5 * v * v - 2.0),
         speed * tolerance);
  // At 2 n s it is at the apex again, if no contact came late.
  within("ball e=1, last contact", method,
         std::abs(results.events[results.events.size() - 1].time - (2.0 * n - 1.0)), n * tolerance);
}
