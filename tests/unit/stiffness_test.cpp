// Stiffness: two signs in the values of a step, and how many such steps in a row are enough.
#include "saltus/solver/detail/stiffness.hpp"

#include "support/leaves.hpp"

using namespace saltus;
using namespace support;

namespace {

/// Steps of one state as they would come from a method whose stability ends at 3.
class Steps {
 public:
  explicit Steps(double rtol = 1e-6)
      : test_({3.0, 0.9, 1200.0}, 6.0, {.rtol = rtol, .atol = rtol}) {}

  /// A step with this h |lambda|, in which the derivative turns by this part of itself.
  void see(double reach, double turn, double distance = 1e-3) {
    const double x1 = 1.0, x = x1 - distance, f1 = 1.0, f = f1 - reach * distance, f0 = f1 - turn;
    test_.look(1.0, view(x1), view(x), view(f), view(f0), view(f1));
  }
  void see(int times, double reach, double turn) {
    for (int i = 0; i < times; ++i) see(reach, turn);
  }
  bool detected() const { return test_.detected(); }
  bool may_oscillate() const { return test_.may_oscillate(); }
  void put_off(int times) { test_.put_off(times); }
  void forget() { test_.forget(true); }

 private:
  static VectorView view(const double& value) { return {&value, 1}; }
  StiffnessTest test_;
};

/// Whether fifteen such steps are called stiff.
bool stiff(double reach, double turn, double rtol = 1e-6) {
  Steps steps(rtol);
  steps.see(15, reach, turn);
  return steps.detected();
}

}  // namespace

TEST_CASE("steps at the end of the stability are stiff, whatever the solution does",
          "[stiffness]") {
  CHECK(stiff(3.01, 0.0));
  CHECK(stiff(3.01, 10.0));
  CHECK(!stiff(2.99, 10.0));
}

TEST_CASE("shorter steps are stiff where the solution is smooth and the Jacobian large",
          "[stiffness]") {
  // BDF's step is 0.4 rtol^(1/6) / r, at 1.5 calls, and half of our 6 calls are enough: r < 0.08.
  CHECK(stiff(2.0, 0.07));
  CHECK(!stiff(2.0, 0.09));
  CHECK(stiff(0.4, 0.03));
  CHECK(!stiff(0.4, 0.05));        // not ten times less than h |lambda|
  CHECK(!stiff(0.2, 1e-6));        // h |lambda| below a quarter bounds nothing
  CHECK(!stiff(2.0, 0.07, 1e-9));  // a tighter tolerance makes BDF's steps shorter
}

TEST_CASE("fifteen stiff steps are needed, and six others in a row end the count", "[stiffness]") {
  Steps steps;
  steps.see(14, 4.0, 0.0);
  CHECK(!steps.detected());
  steps.see(5, 1.0, 1.0);
  steps.see(1, 4.0, 0.0);
  CHECK(steps.detected());
  steps.forget();
  CHECK(!steps.detected());
  steps.see(14, 4.0, 0.0);
  steps.see(6, 1.0, 1.0);
  steps.see(14, 4.0, 0.0);
  CHECK(!steps.detected());
  steps.see(1, 4.0, 0.0);
  CHECK(steps.detected());
}

TEST_CASE("a step whose two approximations agree to the last bit tells nothing", "[stiffness]") {
  Steps steps;
  for (int i = 0; i < 100; ++i) steps.see(4.0, 0.0, 0.0);
  CHECK(!steps.detected());
}

TEST_CASE("a question whose answer was no comes later each time, up to 100 000 steps",
          "[stiffness]") {
  Steps steps;
  steps.see(15, 1.0, 1.0);  // at the bound of the imaginary axis, 0.9
  CHECK(steps.may_oscillate());
  steps.put_off(2);
  steps.see(29, 1.0, 1.0);
  CHECK(!steps.may_oscillate());
  steps.see(1, 1.0, 1.0);
  CHECK(steps.may_oscillate());
  for (int no = 0; no < 20; ++no) steps.put_off(4);
  steps.see(99999, 1.0, 1.0);
  CHECK(!steps.may_oscillate());
  steps.see(1, 1.0, 1.0);
  CHECK(steps.may_oscillate());
}
