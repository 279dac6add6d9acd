// Semantics 6.7: a context belongs to one structure, and a damaged one is refused.
#include <functional>
#include <random>

#include "saltus/model/context_json.hpp"
#include "saltus/simulation/ensemble.hpp"
#include "support/balls.hpp"
#include "support/leaves.hpp"

using namespace saltus;
using namespace support;

namespace {

Leaf with_parameters(std::string name, const std::vector<std::pair<std::string, Index>>& all) {
  return {std::move(name), [&](Leaf& l) {
            for (const auto& [parameter, size] : all)
              l.declare_dynamic_parameter(parameter, Eigen::VectorXd::Ones(size));
            declare_ramp(l);
          }};
}

/// A ball after three bounces, with everything that a continuation may have.
const BallScene& scene() {
  static const BallScene ball = leaf({.e = 0.6});
  return ball;
}
nlohmann::ordered_json good() {
  static const auto text =
      to_json(simulate(*scene().system, scene().context(1.0, 0.0), {0.0, 1.5}).context);
  return nlohmann::ordered_json::parse(text);
}

/// Whether a text is refused as a context, by ModelError and nothing else; or, if it is one, it
/// runs or fails as a run does.
void take(const std::string& text) {
  try {
    const Context context = context_from_json(*scene().system, text);
    const double t = context.time();
    simulate(*scene().system, context, {t, t + 0.5},
             {.max_major_steps = 200, .max_passes = 20, .throw_errors = false});
  } catch (const ModelError&) {
    return;
  }
}

}  // namespace

TEST_CASE("6.7 a context of other blocks with the same sizes is refused", "[semantics]") {
  const Leaf spring = with_parameters("a", {{"spring", 1}});
  const std::vector<Leaf> others = [] {
    std::vector<Leaf> all;
    all.push_back(with_parameters("a", {{"mass", 1}}));
    all.push_back(with_parameters("b", {{"spring", 1}}));
    all.push_back(with_parameters("a", {{"spring", 2}}));
    all.push_back(with_parameters("a", {}));
    return all;
  }();
  Simulator simulator(spring);
  for (const Leaf& other : others) {
    const Context foreign = other.create_context();
    CHECK(contains(message<ModelError>([&] { simulator.initialize(foreign); }),
                   "the context is not one of this system"));
    CHECK(
        contains(message<ModelError>([&] { const Ensemble ensemble(spring, foreign, {0.0, 1.0}); }),
                 "the context is not one of this system"));
  }
  CHECK_THROWS_AS(simulator.initialize(Context()), ModelError);
  simulator.initialize(with_parameters("a", {{"spring", 1}}).create_context());  // the same blocks
  CHECK(simulator.advance_to(1.0) == Status::reached_end);
}

TEST_CASE("6.7 a part of another block with the same sizes is refused", "[semantics]") {
  DiagramBuilder builder;
  builder.add(std::make_shared<Leaf>(with_parameters("inner", {{"spring", 1}})));
  const Diagram diagram = builder.build();
  const Context whole = diagram.create_context();
  const SystemId id = diagram["inner"].system_id();
  const auto put = [&](const Context& part) { return whole.with_subcontext(id, part); };
  CHECK_NOTHROW(put(with_parameters("alone", {{"spring", 1}}).create_context()));
  CHECK(contains(
      message<ModelError>([&] { put(with_parameters("inner", {{"mass", 1}}).create_context()); }),
      "expected the parameters 'spring', found 'mass'"));
}

TEST_CASE("6.7 a context in JSON with one field forged is refused", "[semantics]") {
  using Json = nlohmann::ordered_json;
  const std::vector<std::pair<const char*, std::function<void(Json&)>>> forged{
      {"no format", [](Json& j) { j.erase("format"); }},
      {"format", [](Json& j) { j["format"] = Json::array({1, 2}); }},
      {"time", [](Json& j) { j["time"] = "now"; }},
      {"settled", [](Json& j) { j["settled"] = 1; }},
      {"blocks", [](Json& j) { j["blocks"] = 7; }},
      {"no block", [](Json& j) { j["blocks"].clear(); }},
      {"more blocks", [](Json& j) { j["blocks"].push_back(j["blocks"][0]); }},
      {"name", [](Json& j) { j["blocks"][0]["block"] = "bell"; }},
      {"states", [](Json& j) { j["blocks"][0]["continuous_state"].push_back(1.0); }},
      {"a state", [](Json& j) { j["blocks"][0]["continuous_state"][0] = "high"; }},
      {"mode", [](Json& j) { j["blocks"][0]["mode"] = 1e300; }},
      {"long mode", [](Json& j) { j["blocks"][0]["mode"] = std::int64_t{1} << 40; }},
      {"jump", [](Json& j) { j["continuation"]["jump"] = -1; }},
      {"long jump", [](Json& j) { j["continuation"]["jump"] = 2147483647; }},
      {"guard side", [](Json& j) { j["continuation"]["guards"][0][0] = 77; }},
      {"guard from", [](Json& j) { j["continuation"]["guards"][0][1] = -9; }},
      {"guard error", [](Json& j) { j["continuation"]["guards"][0][4] = -1.0; }},
      {"short guard", [](Json& j) { j["continuation"]["guards"][0] = Json::array({1}); }},
      {"firing after", [](Json& j) { j["continuation"]["firings"][0]["after"] = {1.0}; }},
      {"firing times", [](Json& j) { j["continuation"]["firings"][0]["times"] = {1.0, 2.0}; }},
      {"many times", [](Json& j) { j["continuation"]["firings"][0]["times"] = {5, 4, 3, 2, 1}; }},
      {"counts", [](Json& j) { j["continuation"]["counts"][0] = -1; }},
      {"long counts", [](Json& j) { j["continuation"]["counts"][0] = 9223372036854775807; }},
      {"counts as text", [](Json& j) { j["continuation"]["counts"] = "many"; }},
      {"edges", [](Json& j) { j["continuation"]["edges"] = {2}; }},
      {"relations", [](Json& j) { j["continuation"]["relations"] = {0.5}; }}};
  Simulator simulator(*scene().system);
  for (const auto& [name, forge] : forged) {
    INFO(name);
    Json json = good();
    forge(json);
    CHECK_THROWS_AS(simulator.initialize(context_from_json(*scene().system, json.dump())),
                    ModelError);
  }
  simulator.initialize(context_from_json(*scene().system, good().dump()));
  CHECK(simulator.advance_to(3.0) == Status::reached_end);
}

TEST_CASE("6.7 bytes flipped, dropped and doubled in a context are a ModelError or a run",
          "[semantics]") {
  const std::string text = good().dump();
  std::mt19937 random(6);
  const auto any = [&](std::size_t n) {
    return std::uniform_int_distribution<std::size_t>(0, n - 1)(random);
  };
  for (int i = 0; i < 3000; ++i) {
    std::string damaged = text;
    for (std::size_t n = 1 + any(3); n > 0; --n) {
      const std::size_t at = any(damaged.size());
      switch (any(4)) {
        case 0:
          damaged[at] = static_cast<char>(any(256));
          break;
        case 1:
          damaged.erase(at, 1 + any(8));
          break;
        case 2:
          damaged.insert(at, damaged.substr(any(damaged.size()), 1 + any(8)));
          break;
        default:
          damaged[at] = "0123456789-+.eE[]{},:\"tfn"[any(25)];
      }
    }
    INFO(damaged);
    take(damaged);
  }
}
