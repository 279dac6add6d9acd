// FoundRoot: the records of the guards after a root, of those that crossed and of those beside it.
#include "saltus/solver/detail/found_root.hpp"

#include <functional>

#include "support/leaves.hpp"

using namespace saltus;
using namespace support;

namespace {

using Function = std::function<double(double)>;

/// Guards with resets, which fire when they fall through zero.
Leaf leaf_of(const std::vector<Function>& functions) {
  return Leaf("leaf", [&](Leaf& l) {
    declare_ramp(l);
    for (std::size_t k = 0; k < functions.size(); ++k) {
      const Function& g = functions[k];
      l.declare_zero_crossing({.name = text("g", k),
                               .guard = [g](const At& at) { return g(at.x[0]); },
                               .reset_map = [](const At&, Next&) {},
                               .direction = Direction::positive_then_non_positive});
    }
  });
}

struct Parts {
  explicit Parts(const std::vector<Function>& functions) : leaf(leaf_of(functions)) {
    machine.load(leaf.create_context());
    guards.select(machine.seen_guards().groups(), machine.plan());
  }
  Leaf leaf;
  Machine machine{compile(leaf)};
  GuardSet guards{machine.plan()};
};

/// Narrows [0, 1] to its root, and takes it.
class Root : private FoundRoot {
 public:
  explicit Root(Parts& parts)
      : FoundRoot(parts.machine, parts.guards, parts.guards.active().stopping) {
    const auto at = [](double u, double* x) { x[0] = u; };
    look(0.0, nullptr, at, low_);
    for (std::size_t k = 0; k < guards_->all().size(); ++k) {
      guards_->arm(k, sign_of(low_[k]));
      guards_->g[k] = low_[k];
    }
    look_up_guards();
    look(1.0, nullptr, at, high_);
    third_at_ = never;
    REQUIRE(note_crossed(high_));
    REQUIRE(take(narrow(0.0, 1.0, at).high));
  }
};

/// The guards beside the root of u = 1/3 among those whose roots are `bracket` widths later.
std::vector<std::size_t> beside(const std::vector<double>& later) {
  std::vector<Function> functions{[](double u) { return 1.0 / 3.0 - u; }};
  for (const double by : later)
    functions.push_back([=](double u) { return (1.0 / 3.0 - u) + by * 0x1p-54; });
  Parts parts(functions);
  Root root(parts);
  REQUIRE(parts.guards.fired_at_root.size() == 1);
  return {parts.guards.beside_root.begin(), parts.guards.beside_root.end()};
}

}  // namespace

TEST_CASE("a guard whose root is a few roundings later is beside the root", "[found_root]") {
  // A rounding of 1/3 is 2^-54, and the bracket of its root two of them.
  CHECK(beside({2.0}) == std::vector<std::size_t>{1});
  CHECK(beside({2.0, 4.0, 100.0, 1e6}) == std::vector<std::size_t>{1, 2});
  CHECK(beside({1e3}).empty());
}
