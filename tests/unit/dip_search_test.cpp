// DipSearch: where three looks at a guard say that it may have been below zero between them.
#include "saltus/solver/detail/dip_search.hpp"

#include <functional>

#include "support/leaves.hpp"

using namespace saltus;
using namespace support;
using Catch::Matchers::WithinAbs;

namespace {

using Function = std::function<double(double)>;

Leaf watched(const Function& g) {
  return Leaf("leaf", [&](Leaf& l) {
    declare_ramp(l);
    l.declare_zero_crossing({.name = "g", .guard = [g](const At& at) { return g(at.x[0]); }});
  });
}

struct Parts {
  explicit Parts(const Function& g) : leaf(watched(g)) {
    machine.load(leaf.create_context());
    guards.select(machine.seen_guards().groups(), machine.plan());
  }
  Leaf leaf;
  Machine machine{compile(leaf)};
  GuardSet guards{machine.plan()};
};

/// The search after looks at u = 0, 1/2 and 1, all on the side of the first.
class Search : private DipSearch {
 public:
  explicit Search(Parts& parts)
      : DipSearch(parts.machine, parts.guards, parts.guards.active().monitors) {
    scan_points_ = 1;
  }
  /// The offset of the dip; infinite if there is none.
  double find() {
    const auto at = [](double u, double* x) { x[0] = u; };
    look(0.0, nullptr, at, earlier_);
    look(0.5, nullptr, at, middle_);
    look(1.0, nullptr, at, high_);
    guards_->arm(0, sign_of(earlier_[0]));
    guards_->g[0] = middle_[0];
    earlier_at_ = 0.0;
    look_up_guards();
    const auto before = machine_->guard_calls;
    double from = 0.5;
    const double dip = next_dip(from, 1.0, at);
    looks = machine_->guard_calls - before;
    return dip;
  }
  std::int64_t looks = 0;
};

struct Found {
  double u;
  std::int64_t looks;
  bool any() const { return std::isfinite(u); }
};
Found find(const Function& g) {
  Parts parts(g);
  Search search(parts);
  const double u = search.find();
  return {u, search.looks};
}

/// A valley around 0.7.
Function parabola(double depth) {
  return [=](double u) { return (u - 0.7) * (u - 0.7) - depth; };
}

}  // namespace

TEST_CASE("a parabola that crosses zero and comes back is found in one look", "[dip_search]") {
  const double sign = GENERATE(1.0, -1.0), size = GENERATE(1e-200, 1.0, 1e200);
  for (const double depth : {0.03, 1e-4, 1e-8}) {
    const Found found = find([=](double u) { return sign * size * parabola(depth)(u); });
    CHECK_THAT(found.u, WithinAbs(0.7, 1e-9));
    CHECK(found.looks == 1);
  }
}

TEST_CASE("a touch within the rounding of the looks is no dip", "[dip_search]") {
  // The largest look is 0.49, and is known to a few eps of it.
  CHECK_FALSE(find(parabola(0.0)).any());
  CHECK_FALSE(find(parabola(1e-13)).any());
  CHECK(find(parabola(1e-11)).any());
}

TEST_CASE("a valley that stays far above zero costs no look", "[dip_search]") {
  CHECK(find(parabola(-0.3)).looks == 0);
  CHECK(find([](double u) { return 2.0 - u; }).looks == 0);
  CHECK(find([](double u) { return 1.0 + u * (1.0 - u); }).looks == 0);
}

TEST_CASE("a dip with steep sides is found, though the parabola is far above it", "[dip_search]") {
  // Its vertex is at 0.18 of the largest look.
  const Found found = find([](double u) { return std::abs(u - 0.7) - 0.05; });
  CHECK(found.any());
  CHECK(found.looks == 1);
}

TEST_CASE("a dip that takes three places is found", "[dip_search]") {
  // A hyperbola, straight on both sides. Two of the looks are beside others, for the slope.
  const auto found = find([](double u) { return std::hypot(1.0, 8.0 * (u - 0.6)) - 1.001; });
  CHECK(found.any());
  CHECK(found.looks <= 7);
}

TEST_CASE("a valley that comes no nearer to zero is given up after two places", "[dip_search]") {
  const double above = GENERATE(0.01, 0.1);
  const Found found = find([=](double u) { return std::cosh(6.0 * (u - 0.63)) - 1.0 + above; });
  CHECK_FALSE(found.any());
  CHECK(found.looks <= 4);
}
