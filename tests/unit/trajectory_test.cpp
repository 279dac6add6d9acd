// Trajectory: the polynomials that were given are read back, and nothing is between or beyond them.
#include "saltus/simulation/detail/trajectory.hpp"

#include "saltus/simulation/detail/contact.hpp"
#include "support/leaves.hpp"

using namespace saltus;
using namespace support;

namespace {

/// Two states that rest and one discrete state; a test adds the steps itself.
struct Steps {
  Leaf leaf{"leaf", [](Leaf& l) {
              l.declare_continuous_state({.initial = vec({0.0, 0.0})});
              l.declare_discrete_state(vec({0.0}));
            }};
  Machine machine{compile(leaf)};
  Contacts contacts{machine, {}};
  Trajectory trajectory;

  Steps() {
    const Context context = leaf.create_context();
    machine.load(context);
    trajectory.start(machine.shared_plan(), context, {});
  }
  /// The polynomials sum c_k t^k and their mirror image.
  static void polynomial(const std::vector<double>& c, double t, double* x) {
    x[0] = 0.0;
    for (std::size_t k = c.size(); k-- > 0;) x[0] = x[0] * t + c[k];
    x[1] = -x[0];
  }
  void open(double t, const std::vector<double>& c) {
    polynomial(c, t, machine.x.data());
    trajectory.open(t, machine, contacts);
  }
  void step(double from, double to, const std::vector<double>& c) {
    Eigen::VectorXd end(2);
    polynomial(c, from, end.data());
    trajectory.depart(end);
    polynomial(c, to, end.data());
    trajectory.add(from, to, static_cast<int>(c.size()) - 1, machine, contacts, end,
                   [&](double t, double* x) { polynomial(c, t, x); });
    machine.x = end;
  }
  void close(double t, bool whole = true) { trajectory.close(t, machine, contacts, whole); }

  Eigen::VectorXd at(double t, Side side = Side::right) const {
    Eigen::VectorXd x(2);
    trajectory.state(trajectory.spot(t, side), t, x.data());
    return x;
  }
  double z(double t, Side side = Side::right) const {
    return trajectory.held(trajectory.spot(t, side)).z[0];
  }
};

}  // namespace

TEST_CASE("a polynomial of every degree that a method has is read back", "[trajectory]") {
  const int degree = GENERATE(range(1, 13));
  std::vector<double> c;
  for (int k = 0; k <= degree; ++k) c.push_back((k % 2 == 0 ? 1.0 : -1.0) / (1.0 + k));
  Steps run;
  run.open(0.0, c), run.step(0.0, 1.5, c), run.close(1.5);
  for (double t = 0.0; t <= 1.5; t += 0.01) {
    Eigen::VectorXd expected(2);
    Steps::polynomial(c, t, expected.data());
    // The values are within (2 degree) eps of their terms, whose sizes sum to at most 1.5^13 / 0.5;
    // the formula amplifies that by the Lebesgue constant, below 3 for 13 points.
    const double tolerance = 3.0 * 2.0 * 13.0 * eps * std::pow(1.5, degree + 1) / 0.5;
    INFO("degree " << degree << ", t = " << t);
    CHECK((run.at(t) - expected).cwiseAbs().maxCoeff() <= tolerance);
  }
}

TEST_CASE("a constant state, and a state at an end of a step, are exact", "[trajectory]") {
  Steps run;
  const std::vector<double> still{0.1, 0.0, 0.0, 0.0}, moving{0.3, 1.0 / 3.0, 0.7};
  run.open(0.0, still), run.step(0.0, 0.7, still), run.step(0.7, 1.1, moving), run.close(1.1);
  for (double t = 0.0; t < 0.7; t += 0.013) CHECK(run.at(t)[0] == 0.1);
  Eigen::VectorXd joint(2), end(2);
  Steps::polynomial(moving, 0.7, joint.data()), Steps::polynomial(moving, 1.1, end.data());
  CHECK(run.at(0.7, Side::left)[0] == 0.1);
  CHECK(run.at(0.7, Side::right) == joint);
  CHECK(run.at(1.1, Side::left) == end);
  CHECK(run.at(1.1, Side::right) == end);
}

TEST_CASE("at a joint the left value is before the reset, the right one after it", "[trajectory]") {
  Steps run;
  run.open(0.0, {1.0, 1.0}), run.step(0.0, 1.0, {1.0, 1.0});
  run.machine.z[0] = 5.0, run.trajectory.instant();
  run.step(1.0, 2.0, {-10.0, 1.0}), run.close(2.0);
  CHECK(run.at(1.0, Side::left)[0] == 2.0);
  CHECK(run.at(1.0, Side::right)[0] == -9.0);
  CHECK(run.z(1.0, Side::left) == 0.0);
  CHECK(run.z(1.0, Side::right) == 5.0);
  CHECK(run.trajectory.joints() == std::vector{0.0, 1.0, 2.0});
}

