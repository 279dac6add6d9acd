// Narrower: the offset of a crossing is on the firing side, next to the crossing, found in few
// looks.
#include "saltus/solver/detail/narrow.hpp"

#include "support/leaves.hpp"

using namespace saltus;
using namespace support;

namespace {

using Function = std::function<double(double)>;

/// Guards g_k(u) that fall to zero in a step that begins at t = 0, each armed above zero.
class Crossings : private Narrower {
 public:
  static Leaf leaf(const std::vector<Function>& functions) {
    return Leaf("leaf", [&](Leaf& l) {
      declare_ramp(l);
      for (std::size_t k = 0; k < functions.size(); ++k) {
        const Function& g = functions[k];
        l.declare_zero_crossing(
            {.name = text("g", k), .guard = [g](const At& at) { return g(at.x[0]); }});
      }
    });
  }
  struct Parts {
    explicit Parts(const std::vector<Function>& functions)
        : declared(leaf(functions)), machine(compile(declared)), guards(machine.plan()) {
      machine.load(declared.create_context());
      guards.select(machine.seen_guards().groups(), machine.plan());
    }
    Leaf declared;
    Machine machine;
    GuardSet guards;
  };

  explicit Crossings(Parts& parts)
      : Narrower(parts.machine, parts.guards, parts.guards.active().monitors) {}

  /// Arms all guards by their values at `low`, and narrows [low, high].
  double find(double low, double high) {
    const auto at = [](double u, double* x) { x[0] = u; };
    look(low, nullptr, at, low_);
    for (std::size_t k = 0; k < guards_->all().size(); ++k) {
      if ((*guards_)[k].phase != Phase::waiting) guards_->arm(k, sign_of(low_[k]));
      guards_->g[k] = low_[k];
    }
    set_limits();
    look(high, nullptr, at, high_);
    third_at_ = std::numeric_limits<double>::infinity();
    REQUIRE(note_crossed(high_));
    const auto before = machine_->guard_calls;
    const double u = narrow(low, high, at).high;
    looks = machine_->guard_calls - before;
    crossed = crossed_;
    return u;
  }

  /// The error of a guard at the root, by the rounding of interpolants.
  double noise(std::size_t k) const { return noise_[k]; }

  std::int64_t looks = 0;
  std::vector<std::size_t> crossed;
};

struct Found {
  double u;
  std::int64_t looks;
  std::vector<std::size_t> crossed;
};
Found find(const std::vector<Function>& functions, double low = 0.0, double high = 1.0) {
  Crossings::Parts parts(functions);
  Crossings step(parts);
  const double u = step.find(low, high);
  return {u, step.looks, step.crossed};
}

struct Guarded {
  const char* name;
  Function g;
  double root;
  std::int64_t most_looks;
};

}  // namespace

TEST_CASE("the offset is on the firing side, within two roundings of the crossing", "[narrow]") {
  // Muller's method has order 1.84: eight looks from one digit to sixteen, and a look on either
  // side of the root. Two values of one size make a jump known: it takes one look a bit. Where no
  // estimate helps, 60 looks are followed by one a bit: at most 114.
  const auto shape = GENERATE(values<Guarded>({
      {"line", [](double u) { return 0.3 - u; }, 0.3, 5},
      {"steep line", [](double u) { return 1e200 * (0.3 - u); }, 0.3, 5},
      {"flat line", [](double u) { return 1e-200 * (0.3 - u); }, 0.3, 5},
      {"parabola", [](double u) { return 0.25 - u * u; }, 0.5, 10},
      {"exponential", [](double u) { return std::exp(-20.0 * u) - std::exp(-4.0); }, 0.2, 20},
      {"cubic with a flat root", [](double u) { return std::pow(0.3 - u, 3); }, 0.3, 114},
      {"fifth power, far root", [](double u) { return 0.9 - std::pow(u, 5); }, std::pow(0.9, 0.2),
       16},
      {"jump", [](double u) { return u < 0.3 ? 1.0 : -1.0; }, 0.3, 64},
      {"jump of very different sizes", [](double u) { return u < 0.3 ? 1e-12 : -1e12; }, 0.3, 114},
  }));
  INFO(shape.name);
  const Found found = find({shape.g});
  CHECK(shape.g(found.u) <= 0.0);
  // Two roundings of the bracket; the guard itself turns within one rounding of its root.
  CHECK(std::abs(found.u - shape.root) <= 4.0 * eps * shape.root);
  CHECK(found.looks <= shape.most_looks);
}

