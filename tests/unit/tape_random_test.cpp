// 200 expressions drawn at random: values to the last bit, Jacobians against complex steps and
// central differences, and nothing where the Jacobian has no entry.
#include <cmath>
#include <map>
#include <random>

#include "saltus/tape/jacobian.hpp"
#include "support/catch.hpp"
#include "support/expressions.hpp"
#include "support/tape_world.hpp"

using namespace saltus::tape;
using namespace support;

namespace {

constexpr unsigned expressions = 200;
using Entries = std::map<std::pair<std::size_t, std::size_t>, double>;

std::vector<double> random_point(std::size_t n, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<double> x(n);
  for (double& value : x) value = std::uniform_real_distribution<double>(-2.0, 2.0)(random);
  return x;
}

Entries entries_at(const Jacobian& jacobian, const std::vector<double>& x) {
  const auto values = values_of(jacobian.values, {.x = x});
  Entries all;
  for (std::size_t k = 0; k < values.size(); ++k) {
    const auto& entry = jacobian.entries[k];
    all[{static_cast<std::size_t>(entry.row), static_cast<std::size_t>(entry.column)}] = values[k];
  }
  return all;
}

/// Exact but for rounding: the step of 1e-200 squared is no number.
std::vector<double> complex_step(const RandomExpression& e, const std::vector<double>& x,
                                 std::size_t column) {
  std::vector<std::complex<double>> z(x.begin(), x.end());
  z[column].imag(1e-200);
  std::vector<double> slopes;
  for (const auto& value : evaluate(e, z)) slopes.push_back(value.imag() / 1e-200);
  return slopes;
}

struct Estimate {
  double slope = 0.0, error = 0.0;
};

/// Central differences in long double of steps h and 2h. Their distance is three times the error of
/// the first that is due to h, which is taken for the error; what is due to rounding is 2^-63 of
/// the size of the numbers in between, below 1e3, divided by h.
std::vector<Estimate> central(const RandomExpression& e, const std::vector<double>& x,
                              std::size_t column) {
  const auto difference = [&](long double h) {
    std::vector<long double> left(x.begin(), x.end()), right = left;
    left[column] -= h;
    right[column] += h;
    auto slopes = evaluate(e, right);
    const auto others = evaluate(e, left);
    for (std::size_t i = 0; i < slopes.size(); ++i)
      slopes[i] = (slopes[i] - others[i]) / (2.0L * h);
    return slopes;
  };
  const long double h = 1e-5L;
  const auto one = difference(h), two = difference(2.0L * h);
  std::vector<Estimate> all;
  for (std::size_t i = 0; i < one.size(); ++i) {
    all.push_back({static_cast<double>(one[i]),
                   static_cast<double>(std::fabs(one[i] - two[i]) + 1e3L * 0x1p-63L / h)});
  }
  return all;
}

/// What the rounding of about 60 operations, each growing the error by up to 100, leaves of 16
/// digits. A wrong derivative is wrong in its first digits.
double rounding(double slope) { return 1e-11 * std::max(1.0, std::fabs(slope)); }

void check_entry(const Entries& found, std::size_t row, std::size_t column, Estimate expected) {
  const auto entry = found.find({row, column});
  INFO("entry " << row << ", " << column);
  const double value = entry == found.end() ? 0.0 : entry->second;
  CHECK(std::fabs(value - expected.slope) <= expected.error + rounding(expected.slope));
}

}  // namespace

TEST_CASE("200 random expressions have the values <cmath> gives, to the last bit", "[tape]") {
  for (unsigned seed = 0; seed < expressions; ++seed) {
    const RandomExpression e = random_expression(seed);
    Graph graph;
    const Tape tape(graph, write(e, graph));
    for (unsigned point = 0; point < 5; ++point) {
      const auto x = random_point(e.variables, 1000 * seed + point);
      const auto found = values_of(tape, {.x = x}), expected = evaluate(e, x);
      INFO("seed " << seed << "\n" << tape.to_string());
      for (std::size_t i = 0; i < found.size(); ++i) {
        REQUIRE(std::isfinite(expected[i]));
        CHECK(same_bits(found[i], expected[i]));
      }
    }
  }
}

TEST_CASE("200 random Jacobians agree with complex steps or central differences", "[tape]") {
  int analytic = 0, listed = 0, absent = 0;
  for (unsigned seed = 0; seed < expressions; ++seed) {
    const RandomExpression e = random_expression(seed);
    Graph graph;
    const Tape tape(graph, write(e, graph));
    const Jacobian exact = jacobian(tape);
    analytic += e.analytic ? 1 : 0;
    listed += static_cast<int>(exact.entries.size());
    absent += static_cast<int>(e.variables * e.outputs.size() - exact.entries.size());
    for (unsigned point = 0; point < 5; ++point) {
      const auto x = random_point(e.variables, 1000 * seed + point);
      const Entries found = entries_at(exact, x);
      INFO("seed " << seed << ", point " << point << "\n" << tape.to_string());
      for (std::size_t j = 0; j < e.variables; ++j) {
        std::vector<Estimate> expected;
        if (e.analytic) {
          for (const double slope : complex_step(e, x, j)) expected.push_back({slope, 0.0});
        } else {
          expected = central(e, x, j);
        }
        for (std::size_t i = 0; i < expected.size(); ++i) check_entry(found, i, j, expected[i]);
      }
    }
  }
  CHECK(analytic > 80);  // both ways are really used, and both kinds of entry are there
  CHECK(analytic < 120);
  CHECK(listed > 500);
  CHECK(absent > 500);
}

TEST_CASE("an entry that is not listed has no influence on a smooth expression", "[tape]") {
  for (unsigned seed = 0; seed < expressions; ++seed) {
    const RandomExpression e = random_expression(seed);
    if (!e.analytic) continue;
    Graph graph;
    const Jacobian exact = jacobian(Tape(graph, write(e, graph)));
    const auto x = random_point(e.variables, seed);
    const Entries found = entries_at(exact, x);
    for (std::size_t j = 0; j < e.variables; ++j) {
      const auto slopes = complex_step(e, x, j);
      for (std::size_t i = 0; i < slopes.size(); ++i) {
        INFO("seed " << seed << ", entry " << i << ", " << j);
        if (!found.contains({i, j})) CHECK(slopes[i] == 0.0);
      }
    }
  }
}
