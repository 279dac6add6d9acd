// Power, SquareRoot, Exponent, Logarithm, Reciprocal, Trigonometric: values, widths, derivatives
// along a run, and what is refused.
#include <cmath>
#include <numbers>

#include "library_runs.hpp"
#include "saltus/library/exponent.hpp"
#include "saltus/library/logarithm.hpp"
#include "saltus/library/power.hpp"
#include "saltus/library/reciprocal.hpp"
#include "saltus/library/square_root.hpp"
#include "saltus/library/trigonometric.hpp"

using namespace saltus;
using namespace library_test;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

/// The block's output for one number.
template <class Block, class... Arguments>
double of(double u, Arguments&&... arguments) {
  return Bench<Block>({u}, std::forward<Arguments>(arguments)...).output()[0];
}

}  // namespace

TEST_CASE("Power has an exponent that is a number or a vector", "[library]") {
  CHECK(of<Power>(3.0, 2.0) == 9.0);
  CHECK(of<Power>(-2.0, 3.0) == -8.0);
  CHECK(Bench<Power>({2.0}, Value{1.0, -1.0, 0.5}).output() == Numbers{2.0, 0.5, std::sqrt(2.0)});
  CHECK(Bench<Power>({Value{1.0, 4.0}}, 0.5).output() == Numbers{1.0, 2.0});
}

TEST_CASE("roots, reciprocals, exponentials and logarithms have the values of <cmath>",
          "[library]") {
  const std::vector<Value> u{Value{0.25, 1.0, 7.0}};
  CHECK(Bench<SquareRoot>(u).output() == Numbers{0.5, 1.0, std::sqrt(7.0)});
  CHECK(Bench<Reciprocal>(u).output() == Numbers{4.0, 1.0, 1.0 / 7.0});
  CHECK(Bench<Exponent>(u).output() == Numbers{std::exp(0.25), std::exp(1.0), std::exp(7.0)});
  CHECK(Bench<Exponent>(u, "2").output() == Numbers{std::exp2(0.25), 2.0, 128.0});
  CHECK(of<Logarithm>(7.0) == std::log(7.0));
  CHECK(of<Logarithm>(1000.0, "10") == 3.0);
  CHECK(of<Logarithm>(1024.0, "2") == 10.0);
}

TEST_CASE("Trigonometric knows twelve functions", "[library]") {
  const std::vector<std::pair<const char*, double (*)(double)>> functions{
      {"sin", std::sin},   {"cos", std::cos},     {"tan", std::tan},     {"asin", std::asin},
      {"acos", std::acos}, {"atan", std::atan},   {"sinh", std::sinh},   {"cosh", std::cosh},
      {"tanh", std::tanh}, {"asinh", std::asinh}, {"acosh", std::acosh}, {"atanh", std::atanh}};
  for (const auto& [name, f] : functions) {
    const double u = std::string(name) == "acosh" ? 1.5 : 0.5;
    INFO(name);
    CHECK(of<Trigonometric>(u, name) == f(u));
  }
  CHECK(contains(model_error([] { Trigonometric("t", "sine"); }), "did you mean 'sin'"));
  CHECK(contains(model_error([] { Exponent("e", "10"); }), "unknown base '10'"));
  CHECK(contains(model_error([] { Logarithm("e", "e"); }), "Known: 'natural', '10', '2'"));
}

/// The values that a fused plan computes are those of a block that stands alone, to the last bit:
/// the integral of f(t) is the same with the block called by the solver and with a FunctionBlock.
TEST_CASE("the integral of a map of time is that of the function, to the last bit", "[library]") {
  const auto clock = [](DiagramBuilder& builder, auto& block) {
    builder.connect(builder.add<Clock>("clock").output(), block.input());
  };
  const auto same = [&](double found, double (*f)(double)) {
    CHECK(found == integral<FunctionBlock>(2.0, clock, f));
  };
  same(integral<Power>(2.0, clock, 2.7), [](double t) { return std::pow(t, 2.7); });
  same(integral<Exponent>(2.0, clock), [](double t) { return std::exp(t); });
  same(integral<Exponent>(2.0, clock, "2"), [](double t) { return std::exp2(t); });
  same(integral<Trigonometric>(2.0, clock, "asinh"), [](double t) { return std::asinh(t); });
  CHECK_THAT(integral<Power>(2.0, clock, 2.7), WithinRel(std::pow(2.0, 3.7) / 3.7, 1e-9));
}

TEST_CASE("a value outside the domain ends the run with the name of the block", "[library]") {
  const auto falls_through_zero = [](DiagramBuilder& builder, auto& block) {
    auto& ramp = builder.add<Ramp>(
        "ramp", Ramp::Options{.start_value = 1.0, .slope = -1.0, .start_time = 0.0});
    builder.connect(ramp.output(), block.input());
  };
  const auto message = [&](auto run) {
    try {
      run();
    } catch (const SimulationError& error) {
      return std::string(error.what());
    }
    return std::string("no error");
  };
  CHECK(contains(message([&] { integral<SquareRoot>(2.0, falls_through_zero); }), "block"));
  CHECK(contains(message([&] { integral<Logarithm>(2.0, falls_through_zero); }), "block"));
}