TEST_CASE("a step begins with the state that the solver began with", "[trajectory]") {
  Steps run;
  run.open(0.0, {0.0, 1.0}), run.step(0.0, 1.0, {0.0, 1.0});
  // The interpolant of a multistep method differs slightly from the state at the joint.
  run.trajectory.depart(vec({1.0 + 1e-9, -1.0}));
  run.trajectory.add(1.0, 2.0, 1, run.machine, run.contacts, vec({2.0, -2.0}),
                     [](double t, double* x) { x[0] = t, x[1] = -t; });
  run.close(2.0);
  CHECK(run.at(1.0, Side::left)[0] == 1.0);
  CHECK(run.at(1.0, Side::right)[0] == 1.0 + 1e-9);
  CHECK(run.at(1.5)[0] == 1.5);
}

TEST_CASE("at the beginning and at the end an instant has both its values", "[trajectory]") {
  Steps run;
  run.open(0.0, {1.0});                              // before the instant at the beginning
  run.machine.z[0] = 1.0, run.trajectory.instant();  // which writes z and x
  run.step(0.0, 1.0, {2.0, 1.0});
  run.machine.z[0] = 2.0, run.trajectory.instant();
  run.machine.x = vec({7.0, -7.0}), run.close(1.0);  // likewise at the end
  CHECK(run.at(0.0, Side::left)[0] == 1.0);
  CHECK(run.at(0.0, Side::right)[0] == 2.0);
  CHECK(run.at(1.0, Side::left)[0] == 3.0);
  CHECK(run.at(1.0, Side::right)[0] == 7.0);
  CHECK(run.z(0.0, Side::left) == 0.0);
  CHECK(run.z(0.0, Side::right) == 1.0);
  CHECK(run.z(1.0, Side::left) == 1.0);
  CHECK(run.z(1.0, Side::right) == 2.0);
}

TEST_CASE("held values are kept once for all steps between two instants", "[trajectory]") {
  Steps run;
  run.open(0.0, {1.0});
  const auto held = [&](double t) {
    return &run.trajectory.held(run.trajectory.spot(t, Side::right));
  };
  for (int i = 0; i < 4; ++i) {
    if (i == 2) run.trajectory.instant();  // it changes nothing
    if (i == 3) run.machine.modes[0] = 1, run.trajectory.instant();
    run.step(i, i + 1.0, {1.0, 1.0});
  }
  run.close(4.0);
  CHECK(held(0.5) == held(1.5));
  CHECK(held(1.5) == held(2.5));
  CHECK(held(2.5) != held(3.5));
  CHECK(held(2.5)->modes[0] == 0);
  CHECK(held(3.5)->modes[0] == 1);
}

TEST_CASE("nothing is extrapolated, and the message says from when to when", "[trajectory]") {
  Steps run;
  run.open(1.0, {0.0, 1.0}), run.step(1.0, 2.0, {0.0, 1.0}), run.close(2.0);
  for (const double t : {std::nextafter(1.0, 0.0), std::nextafter(2.0, 3.0), not_a_number})
    CHECK_THROWS_AS(run.trajectory.spot(t, Side::left), ModelError);
  CHECK(message<ModelError>([&] { run.trajectory.spot(3.0, Side::left); }) ==
        "t = 3 s is outside the run, which went from 1 s to 2 s; dense output does not "
        "extrapolate");
}

TEST_CASE("after an instant that failed, the end is the end of the last step", "[trajectory]") {
  Steps run;
  run.open(0.0, {0.0, 1.0}), run.step(0.0, 1.0, {0.0, 1.0});
  run.machine.x = vec({99.0, 99.0}), run.machine.z[0] = 99.0, run.trajectory.instant();
  run.close(1.0, false);
  CHECK(run.trajectory.end() == 1.0);
  CHECK(run.at(1.0)[0] == 1.0);
  CHECK(run.z(1.0) == 0.0);
}

TEST_CASE("a run that failed at its beginning is the state it began with", "[trajectory]") {
  Steps run;
  run.open(0.5, {0.25});
  run.machine.x = vec({99.0, 99.0}), run.trajectory.instant();
  run.close(0.5, false);
  CHECK(run.trajectory.begin() == 0.5);
  CHECK(run.trajectory.end() == 0.5);
  CHECK(run.at(0.5)[0] == 0.25);
}

TEST_CASE("a step of no length is no piece", "[trajectory]") {
  Steps run;
  run.open(0.0, {0.0, 1.0}), run.step(0.0, 0.0, {0.0, 1.0}), run.step(0.0, 1.0, {0.0, 1.0});
  run.step(1.0, 1.0, {0.0, 1.0}), run.close(1.0);
  CHECK(run.trajectory.joints() == std::vector{0.0, 1.0});
}
