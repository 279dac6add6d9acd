// InstantTime: an instant moves as its first cause does, and the others must move with it.
#include "saltus/simulation/detail/instant_time.hpp"

#include <string>

#include "support/catch.hpp"

using namespace saltus;

namespace instant_time {

namespace {

/// One state, with derivatives of 1 by the parameters g and e.
struct TwoColumns {
  TangentColumns columns{Eigen::MatrixXd::Ones(1, 2), Eigen::MatrixXd::Ones(1, 2),
                         Eigen::MatrixXd::Ones(1, 2), Eigen::RowVectorXd::Ones(2), nullptr};
  Results results;
  TangentGaps gaps{columns, results};
  InstantTime time{columns, gaps};

  TwoColumns() {
    results.sensitivities.parameters = {"g", "e"};
    gaps.begin();
    time.open(3.0);
  }

  std::string reason() const {
    const auto& all = results.sensitivities.gaps;
    return all.empty() ? "" : all.front().reason;
  }
};

MovedTime moved(double by_g, double by_e, std::string event) {
  MovedTime made;
  made.by.resize(2);
  made.by << by_g, by_e;
  made.event = std::move(event);
  return made;
}

constexpr double none = TangentGaps::none;
const std::string apart = "another event happens at the same time, and their order would change";

}  // namespace

TEST_CASE("an instant without a cause has a fixed time") {
  TwoColumns of;
  CHECK_FALSE(of.time.is_caused());
  of.time.settle();
  CHECK(of.columns.t.isZero(0.0));
  CHECK_FALSE(of.time.cause());
  CHECK(of.time.event().empty());
}

TEST_CASE("an instant moves as its first cause") {
  TwoColumns of;
  of.time.take(moved(0.5, -2.0, "ball.bounce"));
  CHECK(of.time.is_caused());
  of.time.settle();
  CHECK(of.columns.t[0] == 0.5);
  CHECK(of.columns.t[1] == -2.0);
  CHECK(of.time.event() == "ball.bounce");
  CHECK(of.results.sensitivities.gaps.empty());
}

TEST_CASE("the cause of an instant is known until the next one has settled") {
  TwoColumns of;
  of.time.take(moved(0.5, -2.0, "ball.bounce"));
  of.time.settle();
  of.time.open(4.0);
  CHECK_FALSE(of.time.is_caused());
  CHECK(of.time.event() == "ball.bounce");
  of.time.settle();
  CHECK_FALSE(of.time.cause());
}

TEST_CASE("causes that move together lose nothing, and the first names the instant") {
  TwoColumns of;
  of.time.take(moved(0.5, 0.0, "a"));
  of.time.take(moved(0.5, 0.0, "b"));
  CHECK(of.reason().empty());
  CHECK(of.time.event() == "a");
}

TEST_CASE("causes that move apart by one parameter lose its column") {
  TwoColumns of;
  of.time.take(moved(0.5, 0.0, "a"));
  of.time.take(moved(0.5, 1.0, "b"));
  CHECK_FALSE(of.gaps.lost(0));
  CHECK(of.gaps.lost(1));
  CHECK(of.reason() == apart);
  CHECK(of.results.sensitivities.gaps.front().event == "b");
  CHECK(of.results.sensitivities.gaps.front().time == 3.0);
}

TEST_CASE("a cause without a derivative loses the column, for the reason that it gives") {
  const bool first = GENERATE(true, false);
  TwoColumns of;
  if (!first) of.time.take(moved(0.5, 0.0, "a"));
  of.time.take(moved(none, 0.0, "b"));
  CHECK(of.gaps.lost(0));
  CHECK_FALSE(of.gaps.lost(1));
  CHECK(of.reason() == "the guard only grazes zero");
}

TEST_CASE("a cause with an obstacle loses all columns") {
  TwoColumns of;
  MovedTime opaque = moved(0.0, 0.0, "a");
  opaque.obstacle = "it shows a sign only";
  of.time.take(opaque);
  CHECK(of.gaps.lost(0));
  CHECK(of.gaps.lost(1));
  CHECK(of.reason() == "it shows a sign only");
}

}  // namespace instant_time
