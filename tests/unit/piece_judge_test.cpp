// PieceJudge: whether four looks at the guards show what happens in a piece of a step.
#include "saltus/solver/detail/piece_judge.hpp"

#include <cmath>
#include <limits>

#include "support/catch.hpp"

using namespace saltus;

namespace {

constexpr double not_finite = std::numeric_limits<double>::quiet_NaN();

/// Four evenly spaced looks at two guards.
struct Values {
  double oldest[2], earlier[2], last[2], high[2];
  operator FourLooks() const { return {oldest, earlier, last, high, {0.0, 1.0, 2.0, 3.0}}; }
};

// The third difference of 1, 2, 1, 2 is 4, and the error of the parabola 4 / 12: the second guard
// may have been at zero if it is nearer than four errors, 4 / 3.
const Values hidden{{9.0, 1.0}, {9.0, 2.0}, {9.0, 1.0}, {9.0, 2.0}};
const Values far{{9.0, 1.5}, {9.0, 2.5}, {9.0, 1.5}, {9.0, 2.5}};
// The third difference of a parabola is 0.
const Values parabola{{9.0, 9.0}, {9.0, 4.0}, {9.0, 1.0}, {9.0, 0.0}};

/// Two guards, the second of this kind, in this phase.
struct Judge {
  explicit Judge(bool jumps = false, bool rests = false) : guards{{}, {.jumps = jumps}} {
    guards.arm(0, 1), guards.arm(1, 1);
    if (rests) guards.rest(1, 1, 0.0);
  }
  GuardSet guards;
  PieceJudge piece{guards, guards.active().stopping, 2};
};

}  // namespace

TEST_CASE("a guard that zigzags near zero may hide a crossing, one further away does not",
          "[piece_judge]") {
  const Judge judge;
  CHECK(judge.piece.hides(hidden));
  CHECK_FALSE(judge.piece.hides(far));
  CHECK_FALSE(judge.piece.hides(parabola));
  CHECK(judge.piece.is_slow(parabola));
  CHECK_FALSE(judge.piece.is_slow(hidden));
}

/// Looks that are near to each other show the only jump of a guard of two values. Any other guard may
/// do more than they show, however near they are.
TEST_CASE("near looks show a guard of two values that jumped once", "[piece_judge]") {
  const auto hides = [](double a, double b, double c, double d, bool near) {
    const double values[4][2] = {{9.0, a}, {9.0, b}, {9.0, c}, {9.0, d}};
    const ThirdDifference bound(0.0, 1.0, 2.0, 3.0);
    return Judge().piece.hides({values[0], values[1], values[2], values[3], bound, near});
  };
  for (const bool near : {false, true}) {
    CHECK(hides(1.0, 1.0, 1.0, -1.0, near) == !near);
    CHECK(hides(1.0, 1.0, -1.0, -1.0, near) == !near);
    CHECK(hides(1.0, 1.0, -1.0, 1.0, near));  // it jumped twice
    CHECK(hides(1.0, 1.0, 0.9, -1.0, near));  // it has three values
  }
}

TEST_CASE("a guard that jumps, or rests, does not count for the pieces", "[piece_judge]") {
  CHECK_FALSE(Judge(true).piece.hides(hidden));
  CHECK_FALSE(Judge(false, true).piece.hides(hidden));
}

TEST_CASE("a guard that is not finite hides nothing, because it fires", "[piece_judge]") {
  const Values broken{{9.0, 1.0}, {9.0, 2.0}, {9.0, 1.0}, {9.0, not_finite}};
  CHECK_FALSE(Judge().piece.hides(broken));
}

TEST_CASE("only the guard that hides something in vain is left out", "[piece_judge]") {
  const Values first{{1.0, 9.0}, {2.0, 9.0}, {1.0, 9.0}, {2.0, 9.0}};
  Judge judge;
  for (int i = 0; i <= thresholds::most_in_vain; ++i) judge.piece.note_in_vain(hidden);
  CHECK_FALSE(judge.piece.hides(hidden));
  CHECK(judge.piece.hides(first));
  for (int i = 0; i < thresholds::most_patience; ++i) judge.piece.begin_step(1);
  CHECK(judge.piece.hides(hidden));
}