TEST_CASE("a root is located as finely near the beginning of a step as near its end", "[narrow]") {
  const double root = GENERATE(1e-12, 1e-6, 1e-3, 0.5, 1.0 - 1e-9);
  INFO("root " << root);
  const Found found = find({[=](double u) { return root - u; }});
  CHECK(found.u >= root);
  CHECK(found.u - root <= 4.0 * eps * root);
}

TEST_CASE("of several crossings the earliest is found, and only its guards have crossed",
          "[narrow]") {
  const Function a = [](double u) { return 0.7 - u; }, b = [](double u) { return 0.31 - u * u; },
                 c = [](double u) { return u < 0.4 ? 1.0 : -1.0; },
                 rising = [](double u) { return u - 0.4 - 1e-9; };
  CHECK(find({a, b, c, rising}).crossed == std::vector<std::size_t>{2});
  CHECK(find({rising, a}).crossed == std::vector<std::size_t>{0});
  CHECK(find({a, a}).crossed == std::vector<std::size_t>{0, 1});
  const Found many = find({a, b, c, rising});
  CHECK(many.u >= 0.4);
  CHECK(many.u - 0.4 <= 4.0 * eps);
}

TEST_CASE("a guard that rises fires where it is not negative any more", "[narrow]") {
  const Found found = find({[](double u) { return std::sin(u) - 0.5; }});
  CHECK(std::sin(found.u) >= 0.5);
  CHECK_THAT(found.u, Catch::Matchers::WithinAbs(std::asin(0.5), 4.0 * eps));
}

TEST_CASE("a plateau of exact zeros is found at its beginning", "[narrow]") {
  const Found found = find({[](double u) { return std::max(0.3 - u, 0.0); }});
  CHECK(found.u >= 0.3);
  CHECK(found.u - 0.3 <= 4.0 * eps);
}

TEST_CASE("a plateau that the rounding of a state makes costs looks by its length", "[narrow]") {
  // Zero for half a rounding of `offset` on either side of 0.3. That is 8^k brackets: k looks back
  // in growing steps, 3 k halvings of the last of them, and five for a line.
  const double offset = GENERATE(1.0, 1e3, 1e6, 1e9);
  INFO("offset " << offset);
  const Found found = find({[=](double u) { return (offset + 0.3) - (offset + u); }});
  CHECK((offset + 0.3) - (offset + found.u) == 0.0);
  CHECK(std::abs(found.u - 0.3) <= eps * offset);
  const double brackets = eps * (offset + 0.3) / (2.0 * eps * 0.3);
  CHECK(static_cast<double>(found.looks) <= 4.0 * (std::log2(brackets) / 3.0 + 1.0) + 5.0);
}

TEST_CASE("where few of many guards cross, only they are looked at on the way", "[narrow]") {
  // At the low end, at the high end, and at both ends of the last bracket.
  int looks_at_others = 0;
  std::vector<Function> many(32, [&](double) { return ++looks_at_others, 1.0; });
  many[20] = [](double u) { return std::exp(-20.0 * u) - std::exp(-4.0); };
  const Found found = find(many);
  CHECK_THAT(found.u, Catch::Matchers::WithinAbs(0.2, 4.0 * eps));
  CHECK(found.crossed == std::vector<std::size_t>{20});
  CHECK(looks_at_others == 4 * 31);
}

