// A Jacobian by compressed differences and by the user: the dense one, entry by entry.
#include "saltus/solver/detail/jacobian.hpp"

#include "support/entries.hpp"
#include "support/leaves.hpp"

using namespace saltus;
using namespace support;

namespace {

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

TEST_CASE("a difference at a state of zero exceeds the rounding of f, and not its bend",
          "[jacobian]") {
  // f = C + x + b x^2 at x = 0, where a stiff step has h = 1. A change of f by 1e3 eps C has three
  // digits, and b is such that it bends by 1e-3 over that change.
  for (const double c : {1.0, 3.0, 7.7, 123.0}) {
    const double b = 1e-3 / (1e3 * eps * c);
    const auto slope = [&](double bend) {
      const Leaf leaf("leaf", [&](Leaf& l) {
        l.declare_continuous_state(
            {.initial = vec({0.0}), .ode = [=](const At& at, VectorRef xdot) {
               xdot[0] = c + at.x[0] + bend * at.x[0] * at.x[0];
             }});
      });
      Machine machine(compile(leaf));
      machine.load(leaf.create_context());
      Jacobian jacobian(machine);
      double xdot = 0.0, value = 0.0;
      machine.flow(0.0, machine.x.data(), &xdot);
      REQUIRE(
          jacobian(0.0, machine.x.data(), &xdot, {.rtol = 1e-6, .atol = 1e-8, .h = 1.0}, &value));
      return value;
    };
    INFO("f(0) = " << c);
    CHECK(std::abs(slope(0.0) - 1.0) < 4e-3);
    CHECK(std::abs(slope(b) - 1.0) < 1e-2);
  }
}