/// A guard and, behind it, a value that it reads.
struct ReadJudge {
  explicit ReadJudge(bool rests = false) : guards{{.jumps = true}} {
    located.add(0, {.group = 0});
    GuardGroup group;
    group.reads = {{.slot = 1}};
    located.add_reads(group);
    guards.arm(0, 1);
    if (rests) guards.rest(0, 1, 0.0);
  }
  GuardSet guards;
  LocatedGuards located;
  PieceJudge piece{guards, located, 2};
};

/// A function with a step and a slope shows the slope only: between two looks it may have been beyond the
/// step and come back. So it makes no difference whether the guard moves.
TEST_CASE("what a guard reads counts, whether the guard moves or not", "[piece_judge]") {
  const Values constant{{1.0, 101.0}, {1.0, 102.0}, {1.0, 101.0}, {1.0, 102.0}};
  const Values changed{{1.0, 101.0}, {1.0, 102.0}, {1.0, 101.0}, {-1.0, 102.0}};
  const Values moves{{1.0, 101.0}, {2.0, 102.0}, {3.0, 101.0}, {4.0, 102.0}};
  const Values known{{1.0, 109.0}, {1.0, 104.0}, {1.0, 101.0}, {1.0, 100.0}};  // a parabola
  CHECK(ReadJudge().piece.hides(constant));
  CHECK(ReadJudge().piece.hides(changed));
  CHECK(ReadJudge().piece.hides(moves));
  CHECK_FALSE(ReadJudge().piece.hides(known));
  CHECK_FALSE(ReadJudge(true).piece.hides(constant));
}

/// The third difference of equal values is a rounding, if the looks are not evenly spaced, and their range
/// is 0. In pieces of 1e3 roundings of the time, the values of a slope are off by 1e-3 of their range.
TEST_CASE("what is rounding of a value that a guard reads hides nothing", "[piece_judge]") {
  const auto hides = [](double slope, double piece, double resolution, double off) {
    const double at[4] = {0.0, 1.3 * piece, 2.0 * piece, 3.0 * piece};
    double values[4][2];
    for (int i = 0; i < 4; ++i) {
      values[i][0] = 1.0;
      values[i][1] = 0.3 + slope * (at[i] + (i % 2 == 0 ? off : -off));
    }
    const FourLooks looks{
        values[0], values[1],         values[2], values[3], {at[0], at[1], at[2], at[3]},
        false,     resolution / piece};
    const ReadJudge judge;
    CHECK(judge.piece.hides(looks) == !judge.piece.is_slow(looks));
    return judge.piece.hides(looks);
  };
  CHECK_FALSE(hides(0.0, 1.0, 0.0, 0.0));
  CHECK_FALSE(hides(1e-15, 1.0, 0.0, 0.5));        // roundings of 0.3
  CHECK_FALSE(hides(1.0, 1e-12, 1e-14, 0.5e-14));  // roundings of the time
  CHECK(hides(1.0, 1e-12, 1e-18, 0.5e-12));
}

TEST_CASE("a sine that a guard reads is shown by thirty looks in a period", "[piece_judge]") {
  const auto hides = [](double looks) {
    bool any = false;
    for (double phase = 0.0; phase < 6.3; phase += 0.01) {
      double values[4][2];
      for (int i = 0; i < 4; ++i) {
        values[i][0] = 1.0, values[i][1] = std::sin(phase + i * 2.0 * std::acos(-1.0) / looks);
      }
      const ThirdDifference bound(0.0, 1.0, 2.0, 3.0);
      any = any || ReadJudge().piece.hides({values[0], values[1], values[2], values[3], bound});
    }
    return any;
  };
  CHECK(hides(15.0));
  CHECK_FALSE(hides(60.0));
}

TEST_CASE("a value that is noise counts no more after a while", "[piece_judge]") {
  const Values noise{{1.0, 101.0}, {1.0, 102.0}, {1.0, 101.0}, {1.0, 102.0}};
  ReadJudge judge;
  for (int i = 0; i <= thresholds::most_in_vain; ++i) judge.piece.note_in_vain(noise);
  CHECK_FALSE(judge.piece.hides(noise));
}
