// The spectral radius, found by moving the state: its order of magnitude, in any units.
#include "saltus/solver/detail/spectral_radius.hpp"

#include "support/leaves.hpp"

using namespace saltus;
using namespace support;

namespace {

const SolverOptions options{.rtol = 1e-6, .atol = 1e-12};

/// xdot = A x, or xdot = f(x), from x0.
struct Flow {
  Leaf leaf;
  Machine machine{compile(leaf)};
  SpectralRadius radius{machine, options};

  template <class Ode>
  Flow(const Eigen::VectorXd& x0, Ode ode)
      : leaf("leaf", [&](Leaf& l) { l.declare_continuous_state({.initial = x0, .ode = ode}); }) {
    machine.load(leaf.create_context());
  }
  double operator()() { return radius(0.0, machine.x); }
};

Flow linear(const Eigen::MatrixXd& a) {
  return {Eigen::VectorXd::Ones(a.rows()), [a](const At& at, VectorRef xdot) { xdot = a * at.x; }};
}

bool about(double found, double expected) {
  return found > 0.5 * expected && found < 2.0 * expected;
}

}  // namespace

TEST_CASE("the fastest of several decays is found", "[spectral_radius]") {
  for (const double fast : {1.0, 1e3, 1e9}) {
    INFO(fast);
    Flow flow = linear(vec({-1.0, -fast, -0.1 * fast}).asDiagonal());
    CHECK(about(flow(), fast));
    CHECK(about(flow(), fast));  // from the direction found
  }
}

TEST_CASE("an oscillation counts by its frequency", "[spectral_radius]") {
  Eigen::MatrixXd turn(2, 2);
  turn << 0.0, 50.0, -50.0, 0.0;
  CHECK(about(linear(turn)(), 50.0));
}

TEST_CASE("many oscillations of an elastic beam are seen, in angles and rates",
          "[spectral_radius]") {
  // x'' = -K x with K = m^4 D^2, D the second difference of a row of m points: frequencies up to
  // 4 m^2. J lengthens a vector of angles by m^4 and one of rates by 1.
  const Index m = GENERATE(4, 20, 60);
  const double damping = GENERATE(0.0, 0.01, 1.0);
  Eigen::MatrixXd d = -2.0 * Eigen::MatrixXd::Identity(m, m);
  d.diagonal(1).setOnes(), d.diagonal(-1).setOnes();
  const auto scale = static_cast<double>(m * m);
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(2 * m, 2 * m);
  a.topRightCorner(m, m).setIdentity();
  a.bottomLeftCorner(m, m) = -scale * scale * d * d;
  // Every mode has the damping ratio `damping`: x'' = -K x + 2 ratio sqrt(K) x', sqrt(K) = -m^2 D.
  a.bottomRightCorner(m, m) = 2.0 * damping * scale * d;
  INFO("m " << m << ", damping ratio " << damping);
  Flow flow = linear(a);
  CHECK(about(flow(), 4.0 * scale));
  CHECK((flow.radius.damping() < 0.3) == (damping < 0.3));
}

TEST_CASE("another unit of a state changes nothing", "[spectral_radius]") {
  // The same eigenvalues, -1 and -100, and a place off the diagonal that grows as the unit shrinks.
  const auto in_units = [](double unit) {
    return Flow(vec({1.0, unit}), [=](const At& at, VectorRef xdot) {
      xdot << -at.x[0] + 10.0 * at.x[1] / unit, -100.0 * at.x[1];
    })();
  };
  CHECK(about(in_units(1.0), 100.0));
  for (const double unit : {1e-6, 1e12}) CHECK(about(in_units(unit), 100.0));
}

TEST_CASE("nothing that moves has radius zero, what is not finite an infinite one",
          "[spectral_radius]") {
  CHECK(Flow(vec({1.0, 2.0}), [](const At&, VectorRef xdot) { xdot.setOnes(); })() == 0.0);
  Flow edge(vec({0.0}), [](const At& at) { return std::sqrt(-std::abs(at.x[0])); });
  CHECK(edge() == infinite);
}

TEST_CASE("what was forgotten leaves no trace, and an answer costs four calls",
          "[spectral_radius]") {
  const Eigen::MatrixXd a = vec({-1.0, -30.0, -2.0}).asDiagonal();
  Flow flow = linear(a);
  const double first = flow();
  CHECK(flow.machine.rhs_calls == 4);
  CHECK(flow() != first);
  flow.radius.forget();
  CHECK(flow() == first);
}
