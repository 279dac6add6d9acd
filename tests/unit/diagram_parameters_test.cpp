// Parameters of a diagram: those of its blocks follow, whatever sets them.
#include "saltus/model/context_json.hpp"
#include "saltus/simulation/ensemble.hpp"
#include "saltus/simulation/linearize.hpp"
#include "support/cases.hpp"

using namespace saltus;
using Catch::Matchers::WithinAbs;

namespace {

/// What a call that is refused says; empty if it is not.
template <class Call>
std::string refusal(const Call& call) {
  try {
    call();
  } catch (const ModelError& error) {
    return error.what();
  }
  return {};
}

bool contains(const std::string& message, std::string_view part) {
  return message.find(part) != std::string::npos;
}

/// The default tolerance; the exact rate is constant.
constexpr double tolerance = 1e-9;

/// x' = gain, gain = 3 m + 1, with m = 2.
struct Scene {
  Scene() {
    DiagramBuilder builder;
    const ParameterIndex m = builder.declare_parameter("m", 2.0);
    auto& one = builder.add<Constant>("one", 1.0);
    auto& gain = builder.add<Gain>("gain", 0.0);
    auto& x = builder.add<Integrator>("x", Integrator::Options{});
    builder.connect(one.output(), gain.input());
    builder.connect(gain.output(), x.input());
    builder.compute_parameter(gain, "gain", [=](const auto& p) { return 3.0 * p(m) + 1.0; });
    diagram.emplace(builder.build());
  }
  double end_from(const Context& context, SimulatorOptions options = {}) const {
    return simulate(*diagram, context, {0.0, 1.0}, options).context.continuous_state()[0];
  }
  std::optional<Diagram> diagram;
};

}  // namespace

TEST_CASE("a parameter that is computed follows that of the diagram", "[model]") {
  const Scene scene;
  const Context context = scene.diagram->create_context();
  CHECK(context.parameter("gain.gain")[0] == 7.0);
  CHECK_THAT(scene.end_from(context), WithinAbs(7.0, tolerance));
  const Context heavier = context.with_parameter("m", 4.0);
  CHECK(heavier.parameter("m")[0] == 4.0);
  CHECK(heavier.parameter("gain.gain")[0] == 13.0);
  CHECK_THAT(scene.end_from(heavier), WithinAbs(13.0, tolerance));
  CHECK_THAT(scene.end_from(heavier, {.islands = true}), WithinAbs(13.0, tolerance));
  CHECK(context.parameter("gain.gain")[0] == 7.0);
}

TEST_CASE("a parameter that is computed cannot be set", "[model]") {
  const Context context = Scene().diagram->create_context();
  CHECK(contains(refusal([&] { context.with_parameter("gain.gain", 1.0); }),
                 "'gain.gain' is computed from the parameters of a diagram"));
  CHECK(contains(refusal([&] { context.with_parameter("mass", 1.0); }), "'m'"));
  CHECK(contains(refusal([&] { context.with_parameter("m", std::nan("")); }), "finite"));
  const auto names = entry_names(context.layout());
  CHECK(std::ranges::count(names, "m") == 1);
  CHECK(std::ranges::count(names, "gain.gain") == 0);
}

TEST_CASE("the runs of a sweep have their own values", "[model]") {
  const Scene scene;
  Ensemble runs(*scene.diagram, scene.diagram->create_context(), {0.0, 1.0}, {});
  runs.vary("m", {1.0, 2.0, 3.0}, 1);
  for (Index i = 0; i < 3; ++i)
    CHECK_THAT(scene.end_from(runs.context(i)),
               WithinAbs(3.0 * static_cast<double>(i + 1) + 1.0, tolerance));
}

TEST_CASE("a diagram computes those of a diagram in it", "[model]") {
  DiagramBuilder inner, builder;
  const ParameterIndex k = inner.declare_parameter("k", Eigen::Vector2d(1.0, 2.0));
  auto& gain = inner.add<Gain>("gain", 0.0);
  inner.export_input(gain.input(), "in");
  inner.export_output(gain.output(), "out");
  inner.compute_parameter(gain, "gain", [=](const auto& p) { return p(k) + 10.0 * p(k, 1); });
  const auto part = std::make_shared<Diagram>(inner.build("part"));
  const ParameterIndex m = builder.declare_parameter("m", 3.0);
  auto& one = builder.add<Constant>("one", 1.0);
  builder.add(part);
  builder.connect(one.output(), part->input());
  builder.export_output(part->output(), "out");
  builder.compute_parameter(
      *part, "k", [=](const auto& p) { return std::vector<tape::Symbol>{p(m), p(m) * p(m)}; });
  const Diagram diagram = builder.build();
  const Context context = diagram.create_context();
  CHECK(context.parameter("part.gain.gain")[0] == 93.0);
  const Context other = context.with_parameter("m", 2.0);
  CHECK(other.parameter("part.k") == Eigen::Vector2d(2.0, 4.0));
  CHECK(other.parameter("part.gain.gain")[0] == 42.0);
  // The context of the part has its parameters by their own names.
  const Context own = other[part->system_id()];
  CHECK(own.parameter("gain.gain")[0] == 42.0);
  CHECK(part->create_context().with_parameter("k", 1.0).parameter("gain.gain")[0] == 11.0);
  CHECK(context.with_subcontext(part->system_id(), own).parameter("part.gain.gain")[0] == 93.0);
}

TEST_CASE("a context that was saved has its values", "[model]") {
  const Scene scene;
  const Context context = scene.diagram->create_context().with_parameter("m", 4.0);
  const Context restored = context_from_json(*scene.diagram, to_json(context));
  CHECK(restored.parameters() == context.parameters());
  CHECK(restored.with_parameter("m", 2.0).parameter("gain.gain")[0] == 7.0);
}

TEST_CASE("a run is differentiated by a parameter of a diagram, and by a computed one", "[model]") {
  const Scene scene;
  const Context context = scene.diagram->create_context();
  const auto by =
      simulate(*scene.diagram, context, {0.0, 1.0}, {.sensitivity = {"gain.gain", "m"}});
  CHECK_THAT(by.sensitivities.continuous_state.at(0), WithinAbs(1.0, tolerance));
  CHECK_THAT(by.sensitivities.continuous_state.at(1), WithinAbs(3.0, tolerance));
}

TEST_CASE("a builder refuses parameters that it cannot compute", "[model]") {
  DiagramBuilder builder;
  const ParameterIndex m = builder.declare_parameter("m", 2.0);
  auto& one = builder.add<Constant>("one", 1.0);
  const Gain stranger("stranger", 1.0);
  const auto same = [=](const auto& p) { return p(m); };
  CHECK(contains(refusal([&] { builder.declare_parameter("m", 1.0); }), "'m'"));
  CHECK(contains(refusal([&] { builder.compute_parameter(one, "gain", same); }), "'value'"));
  CHECK(contains(refusal([&] {
                   builder.compute_parameter(one, "value", [=](const auto& p) {
                     return std::vector<tape::Symbol>{p(m), p(m)};
                   });
                 }),
                 "has 1 values, the function gives 2"));
  builder.compute_parameter(one, "value", same);
  builder.compute_parameter(one, "value", same);
  CHECK(contains(refusal([&] { builder.build(); }), "computed twice"));
  DiagramBuilder other;
  other.add<Constant>("one", 1.0);
  other.declare_parameter("m", 2.0);
  other.compute_parameter(stranger, "gain", same);
  CHECK(contains(refusal([&] { other.build(); }), "not in this diagram"));
}
