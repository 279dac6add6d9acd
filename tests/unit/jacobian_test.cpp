// Colours that never meet, differences that are the dense ones, orders that are permutations.
#include "saltus/solver/detail/jacobian.hpp"

#include <random>

#include "saltus/solver/detail/ordering.hpp"
#include "support/leaves.hpp"

using namespace saltus;
using namespace support;

namespace {

/// About `per_column` places in each column of an n by n matrix, and the diagonal.
std::vector<MatrixEntry> random_entries(Index n, int per_column, std::mt19937& random) {
  std::vector<std::vector<char>> taken(static_cast<std::size_t>(n),
                                       std::vector<char>(static_cast<std::size_t>(n)));
  std::vector<MatrixEntry> entries;
  std::uniform_int_distribution<Index> any(0, n - 1);
  for (Index j = 0; j < n; ++j) {
    for (int k = 0; k <= per_column; ++k) {
      const Index i = k == 0 ? j : any(random);
      if (std::exchange(taken[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)], 1))
        continue;
      entries.push_back({i, j});
    }
  }
  std::ranges::shuffle(entries, random);
  return entries;
}

/// xdot_i = sum over the entries of row i of sin((1 + i) x_j), smooth and different everywhere.
Leaf sum_of_sines(Index n, const std::vector<MatrixEntry>& entries) {
  return Leaf("leaf", [&](Leaf& l) {
    l.declare_continuous_state({.initial = Eigen::VectorXd::LinSpaced(n, 0.5, 2.0),
                                .ode =
                                    [entries](const At& at, VectorRef xdot) {
                                      xdot.setZero();
                                      for (const auto& [i, j] : entries)
                                        xdot[i] += std::sin(static_cast<double>(1 + i) * at.x[j]);
                                    },
                                .sparsity = entries});
  });
}

struct Evaluated {
  Eigen::MatrixXd matrix;
  Index colours = 0;
  std::int64_t calls = 0;
};

Evaluated evaluate(const Leaf& leaf) {
  Machine machine(compile(leaf));
  machine.load(leaf.create_context());
  const Index n = machine.plan().nx;
  Jacobian jacobian(machine);
  Eigen::VectorXd xdot(n), values = Eigen::VectorXd::Zero(jacobian.pattern().places.size());
  machine.flow(0.0, machine.x.data(), xdot.data());
  const auto before = machine.rhs_calls;
  REQUIRE(jacobian(0.0, machine.x.data(), xdot.data(), {.rtol = 1e-6, .atol = 1e-8, .h = 1e-3},
                   values.data()));
  Evaluated result{Eigen::MatrixXd::Zero(n, n), jacobian.colours(), machine.rhs_calls - before};
  const Sparsity& places = jacobian.pattern().places;
  Index k = 0;
  for (Index j = 0; j < n; ++j)
    for (const int i : places.column(j)) result.matrix(i, j) = values[k++];
  return result;
}

}  // namespace

TEST_CASE("no two columns of a colour meet in a row", "[jacobian]") {
  std::mt19937 random(4711);
  for (int round = 0; round < 40; ++round) {
    const Index n = 2 + round;
    const Leaf leaf = sum_of_sines(n, random_entries(n, round % 5, random));
    const JacobianPattern pattern = jacobian_pattern(*compile(leaf));
    const Colouring colouring = colour(pattern);
    CHECK(colouring.columns.size() == static_cast<std::size_t>(n));
    for (Index c = 0; c < colouring.colours(); ++c) {
      std::vector<int> met(static_cast<std::size_t>(n));
      for (const int j : colouring.of(c))
        for (const int i : pattern.places.column(j)) CHECK(++met[static_cast<std::size_t>(i)] == 1);
    }
  }
}

TEST_CASE("a band takes as many colours as it is wide", "[jacobian]") {
  for (const auto& [lower, upper] : {std::pair<Index, Index>{1, 1}, {2, 2}, {0, 3}, {4, 1}}) {
    const Leaf leaf = sum_of_sines(60, band_entries(60, lower, upper));
    CHECK(colour(jacobian_pattern(*compile(leaf))).colours() == lower + upper + 1);
  }
}

