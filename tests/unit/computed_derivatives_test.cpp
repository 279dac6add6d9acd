// ComputedDerivatives: the chain rule over the functions of diagrams, and where it ends.
#include "saltus/simulation/detail/computed_derivatives.hpp"

#include "saltus/plan/compile.hpp"
#include "support/cases.hpp"

using namespace saltus;
using namespace support;
using Catch::Matchers::WithinRel;

namespace {

/// How the gain of a block moves with the parameter m of its diagram, which is `value`.
template <class Function>
ParameterDirection direction(double value, const Function& gain_of) {
  DiagramBuilder builder;
  const ParameterIndex m = builder.declare_parameter("m", value);
  auto& one = builder.add<Constant>("one", 1.0);
  auto& gain = builder.add<Gain>("gain", 0.0);
  builder.connect(one.output(), gain.input());
  builder.compute_parameter(gain, "gain", [&](const auto& p) { return gain_of(p(m)); });
  const Diagram diagram = builder.build();
  const Context context = diagram.create_context();
  const auto& leaves = context.layout().leaves;
  const auto of = std::ranges::find_if(leaves, &Layout::Leaf::of_diagram);
  REQUIRE(of != leaves.end());
  return ComputedDerivatives(context.layout().computed).by(of->p, context.parameters());
}

/// The derivative of the gain; the diagram's own entry is the other move.
double by_m(const ParameterDirection& found) {
  REQUIRE(found.obstacle.empty());
  REQUIRE(found.moves.size() == 2);
  CHECK(std::ranges::count(found.moves, 1.0, &ParameterMove::by) >= 1);
  return found.moves[0].by == 1.0 ? found.moves[1].by : found.moves[0].by;
}

using tape::Symbol;

}  // namespace

TEST_CASE("a computed parameter moves by the derivative of its function", "[sensitivity]") {
  CHECK(by_m(direction(2.0, [](const Symbol& m) { return 3.0 * m + 1.0; })) == 3.0);
  CHECK(by_m(direction(2.0, [](const Symbol& m) { return m * m; })) == 4.0);
  CHECK_THAT(by_m(direction(2.0, [](const Symbol& m) { return sqrt(m); })),
             WithinRel(0.5 / std::sqrt(2.0), 1e-15));  // two roundings
}

TEST_CASE("a function without a derivative has an obstacle that names it", "[sensitivity]") {
  const auto says = [](const ParameterDirection& found, std::string_view what) {
    return found.obstacle.find(what) != std::string::npos &&
           found.obstacle.find("'gain.gain'") != std::string::npos;
  };
  CHECK(says(direction(0.0, [](const Symbol& m) { return abs(m); }), "kink"));
  CHECK(says(direction(1.0, [](const Symbol& m) { return 2.0 * (m >= 1.0); }), "kink or a jump"));
  CHECK(says(direction(0.0, [](const Symbol& m) { return sqrt(m); }), "no finite derivative"));
}

TEST_CASE("a switch is no kink away from its limit, nor where both sides agree", "[sensitivity]") {
  CHECK(by_m(direction(-3.0, [](const Symbol& m) { return abs(m) * 2.0; })) == -2.0);
  const ParameterDirection flat = direction(0.0, [](const Symbol& m) { return m * abs(m); });
  CHECK(flat.obstacle.empty());
  REQUIRE(flat.moves.size() == 1);  // the derivative of m |m| is 0
}

TEST_CASE("a parameter that nothing is computed from moves alone", "[sensitivity]") {
  const ParameterDirection found = ComputedDerivatives(nullptr).by(3, Eigen::VectorXd::Ones(5));
  REQUIRE(found.moves.size() == 1);
  CHECK(found.moves[0].entry == 3);
  CHECK(found.moves[0].by == 1.0);
}
