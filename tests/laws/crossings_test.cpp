// Crossings that are counted: a reset map that writes discrete state only leaves the guard where it
// is, at zero. Each crossing fires once, at its time.
#include "support/cases.hpp"
#include "support/oscillator.hpp"

using namespace saltus;
using namespace support;

namespace {

const double pi = std::acos(-1.0);

/// (sin t, cos t), and a count of the crossings of `level`. `reads`: what the ode reads.
std::shared_ptr<Leaf> counted_oscillator(double level, Reads reads) {
  return make_leaf("leaf", [=](Leaf& l) {
    declare_oscillator(l, {0.0, 1.0}, reads);
    l.declare_discrete_state(vec({0.0}));
    l.declare_zero_crossing({.name = "hit",
                             .guard = [=](const At& at) { return level - at.x[0]; },
                             .reset_map = count_up});
  });
}

/// The times in (0, end] at which sin t = level.
std::vector<double> crossings(double level, double end) {
  std::vector<double> times;
  for (double turn = 0.0; turn < end + 2.0 * pi; turn += 2.0 * pi) {
    for (const double t : {turn + std::asin(level), turn + pi - std::asin(level)}) {
      if (t > 0.0 && t <= end) times.push_back(t);
    }
  }
  std::ranges::sort(times);
  return times;
}

void counts(Method method, double rtol, Reads reads, double level) {
  for (const Form& form : forms(counted_oscillator(level, reads))) {
    const double end = 43.0;  // nearly seven turns, off every crossing
    const double atol = 1e-2 * rtol, slope = std::sqrt(1.0 - level * level);
    const auto results =
        simulate(*form.system, form.context(), {0.0, end},
                 {.rtol = rtol, .atol = atol, .ode_solver_method = method, .throw_errors = false});
    INFO("level " << level << ", rtol " << rtol);
    CHECK(results.status == Status::reached_end);
    // An oscillator carries its errors on unchanged: ten local errors for each of 44 s, or a
    // hundred of BDF, over the slope at the crossing.
    within(text("counted crossings ", reads == Reads::everything ? "restarted " : "", form.name),
           method, worst(firing_times(results.events), crossings(level, end)),
           allowed(method, rtol, atol, 1.0, end) / slope);
  }
}

}  // namespace

TEST_CASE("an oscillator's crossings of a level are counted once each", "[laws][guards]") {
  const auto method = GENERATE(from_range(methods));
  const double rtol = GENERATE(1e-6, 1e-10), level = GENERATE(0.9, 0.5, 0.1, -0.5);
  for (const Reads reads : {Reads::continuous_state, Reads::everything})
    counts(method, rtol, reads, level);
}
