// Kinks and jumps of signals in a diagram, told by a Comparator, by a ReduceBlock, by a lambda: the
// integral over them has a closed form. No state moves the guards, only the time does.
#include "support/cases.hpp"

using namespace saltus;
using namespace support;

namespace {

const double pi = std::acos(-1.0);

/// x' = 1 while sin t > sin(1.1 t + 0.3), else -1.
Diagram beats(Contact contact) {
  DiagramBuilder builder;
  auto& slow = builder.add<Sine>("slow", SineOptions{});
  auto& fast = builder.add<Sine>("fast", SineOptions{.frequency = 1.1, .phase = 0.3});
  auto& plus = builder.add<Constant>("plus", 1.0);
  auto& minus = builder.add<Constant>("minus", -1.0);
  auto& choice = builder.add<Switch>("choice");
  auto& x = builder.add<Integrator>("x", Integrator::Options{});
  builder.connect(plus.output(), choice.input("true_value"));
  builder.connect(minus.output(), choice.input("false_value"));
  builder.connect(choice.output(), x.input());
  if (contact == Contact::function) {
    auto& gap = builder.add<Adder>("gap", "+-");
    auto& above = builder.add<FunctionBlock>("above", [](double d) { return d > 0.0; });
    builder.connect(slow.output(), gap.input(0)), builder.connect(fast.output(), gap.input(1));
    builder.connect(gap.output(), above.input());
    builder.connect(above.output(), choice.input("control"));
  } else if (contact == Contact::reduce) {
    auto& above =
        builder.add<ReduceBlock>("above", 2, [](std::span<const double> u) { return u[0] > u[1]; });
    builder.connect(slow.output(), above.input(0)), builder.connect(fast.output(), above.input(1));
    builder.connect(above.output(), choice.input("control"));
  } else {
    auto& above = builder.add<Comparator>("above", ">");
    builder.connect(slow.output(), above.input(0)), builder.connect(fast.output(), above.input(1));
    builder.connect(above.output(), choice.input("control"));
  }
  return builder.build();
}

/// Where the two sines are equal, until `end`: the phases are equal, or mirrored.
std::vector<double> meetings(double end) {
  std::vector<double> times;
  for (int k = -1; k < 1000; ++k) {
    const double equal = (2.0 * pi * k - 0.3) / 0.1, mirrored = (pi * (2.0 * k + 1.0) - 0.3) / 2.1;
    for (const double t : {equal, mirrored}) {
      if (t > 0.0 && t < end) times.push_back(t);
    }
  }
  std::ranges::sort(times);
  return times;
}

}  // namespace

TEST_CASE("an integral over a comparison of two sines is the sum of its pieces", "[laws]") {
  const auto method = GENERATE(from_range(methods));
  const double end = 58.0;  // before the phases are equal at 59.8 s, and the sines nearly tangent
  double expected = 0.0, from = 0.0, sign = -1.0;  // at 0, sin 0 < sin 0.3
  for (const double t : meetings(end)) expected += sign * (t - from), from = t, sign = -sign;
  expected += sign * (end - from);
  for (const Contact contact : contacts) {
    const Diagram diagram = beats(contact);
    // Steps below the distance of two meetings, 1.5 s, so that none hides another.
    const auto results = simulate(diagram, diagram.create_context(), {0.0, end},
                                  {.ode_solver_method = method, .max_minor_step_size = 0.5});
    const char* names[] = {"Comparator", "ReduceBlock", "FunctionBlock"};
    // x' is 1 or -1: nothing to integrate. Each of 39 switches is late by 100 eps (t + h) at most,
    // and by the rounding of the sines' difference over its slope, near the end as small as 0.1;
    // twice.
    const double late = 200.0 * eps * end + 8.0 * eps * end / 0.1;
    within(text("beats by ", names[static_cast<std::size_t>(contact)]), method,
           std::abs(results.context.continuous_state()[0] - expected), 2.0 * 40.0 * late);
  }
}

TEST_CASE("the integral of |sin| grows by two each half turn", "[laws]") {
  const auto method = GENERATE(from_range(methods));
  DiagramBuilder builder;
  auto& sine = builder.add<Sine>("sine", SineOptions{});
  auto& abs = builder.add<Abs>("abs");
  auto& x = builder.add<Integrator>("x", Integrator::Options{});
  builder.connect(sine.output(), abs.input()), builder.connect(abs.output(), x.input());
  const Diagram diagram = builder.build();
  const double rtol = 1e-10, atol = 1e-10;
  const auto results = simulate(diagram, diagram.create_context(), {0.0, 100.0 * pi},
                                {.rtol = rtol, .atol = atol, .ode_solver_method = method});
  // A quadrature: errors add up, ten a half turn, of a state up to 200.
  within("integral of |sin|", method, std::abs(results.context.continuous_state()[0] - 200.0),
         100.0 * allowed(method, rtol, atol, 200.0));
}

TEST_CASE("a limited integral of a cosine stands still at its limits and turns at once", "[laws]") {
  const auto method = GENERATE(from_range(methods));
  DiagramBuilder builder;
  auto& cosine = builder.add<Sine>("cosine", SineOptions{.phase = 0.5 * pi});
  auto& x = builder.add<Integrator>(
      "x", Integrator::Options{.enable_limits = true, .lower_limit = -0.5, .upper_limit = 0.5});
  builder.connect(cosine.output(), x.input());
  const Diagram diagram = builder.build();
  const double rtol = 1e-9, atol = 1e-11;
  // Up to 0.5 at asin(0.5); stands until pi/2; down by 1 - sin t until it has lost 1, at pi; and so
  // on.
  for (const auto& [t, expected] :
       {std::pair{1.0, 0.5}, std::pair{2.0, 0.5 + std::sin(2.0) - 1.0}, std::pair{4.0, -0.5},
        std::pair{6.0, -0.5 + std::sin(6.0) + 1.0}, std::pair{8.0 * pi + 1.0, 0.5},
        std::pair{8.0 * pi + 2.0, 0.5 + std::sin(2.0) - 1.0}}) {
    const auto results = simulate(diagram, diagram.create_context(), {0.0, t},
                                  {.rtol = rtol, .atol = atol, .ode_solver_method = method});
    // From the last limit on there is one piece: what was before is forgotten.
    within("limited integral", method, std::abs(results.context.continuous_state()[0] - expected),
           2.0 * allowed(method, rtol, atol, 0.5));
  }
}