TEST_CASE("compressed differences are the derivatives", "[jacobian]") {
  std::mt19937 random(42);
  for (const Index n : {3, 10, 40}) {
    const auto entries = random_entries(n, 2, random);
    const Leaf leaf = sum_of_sines(n, entries);
    const Evaluated found = evaluate(leaf);
    CHECK(found.calls == found.colours);
    const Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(n, 0.5, 2.0);
    Eigen::MatrixXd exact = Eigen::MatrixXd::Zero(n, n);
    for (const auto& [i, j] : entries) {
      const auto rate = static_cast<double>(1 + i);
      exact(i, j) = rate * std::cos(rate * x[j]);
    }
    // The increment is sqrt(eps) |x_j|: d = 7.4e-9 to 3e-8. A forward difference errs by d f'' / 2
    // with |f''| <= n^2, and by two roundings of f over d: of at most n terms, each off by eps
    // (1 + 2 n), the rounding of its argument.
    const auto size = static_cast<double>(n);
    const double eps = std::numeric_limits<double>::epsilon();
    const double bound = 1.5e-8 * size * size + 2.0 * size * eps * (1.0 + 2.0 * size) / 7.4e-9;
    CHECK((found.matrix - exact).cwiseAbs().maxCoeff() < bound);
  }
}

TEST_CASE("the user's values go where they belong, in any order", "[jacobian]") {
  std::mt19937 random(7);
  auto entries = random_entries(12, 3, random);
  const auto value = [](Index i, Index j) { return static_cast<double>(100 * i + j + 1); };
  const Leaf leaf("leaf", [&](Leaf& l) {
    l.declare_continuous_state(12, [](const At& at, VectorRef xdot) { xdot = at.x; });
    l.declare_sparse_jacobian(entries, [=](const At&, VectorRef out) {
      for (std::size_t k = 0; k < entries.size(); ++k)
        out[static_cast<Index>(k)] = value(entries[k].row, entries[k].column);
    });
  });
  const Evaluated found = evaluate(leaf);
  CHECK(found.colours == 0);
  CHECK(found.calls == 0);
  Eigen::MatrixXd expected = Eigen::MatrixXd::Zero(12, 12);
  for (const auto& [i, j] : entries) expected(i, j) = value(i, j);
  CHECK(found.matrix == expected);
}

TEST_CASE("reordering is a permutation and finds a hidden band", "[jacobian]") {
  std::mt19937 random(3);
  constexpr Index n = 200;
  std::vector<Index> shuffled(n);
  std::iota(shuffled.begin(), shuffled.end(), Index{0});
  std::ranges::shuffle(shuffled, random);
  std::vector<MatrixEntry> entries;
  for (const auto& [i, j] : band_entries(n, 1, 1))
    entries.push_back(
        {shuffled[static_cast<std::size_t>(i)], shuffled[static_cast<std::size_t>(j)]});
  const Leaf leaf = sum_of_sines(n, entries);
  const JacobianPattern pattern = jacobian_pattern(*compile(leaf));
  std::vector<int> position = reverse_cuthill_mckee(pattern.places);
  CHECK(bandwidth(pattern.places).total() > 100);
  CHECK(bandwidth(pattern.places, position).total() == 3);  // a path from one end
  std::ranges::sort(position);
  for (int i = 0; i < n; ++i) CHECK(position[static_cast<std::size_t>(i)] == i);
}

TEST_CASE("a Jacobian explains how f moves unless a place is missing", "[jacobian]") {
  constexpr Index n = 20;
  const Leaf leaf("leaf", [](Leaf& l) {  // x_i' = -x_i + 3 x_{i-1}^2
    l.declare_continuous_state({.initial = Eigen::VectorXd::LinSpaced(n, 0.5, 2.0),
                                .ode = [](const At& at, VectorRef xdot) {
                                  xdot = -at.x;
                                  xdot.tail(n - 1).array() +=
                                      3.0 * at.x.head(n - 1).array().square();
                                }});
  });
  Machine machine(compile(leaf));
  machine.load(leaf.create_context());
  Eigen::VectorXd xdot(n);
  machine.flow(0.0, machine.x.data(), xdot.data());
  const auto explains = [&](const std::vector<MatrixEntry>& entries, double h) {
    Jacobian jacobian(machine, {{0, entries}});
    Eigen::VectorXd values = Eigen::VectorXd::Zero(jacobian.pattern().places.size());
    const Increments by{.rtol = 1e-6, .atol = 1e-8, .h = h};
    REQUIRE(jacobian(0.0, machine.x.data(), xdot.data(), by, values.data()));
    return jacobian.explains(0.0, machine.x.data(), xdot.data(), by, values.data());
  };
  CHECK(explains(band_entries(n, 1, 0), 0.1));
  CHECK(explains(band_entries(n, n, n), 0.1));
  CHECK_FALSE(explains(band_entries(n, 0, 0), 0.1));
  std::vector<MatrixEntry> all_but_one = band_entries(n, 1, 0);
  std::erase_if(all_but_one, [](const MatrixEntry& e) { return e.row == 7 && e.column == 6; });
  CHECK_FALSE(explains(all_but_one, 0.1));
  CHECK(explains(all_but_one, 1e-6));  // too short a step for Newton's iteration to notice
}
