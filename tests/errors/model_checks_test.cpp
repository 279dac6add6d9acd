// What the model layer refuses when it is declared or put together.
#include "support/leaves.hpp"

using namespace saltus;
using namespace support;

TEST_CASE("a part with the same numbers of another shape of modes is refused", "[context]") {
  const Leaf one("one", [](Leaf& l) { declare_ramp(l); });
  DiagramBuilder builder;
  builder.add<Leaf>("ramp", [](Leaf& l) { declare_ramp(l); });
  builder.add<Leaf>("moded", [](Leaf& l) { l.declare_default_mode(1); });
  auto pair = std::make_shared<Diagram>(builder.build("pair"));
  DiagramBuilder outside;
  outside.add(pair);
  const auto& leaf = outside.add<Leaf>("leaf", [](Leaf& l) { declare_ramp(l); });
  const Diagram root = outside.build();
  const Context all = root.create_context();
  // One state, no parameters, as a leaf has; but two modes where the leaf has one.
  CHECK_THROWS_AS(all.with_subcontext(leaf.system_id(), all[pair->system_id()]), ModelError);
}

TEST_CASE("an edge reset whose name is declared twice is refused", "[declare]") {
  const auto update = [](const At&, Next&) {};
  CHECK(message<ModelError>([&] {
          Leaf("block", [&](Leaf& l) {
            l.declare_input_port({.shape = Shape::scalar()});
            l.declare_edge_reset({.name = "n", .reset_map = update}),
                l.declare_edge_reset({.name = "n", .reset_map = update});
          });
        }) == "block 'block': the name 'n' is declared twice");
}

TEST_CASE("a relation without a guard is refused", "[declare]") {
  CHECK(contains(message<ModelError>(
                     [] { Leaf("block", [](Leaf& l) { l.declare_relation({.name = "r"}); }); }),
                 "relation 'r' has no guard"));
}
