// A rimless wheel rolls down a slope: theta'' = sin theta from spoke to spoke; each impact keeps
// cos(2 alpha) of the speed. Times by quadrature to 30 digits (references.py), speeds by energy.
#include "support/cases.hpp"

using namespace saltus;
using namespace support;

namespace {

const double alpha = std::acos(-1.0) / 8.0, slope = 0.08;
constexpr double first_speed = 0.4;

/// With `back` also the guard of the spoke behind, which is zero just after each impact.
std::shared_ptr<Leaf> wheel(bool back) {
  return make_leaf("wheel", [=](Leaf& l) {
    l.declare_continuous_state(
        {.initial = vec({slope - alpha, first_speed}),
         .ode = [](const At& at, VectorRef xdot) { xdot << at.x[1], std::sin(at.x[0]); }});
    l.declare_zero_crossing({.name = "spoke",
                             .guard = [](const At& at) { return at.x[0] - (slope + alpha); },
                             .reset_map =
                                 [](const At& at, Next& next) {
                                   next.set_continuous_state(
                                       {at.x[0] - 2.0 * alpha, std::cos(2.0 * alpha) * at.x[1]});
                                 },
                             .direction = Direction::negative_then_non_negative});
    if (!back) return;
    l.declare_zero_crossing({.name = "spoke behind",
                             .guard = [](const At& at) { return at.x[0] - (slope - alpha); },
                             .reset_map =
                                 [](const At& at, Next& next) {
                                   next.set_continuous_state(
                                       {at.x[0] + 2.0 * alpha, std::cos(2.0 * alpha) * at.x[1]});
                                 },
                             .direction = Direction::positive_then_non_positive});
  });
}

}  // namespace

TEST_CASE("a rimless wheel comes down spoke by spoke as its quadrature says", "[laws]") {
  const auto method = GENERATE(from_range(methods));
  const bool back = GENERATE(false, true);
  const std::vector<double> times{2.4376494276572002, 5.1785361203034414, 8.1316153535854671,
                                  11.216034587672832, 14.374810471702362, 17.573374826345081,
                                  20.792554411654779, 24.022231509704741, 27.257206122412456,
                                  30.494841847727096};
  // w+^2 = cos(2 alpha)^2 (w^2 + 2 (cos a - cos b)): a contraction onto the speed of the limit
  // cycle.
  const double keeps = std::pow(std::cos(2.0 * alpha), 2),
               gain = 2.0 * (std::cos(slope - alpha) - std::cos(slope + alpha));
  std::vector<double> speeds;
  for (double w2 = first_speed * first_speed; speeds.size() < times.size();)
    speeds.push_back(std::sqrt(w2 = keeps * (w2 + gain)));
  const double rtol = 1e-10, atol = 1e-12;
  for (const Form& form : forms(wheel(back))) {
    const auto results = simulate(*form.system, form.context(), {0.0, 31.0},
                                  {.rtol = rtol, .atol = atol, .ode_solver_method = method});
    // Near the top an error grows like e^t to the vertical and shrinks behind it: the wheel takes
    // 1.5 s up there, at the speed 0.2. In energy w dw is conserved: an early error d of w = 0.4 is
    // one of 2 d at the top and of time some 10 d. Later ones weigh half as much each time.
    const double made = allowed(method, rtol, atol, 0.5, 3.0);
    within(text("rimless wheel times ", form.name), method,
           worst(firing_times(results.events), times), 10.0 * made * 10.0);
    std::vector<double> found;
    for (std::size_t i = 0; i < results.events.size(); ++i)
      found.push_back(results.events[i].after[1]);
    within(text("rimless wheel speeds ", form.name), method, worst(found, speeds), 2.0 * made);
  }
}
