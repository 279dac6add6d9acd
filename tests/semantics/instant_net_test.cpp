// Semantics 3.2, 3.4: a ring of cells that kick each other when they spike. No spike is lost, and
// all methods agree on every one.
#include <random>

#include "support/leaves.hpp"

using namespace saltus;
using namespace support;

namespace {

struct Cell {
  double current, start, kick;
};

/// x' = current - x; at x = 1 it spikes: x := 0 and z0 counts. Input: the count of its neighbour;
/// z1 is how many of those it has heard, each of which kicks x up.
std::shared_ptr<Leaf> cell(std::string name, const Cell& c) {
  return std::make_shared<Leaf>(std::move(name), [=](Leaf& l) {
    l.declare_input_port({.name = "spikes", .shape = Shape::scalar()});
    l.declare_continuous_state({.initial = vec({c.start}),
                                .ode = [=](const At& at) { return c.current - at.x[0]; },
                                .reads = Reads::continuous_state});
    l.declare_discrete_state(vec({0.0, 0.0}));
    l.declare_output_port({.name = "count",
                           .calc = [](const At& at) { return at.z[0]; },
                           .reads = Reads::discrete_state,
                           .inputs = std::vector<int>{}});
    l.declare_zero_crossing({.name = "heard",
                             .guard = [](const At& at) { return at.u(0) - at.z[1] - 0.5; },
                             .reset_map =
                                 [=](const At& at, Next& next) {
                                   const double heard = at.u(0) - at.z[1];
                                   next.set_continuous_state({at.x[0] + c.kick * heard});
                                   next.set_discrete_state({at.z[0], at.u(0)});
                                 },
                             .direction = Direction::negative_then_non_negative});
    l.declare_zero_crossing({.name = "spike",
                             .guard = [](const At& at) { return at.x[0] - 1.0; },
                             .reset_map =
                                 [](const At& at, Next& next) {
                                   next.set_continuous_state({0.0});
                                   next.set_discrete_state({at.z[0] + 1.0, at.z[1]});
                                 },
                             .direction = Direction::negative_then_non_negative});
  });
}

Results ring(const std::vector<Cell>& cells, Method method) {
  DiagramBuilder builder;
  std::vector<std::shared_ptr<Leaf>> all;
  for (std::size_t i = 0; i < cells.size(); ++i)
    builder.add(all.emplace_back(cell(text("cell_", i), cells[i])));
  for (std::size_t i = 0; i < cells.size(); ++i)
    builder.connect(all[(i + 1) % all.size()]->output("count"), all[i]->input());
  const Diagram diagram = builder.build();
  return simulate(diagram, diagram.create_context(), {0.0, 8.0},
                  {.rtol = 1e-10, .atol = 1e-12, .ode_solver_method = method});
}

}  // namespace

TEST_CASE("3.4 in a ring of cells that set each other off no spike is lost, by any method",
          "[semantics]") {
  std::mt19937 random(9);
  std::uniform_real_distribution<> number(0.0, 1.0);
  for (int i = 0; i < 20; ++i) {
    std::vector<Cell> cells(3 + random() % 4);
    const double kick = 0.15 * number(random);
    for (Cell& c : cells) c = {1.1 + number(random), 0.9 * number(random), kick};
    const auto reference = ring(cells, methods[0]);
    CHECK(reference.events.size() > cells.size());
    for (const Method method : methods) {
      INFO("ring " << i << ", method " << method);
      const auto results = ring(cells, method);
      CHECK(events(results.events) == events(reference.events));
      // Tolerance 1e-10, up to ten flights, each of which passes a deviation on by slope and kick.
      CHECK((results.context.continuous_state() - reference.context.continuous_state()).norm() <
            1e-5);
      const auto& z = results.context.discrete_state();
      for (Index k = 0; k < z.size(); k += 2) CHECK(z[k + 1] == z[(k + 2) % z.size()]);
    }
  }
}
