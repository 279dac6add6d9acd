// TangentGaps: a derivative that does not exist is NaN from then on, and has one reason.
#include "saltus/simulation/detail/tangent_gaps.hpp"

#include <string>
#include <vector>

#include "support/leaves.hpp"

using namespace saltus;
using namespace support;

namespace {

/// Two states, a discrete state and a signal, with derivatives of 1 by the parameters g and e.
struct TwoColumns {
  TangentColumns columns{Eigen::MatrixXd::Ones(2, 2), Eigen::MatrixXd::Ones(1, 2),
                         Eigen::MatrixXd::Ones(1, 2), Eigen::RowVectorXd::Ones(2), nullptr};
  Results results;
  TangentGaps gaps{columns, results};

  TwoColumns() {
    results.sensitivities.parameters = {"g", "e"};
    gaps.begin();
  }

  /// "time parameter: reason" of each gap.
  std::vector<std::string> written() const {
    std::vector<std::string> lines;
    for (const SensitivityGap& gap : results.sensitivities.gaps)
      lines.push_back(text(gap.time, " ", gap.parameter, ": ", gap.reason));
    return lines;
  }
};

}  // namespace

TEST_CASE("a lost column is NaN, and the other keeps its numbers") {
  TwoColumns of;
  of.gaps.lose(1.0, 1, "ball.bounce", "it grazes");
  CHECK(of.gaps.lost(1));
  CHECK_FALSE(of.gaps.lost(0));
  CHECK(of.columns.x.col(1).array().isNaN().all());
  CHECK(of.columns.z.col(1).array().isNaN().all());
  CHECK(std::isnan(of.columns.t[1]));
  CHECK(of.columns.x.col(0).isOnes(0.0));
  CHECK(of.columns.t[0] == 1.0);
}

TEST_CASE("the first reason for which a column is lost is the one that is given") {
  TwoColumns of;
  of.gaps.lose(1.0, 0, "a", "first");
  of.gaps.lose(2.0, 0, "b", "second");
  CHECK(of.written() == std::vector<std::string>{"1 g: first"});
}

TEST_CASE("a new run has lost nothing") {
  TwoColumns of;
  of.gaps.lose(1.0, 0, "a", "first");
  of.gaps.begin();
  CHECK_FALSE(of.gaps.lost(0));
}

TEST_CASE("gaps are in order of time, each of them once") {
  TwoColumns of;
  for (const double t : {2.0, 1.0, 3.0, 1.0, 2.0}) of.gaps.note(t, 0, "a", "tie");
  of.gaps.note(1.0, 1, "a", "tie");
  CHECK(of.written() == std::vector<std::string>{"1 g: tie", "1 e: tie", "2 g: tie", "3 g: tie"});
}

TEST_CASE("no column stops being finite without a reason") {
  TwoColumns of;
  const bool in_state = GENERATE(true, false);
  (in_state ? of.columns.x(1, 0) : of.columns.y(0, 0)) = std::numeric_limits<double>::infinity();
  SECTION("which is the obstacle, if there is one") {
    of.gaps.lose_not_finite(1.0, "a pole");
    CHECK(of.written() == std::vector<std::string>{"1 g: a pole"});
  }
  SECTION("or says that the derivative is not finite") {
    of.gaps.lose_not_finite(1.0, "");
    CHECK(of.written() == std::vector<std::string>{"1 g: the derivative is not finite"});
  }
  SECTION("and a lost column has its reason already") {
    of.gaps.lose(0.5, 0, "a", "first");
    of.gaps.lose_not_finite(1.0, "a pole");
    CHECK(of.written() == std::vector<std::string>{"0.5 g: first"});
  }
}

TEST_CASE("a state that jumps has no derivative at a time of the jump that moves") {
  const Leaf leaf("leaf", [](Leaf& l) {
    l.declare_continuous_state(
        {.initial = vec({1.0, 2.0}), .ode = [](const At&, VectorRef xdot) { xdot.setZero(); }});
  });
  Machine machine(compile(leaf));
  machine.load(leaf.create_context());
  TwoColumns of;
  of.columns.z.resize(0, 2), of.columns.t << 1.0, 0.0;  // g moves the instant, e does not
  OneSided one_sided;
  one_sided.open(machine, of.columns);
  machine.x[1] = 5.0;
  one_sided.judge(1.0, machine, of.columns, of.columns, "leaf.jump");
  TangentColumns& row = of.columns;

  SECTION("and one at each other time") {
    of.gaps.clear(one_sided, 2.0, "it jumps", row.x, row.z);
    CHECK(row.x.isOnes(0.0));
    CHECK(of.written().empty());
  }
  SECTION("and that row has a gap, which is not that of the column") {
    of.gaps.clear(one_sided, 1.0, "it jumps", row.x, row.z);
    CHECK(std::isnan(row.x(1, 0)));
    CHECK(row.x.array().isNaN().count() == 1);
    CHECK_FALSE(of.gaps.lost(0));
    CHECK(of.written() == std::vector<std::string>{"1 g: it jumps"});
  }
  SECTION("nor has the end of a run there, until the run goes on") {
    of.gaps.end(one_sided, {}, 1.0, row.x, row.z);
    CHECK(of.written().size() == 1);
    of.gaps.forget_end();
    CHECK(of.written().empty());
  }
  SECTION("and neither has an end at a jump of the flow") {
    saltus::AtJump jump = saltus::AtJump::Constant(row.x.rows(), row.x.cols(), false);
    jump(1, 0) = true;
    of.gaps.end(one_sided, jump, 2.0, row.x, row.z);
    CHECK(row.x.array().isNaN().count() == 1);
    CHECK(of.written().size() == 1);
    of.gaps.forget_end();
    CHECK(of.written().empty());
  }
}
