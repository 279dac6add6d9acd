// RandomNumber, WhiteNoise: known answers, moments, and the same numbers in any run.
#include <cmath>

#include "library_runs.hpp"
#include "saltus/base/philox.hpp"

using namespace saltus;
using namespace library_test;
using Catch::Matchers::WithinAbs;

namespace {

constexpr int many = 20000;

/// The numbers of ticks 0, 1, ... of a block with dt = 1.
template <class Block>
std::vector<double> drawn(const typename Block::Options& options, int n = many) {
  Bench<Block> bench({}, 1.0, options);
  std::vector<double> numbers;
  for (int k = 0; k < n; ++k) numbers.push_back(bench.output(0, k)[0]);
  return numbers;
}

/// The mean of f over numbers.
template <class F>
double mean(const std::vector<double>& numbers, F f) {
  double sum = 0.0;
  for (const double each : numbers) sum += f(each);
  return sum / static_cast<double>(numbers.size());
}

}  // namespace

/// The answers that the authors publish with their code, Random123, in kat_vectors.
TEST_CASE("philox gives the published words", "[library][noise]") {
  using detail::philox, detail::Words;
  CHECK(philox({0, 0, 0, 0}, {0, 0}) == Words{0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8});
  const std::uint32_t ones = 0xffffffff;
  CHECK(philox({ones, ones, ones, ones}, {ones, ones}) ==
        Words{0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd});
  CHECK(philox({0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344}, {0xa4093822, 0x299f31d0}) ==
        Words{0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1});
}

/// Five standard errors of each mean; the variances of x, x^2 and x^4 are 1, 2 and 96.
TEST_CASE("normal numbers have the moments 0, 1 and 3", "[library][noise]") {
  const auto x = drawn<RandomNumber>({.seed = 3.0});
  const double error = 5.0 / std::sqrt(many);
  CHECK_THAT(mean(x, [](double v) { return v; }), WithinAbs(0.0, error));
  CHECK_THAT(mean(x, [](double v) { return v * v; }), WithinAbs(1.0, error * std::sqrt(2.0)));
  CHECK_THAT(mean(x, [](double v) { return v * v * v * v; }),
             WithinAbs(3.0, error * std::sqrt(96.0)));
}

/// Five standard errors: the variance of x is 1/12 of the square of the range, that of the share
/// below a quarter 3/16.
TEST_CASE("uniform numbers fill their range evenly", "[library][noise]") {
  const auto x =
      drawn<RandomNumber>({.distribution = "uniform", .lower_limit = 2.0, .upper_limit = 6.0});
  const double error = 5.0 / std::sqrt(many);
  CHECK_THAT(mean(x, [](double v) { return v; }), WithinAbs(4.0, error * 4.0 / std::sqrt(12.0)));
  CHECK_THAT(mean(x, [](double v) { return v < 3.0 ? 1.0 : 0.0; }),
             WithinAbs(0.25, error * std::sqrt(3.0 / 16.0)));
  CHECK(std::ranges::all_of(x, [](double v) { return v > 2.0 && v < 6.0; }));
}

/// Of neighbours in time, and of two seeds: the product of independent numbers has the variance 1.
TEST_CASE("random numbers are independent", "[library][noise]") {
  const auto a = drawn<RandomNumber>({.seed = 1.0}), b = drawn<RandomNumber>({.seed = 2.0});
  double neighbours = 0.0, seeds = 0.0;
  for (std::size_t k = 1; k < a.size(); ++k) neighbours += a[k] * a[k - 1], seeds += a[k] * b[k];
  CHECK_THAT(neighbours / many, WithinAbs(0.0, 5.0 / std::sqrt(many)));
  CHECK_THAT(seeds / many, WithinAbs(0.0, 5.0 / std::sqrt(many)));
}

TEST_CASE("the entries of a vector of random numbers differ", "[library][noise]") {
  Bench<RandomNumber> bench({}, 1.0, RandomNumber::Options{.mean = {0.0, 0.0, 100.0}});
  const Numbers y = bench.output();
  CHECK(y[0] != y[1]);
  CHECK(y[2] > 90.0);
  CHECK(bench.node().rate == Rate::held);
}

/// The integral of noise is a random walk: its variance after 100 s, over 400 seeds. The mean of n
/// squares of normal numbers has the standard error sqrt(2 / n).
TEST_CASE("the integral of white noise has the variance power t", "[library][noise]") {
  const int n = 400;
  double sum = 0.0;
  for (int seed = 0; seed < n; ++seed) {
    const auto y = drawn<WhiteNoise>({.power = 0.5, .seed = static_cast<double>(seed)}, 100);
    const double walk = mean(y, [](double v) { return v; }) * 100.0;
    sum += walk * walk / 50.0;
  }
  CHECK_THAT(sum / n, WithinAbs(1.0, 5.0 * std::sqrt(2.0 / n)));
}

TEST_CASE("white noise of a quarter of the period has twice the deviation", "[library][noise]") {
  Bench<WhiteNoise> slow({}, 1.0), fast({}, 0.25);
  CHECK(fast.output(0, 0.0)[0] == 2.0 * slow.output(0, 0.0)[0]);
}

/// Noise through an integrator, in one run and in two, of which the second begins between ticks.
TEST_CASE("a run that is resumed has the same numbers", "[library][noise]") {
  DiagramBuilder builder;
  auto& noise = builder.add<RandomNumber>("noise", 0.1, RandomNumber::Options{.seed = 5.0});
  auto& kept = builder.add<DelayN>("kept", 0.1, 30);
  builder.connect(noise.output(), kept.input());
  const Diagram diagram = builder.build();
  const auto whole = simulate(diagram, diagram.create_context(), {0.0, 5.0}, precise());
  const auto half = simulate(diagram, diagram.create_context(), {0.0, 2.55}, precise());
  const auto rest = simulate(diagram, half.context, {2.55, 5.0}, precise());
  CHECK(whole.context.discrete_state() == rest.context.discrete_state());
}

TEST_CASE("a context may choose the seed", "[library][noise]") {
  DiagramBuilder builder;
  auto& noise = builder.add<RandomNumber>("noise", 1.0);
  auto& kept = builder.add<RateTransition>("kept", 1.0);
  builder.connect(noise.output(), kept.input());
  const Diagram diagram = builder.build();
  const auto with = [&](double seed) {
    const auto context = diagram.create_context().with_parameter("noise.seed", seed);
    return simulate(diagram, context, {0.0, 3.0}, precise()).context.discrete_state()[1];
  };
  CHECK(with(1.0) != with(2.0));
  CHECK(with(1.0) == drawn<RandomNumber>({.seed = 1.0}, 4)[3]);
}

TEST_CASE("random numbers that are none are refused", "[library][noise]") {
  const auto made = [](const RandomNumber::Options& options) {
    return model_error([&] { RandomNumber("n", 1.0, options); });
  };
  CHECK(contains(made({.distribution = "gaussian"}), "unknown distribution 'gaussian'"));
  CHECK(contains(made({.standard_deviation = -1.0}), "standard_deviation = -1"));
  CHECK(contains(made({.distribution = "uniform", .lower_limit = 2.0}), "lower_limit 2 is above"));
  CHECK(contains(made({.seed = HUGE_VAL}), "seed = inf"));
  CHECK(contains(model_error([] { WhiteNoise("n", 0.0); }), "dt = 0 s"));
  CHECK(contains(model_error([] { WhiteNoise("n", 1.0, {.power = -1.0}); }), "power = -1"));
}
