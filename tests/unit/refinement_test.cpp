// A leaf gets other functions while its plan is made: when it is asked for them, and what stays.
#include "saltus/plan/refinement.hpp"

#include <map>

#include "saltus/library/library.hpp"
#include "saltus/plan/compile.hpp"
#include "saltus/simulation/simulate.hpp"
#include "support/leaves.hpp"

using namespace saltus;
using namespace support;

namespace {

using Change = std::function<void(Declarations&)>;

/// Changes the declarations of the leaves that it knows, early or late, and counts its answers.
class Changes final : public Refinement {
 public:
  explicit Changes(bool early) : early_(early) {}
  void add(const LeafSystem& leaf, Change change) { changes_.emplace(&leaf, std::move(change)); }

  std::shared_ptr<const Declarations> before(const LeafSystem& leaf) override {
    return early_ ? changed(leaf) : nullptr;
  }
  std::shared_ptr<const Declarations> with_shapes(const Plan& plan, const PlanLeaf& leaf) override {
    for (const int node : leaf.inputs) widths.push_back(plan.node(node).shape.size);
    return early_ ? nullptr : changed(*leaf.system);
  }

  std::vector<Index> widths;  // of the inputs of the leaves it was asked for with shapes

 private:
  std::shared_ptr<const Declarations> changed(const LeafSystem& leaf) const {
    const auto found = changes_.find(&leaf);
    if (found == changes_.end()) return nullptr;
    auto declarations = std::make_shared<Declarations>(leaf.declarations());
    found->second(*declarations);
    return declarations;
  }

  bool early_;
  std::map<const LeafSystem*, Change> changes_;
};

/// y = 2 u + t; `calls` counts how often its shape is asked for.
Leaf line(int& calls) {
  return Leaf("line", [&calls](Leaf& l) {
    l.declare_input_port();
    l.declare_output_port({.name = "y",
                           .calc = [](const At& at) { return 2.0 * at.u(0) + at.time; },
                           .shape = std::nullopt,
                           .shape_rule =
                               [&calls](std::span<const Shape>) {
                                 ++calls;
                                 return Shape::scalar();
                               }});
  });
}

/// y = 2 u.
void forget_time(Declarations& d) {
  d.outputs[0].calc = [](const At& at) { return 2.0 * at.u(0); };
  d.outputs[0].reads = Reads::inputs;
  d.outputs[0].shape = Shape::scalar();  // known: nobody has to ask for it
}

}  // namespace

TEST_CASE("a leaf runs the functions that a refinement gave it", "[refinement]") {
  const bool early = GENERATE(false, true);
  int shapes = 0;
  Leaf twice = line(shapes);
  DiagramBuilder builder;
  auto& source = builder.add<Constant>("source", 3.0);
  auto& integrator = builder.add<Integrator>("integrator");
  builder.add(std::shared_ptr<const System>(std::shared_ptr<void>(), &twice));
  builder.connect(source.output(), twice.input());
  builder.connect(twice.output(), integrator.input());
  const Diagram diagram = builder.build();
  shapes = 0;  // build() asks too
  const auto refinement = std::make_shared<Changes>(early);
  refinement->add(twice, forget_time);

  const RecordedSignals recorded{{"y", twice.output()}};
  const auto rate = [](const Plan& plan) { return plan.node(plan.taps[0].node).rate; };
  CHECK(rate(*compile(diagram, recorded, refinement.get())) == Rate::constant);
  CHECK(shapes == (early ? 0 : 1));
  CHECK(refinement->widths.size() == (early ? 1 : 2));  // of the integrator, and of the line
  CHECK(rate(*compile(diagram, recorded)) == Rate::continuous);  // the leaf itself is unchanged

  const Results results =
      simulate(diagram, diagram.create_context(), {0.0, 1.0}, {.refinement = refinement});
  CHECK(std::abs(results.context.continuous_state()[0] - 6.0) <= 6.0 * 4.0 * eps);
}

TEST_CASE("a system is sound by what it declares: no refinement opens a loop", "[refinement]") {
  int shapes = 0;
  Leaf loop = line(shapes);
  DiagramBuilder builder;
  builder.add(std::shared_ptr<const System>(std::shared_ptr<void>(), &loop));
  builder.connect(loop.output(), loop.input());
  CHECK_THROWS_AS(builder.build(), ModelError);  // before a plan, and a refinement, is made
}

TEST_CASE("a refinement is given where a plan is made", "[refinement]") {
  const Leaf leaf("leaf", [](Leaf& l) { declare_ramp(l); });
  SimulatorOptions options;
  options.refinement = std::make_shared<Changes>(true);
  CHECK_THROWS_AS(Simulator(compile(leaf), options), ModelError);
}
