// Contacts: the fixed point of the resets on a surface, and whether the surface moves.
#include "saltus/simulation/detail/contact.hpp"

#include <functional>

#include "support/leaves.hpp"

using namespace saltus;
using namespace support;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

using Function = std::function<double(double)>;

/// A block at (height, speed) = (1, 0) over a surface at 1 + h(t), under the force f(t) < 0.
struct Block {
  explicit Block(
      Function h = [](double) { return 0.0; }, Function force = [](double) { return -10.0; },
      ResetMap map = {})
      : leaf("block", [&](Leaf& l) {
          l.declare_continuous_state(
              {.initial = vec({1.0, 0.0}),
               .ode = [force](const At& at, VectorRef xdot) { xdot << at.x[1], force(at.time); }});
          if (!map)
            map = [h](const At& at, Next& next) {
              next.set_continuous_state({1.0 + h(at.time), 0.0});
            };
          l.declare_zero_crossing(
              {.name = "surface",
               .guard = [h](const At& at) { return (at.x[0] - 1.0) - h(at.time); },
               .reset_map = map,
               .direction = Direction::positive_then_non_positive});
        }) {
    machine.load(leaf.create_context());
    contact.members = {{0, &machine.plan().crossing_of(machine.plan().guards[0]).reset_map, 0}};
    contact.states = {0, 1};
    for (const Index i : contact.states) machine.resting().rest(i);
  }
  double look_ahead(double t, double longest) {
    contacts.choose_look_ahead(contact, t, machine.x.data(), longest);
    return contact.look_ahead;
  }
  bool moves(double longest = 10.0) {
    look_ahead(0.0, longest);
    return contacts.moves(contact, 0.0, machine.x.data(), longest);
  }
  bool settle() { return contacts.settle(contact, 0.0, machine.x.data()); }

  Leaf leaf;
  Machine machine{compile(leaf)};
  Contacts contacts{machine, SimulatorOptions{.rtol = 1e-8, .atol = 1e-8}};
  SurfaceContact contact{.slot = 0};
};

/// Zero until t = 1 ms, then `to`.
Function later(double to) {
  return [to](double t) { return t < 1e-3 ? 0.0 : to; };
}

/// The height goes to 1 + s times what it is away from there, plus a rounding that never ends.
ResetMap spiral(double s, double noise) {
  return [=](const At& at, Next& next) {
    const double off = at.x[0] - 1.0;
    next.set_continuous_state({1.0 + s * off + (off < noise ? noise : -noise), 0.0});
  };
}

}  // namespace

TEST_CASE("a surface that moves by many roundings moves, and one that wavers by some does not",
          "[contact]") {
  // A truth of the author shows no lift: only the height of the surface tells.
  const auto moves = [](double by) {
    Block block(later(by));
    block.contact.opaque = true;
    return block.moves();
  };
  CHECK_FALSE(moves(0.0));
  CHECK_FALSE(moves(100.0 * eps));
  CHECK(moves(2e4 * eps));
  CHECK(moves(-2e4 * eps));
  CHECK(moves(1.0));
}

TEST_CASE("a force that changes counts as a movement, and the rounding of a force does not",
          "[contact]") {
  const auto moves = [](double by) {
    return Block([](double) { return 0.0; },
                 [by](double t) { return t < 1e-3 ? -10.0 : -10.0 * (1.0 + by); })
        .moves();
  };
  CHECK_FALSE(moves(0.0));
  CHECK_FALSE(moves(1e-6));  // the lift is known to nine digits, and the force to eight
  CHECK(moves(1e-4));
  CHECK(moves(-1e-4));
}

TEST_CASE("a look ahead shows curvature with nine digits, whatever the force", "[contact]") {
  const double force = GENERATE(1e-2, 10.0, 1e6);
  Block block([](double) { return 0.0; }, [=](double) { return -force; });
  const double d = block.look_ahead(0.0, 1e3);
  // The height of 1 m, and as much again by atol / rtol, is known to eps; the block falls by this:
  const double digits = std::log10(0.5 * force * d * d / (2.0 * eps));
  CHECK(digits > 8.0);
  CHECK(digits < 10.0);
}

TEST_CASE("a block without a force looks ahead for a part of the run that many looks fit into",
          "[contact]") {
  const double longest = GENERATE(1.0, 1e3);
  Block block([](double) { return 0.0; }, [](double) { return -0.0; });
  const double d = block.look_ahead(0.0, longest);
  CHECK(d >= 1e-4 * longest);
  CHECK(d <= 0.03 * longest);  // one more look is thirty times as far
}

TEST_CASE("a look ahead is never so short that the time hardly moves", "[contact]") {
  // A force of 1e40 would show within 1e-23 s.
  Block block([](double) { return 0.0; }, [](double) { return -1e40; });
  const double of_run = block.look_ahead(0.0, 10.0) / 10.0;
  CHECK(of_run > 1e-10);
  CHECK(of_run < 1e-8);
  // At 1e9 s a rounding of the time is 1e-7 s; three digits of a difference of times remain.
  const double roundings = block.look_ahead(1e9, 1e-6) / (eps * 1e9);
  CHECK(roundings > 1e2);
  CHECK(roundings < 1e4);
}

TEST_CASE("a reset that moves by roundings only is at its fixed point", "[contact]") {
  // Aitken's extrapolation finds that of an affine map at once; noise of some roundings keeps the
  // reset moving for ever.
  CHECK(Block([](double) { return 0.0; }, [](double) { return -10.0; }, spiral(0.5, 0.0)).settle());
  CHECK(Block([](double) { return 0.0; }, [](double) { return -10.0; }, spiral(0.0, 8.0 * eps))
            .settle());
  CHECK_FALSE(
      Block([](double) { return 0.0; }, [](double) { return -10.0; }, spiral(0.0, 500.0 * eps))
          .settle());
}