TEST_CASE("a guard that is beyond zero at the root of few others is found before it", "[narrow]") {
  std::vector<Function> many(32, [](double) { return 1.0; });
  many[7] = [](double u) { return 0.3 - u; };
  many[25] = [](double u) { return std::abs(u - 0.3) - 0.01; };  // crosses at 0.29, and comes back
  const Found found = find(many);
  CHECK_THAT(found.u, Catch::Matchers::WithinAbs(0.29, 4.0 * eps));
  CHECK(found.crossed == std::vector<std::size_t>{25});
}

TEST_CASE("an exact root is found by one look just before it", "[narrow]") {
  const Found found = find({[](double u) { return 1.0 - u; }});
  CHECK(found.u == 1.0);
  CHECK(found.looks <= 2);
}

TEST_CASE("a value that is not finite counts as crossed, and is narrowed to its beginning",
          "[narrow]") {
  const double value = GENERATE(as<double>{}, not_a_number, infinite, -infinite);
  const Found found = find({[=](double u) { return u < 0.6 ? 1.0 : value; }});
  CHECK(found.u >= 0.6);
  CHECK(found.u - 0.6 <= 4.0 * eps);
}

TEST_CASE("a guard that waits at zero is armed by a look on its side, and then crosses",
          "[narrow]") {
  // It leaves zero upwards, and comes back at 0.8. Within 1e-3 it counts as zero.
  const Function arc = [](double u) { return u * (0.8 - u); };
  Crossings::Parts parts({arc});
  parts.guards.wait(0, 1, 1e-3);
  Crossings step(parts);
  const double u = step.find(0.0, 1.0);
  CHECK(parts.guards[0].phase == Phase::armed);
  CHECK(arc(u) <= 0.0);
  CHECK(u - 0.8 <= 4.0 * eps);
}

TEST_CASE("the noise of a smooth guard is some times its movement in a rounding of its root",
          "[narrow]") {
  const double slope = GENERATE(1e-200, 1.0, 1e200), root = GENERATE(1.0 / 3.0, 1e-3, 0.7);
  INFO("slope " << slope << ", root " << root);
  Crossings::Parts parts({[=](double u) { return slope * (root - u); }});
  Crossings step(parts);
  step.find(0.0, 1.0);
  CHECK(step.noise(0) > slope * eps * root);
  CHECK(step.noise(0) < slope * 16.0 * eps * root);
}

/// A guard that jumps has no noise. In an interval that is 1e9 to 1e5 times as long as the last bracket, a
/// jump is steeper there by this factor, a cube root by its power 2/3, a line by 1.
TEST_CASE("a jump is known in a short interval, too, and a steep root is none", "[narrow]") {
  const double length = GENERATE(1e-7, 1e-9, 1e-11), root = 0.5;
  INFO("length " << length);
  const auto noise = [&](const Function& g) {
    Crossings::Parts parts({g});
    Crossings step(parts);
    step.find(root - 0.6 * length, root + 0.4 * length);
    return step.noise(0);
  };
  CHECK(noise([=](double u) { return u < root ? 0.5 : -0.2; }) == 0.0);
  CHECK(noise([=](double u) { return u < root ? 0.5 - u : -0.2 - u; }) == 0.0);
  CHECK(noise([=](double u) { return 1e9 * (root + 1e-17 - u); }) > 0.0);
  CHECK(noise([=](double u) { return std::cbrt(root - u + 1e-17) + 1e-7; }) > 0.0);
}

TEST_CASE("where few of many guards cross, the looks on the way are at these", "[narrow]") {
  // Twenty guards, of which the last `count` cross at 0.84.
  const auto calls_a_look = [](int count) {
    int calls = 0;
    std::vector<Function> functions;
    for (int k = 0; k < 20; ++k)
      functions.push_back(
          [=, &calls](double u) { return ++calls, (k < 20 - count ? 2.0 : 0.6) - u * u * u; });
    const auto looks = find(functions).looks;
    return static_cast<double>(calls) / static_cast<double>(looks + 2);  // and one at each end
  };
  CHECK(calls_a_look(1) < 10.0);
  CHECK(calls_a_look(5) > 18.0);
}
