// Short ways to expand a solution, and the coefficients by other means than a series.
#pragma once

#include "saltus/tape/jacobian.hpp"
#include "saltus/tape/series.hpp"
#include "support/tape_world.hpp"

namespace support {

using Numbers = std::vector<double>;

inline std::size_t size(saltus::Index n) { return static_cast<std::size_t>(n); }

/// Row k holds the coefficients of order k of all states.
inline Numbers expanded(saltus::tape::Series& series, const World& world, int order,
                        const char* held = nullptr) {
  Numbers x(size((order + 1) * series.states()), -99.0);
  world.show([&](const saltus::At& at) { series.expand(at, order, held, x.data()); });
  return x;
}

/// Row m holds the coefficients of output m, after `expanded` to the same order.
inline Numbers outputs_of(saltus::tape::Series& series, int order) {
  Numbers g(size((order + 1) * series.outputs()), -99.0);
  series.expand_outputs(0, series.outputs(), g.data());
  return g;
}

/// The coefficients of one function of x(t), x' = 1, to `order`.
inline Numbers along(saltus::tape::Node (*make)(saltus::tape::Graph& g, saltus::tape::Node x),
                     double at, int order, double parameter = 0.0) {
  saltus::tape::Graph g;
  saltus::tape::Series series(g, std::array{g.constant(1.0)},
                              std::array{make(g, g.continuous_state(0))});
  expanded(series, {.x = {at}, .p = {parameter}}, order);
  return outputs_of(series, order);
}

/// The same coefficients by repeated differentiation of the graph: u' = du/dt + sum of du/dx_i f_i.
inline Numbers by_derivatives(saltus::tape::Graph& g, const std::vector<saltus::tape::Node>& rates,
                              std::vector<saltus::tape::Node> outputs, const World& world,
                              int order) {
  using namespace saltus::tape;
  std::vector<Node> variables{g.time()}, speeds{g.constant(1.0)};
  for (std::size_t i = 0; i < rates.size(); ++i) {
    variables.push_back(g.continuous_state(static_cast<saltus::Index>(i)));
    speeds.push_back(rates[i]);
  }
  const std::size_t count = outputs.size(), row = size(order + 1);
  Numbers all(count * row);
  double factorial = 1.0;
  for (int k = 0; k <= order; factorial *= ++k) {
    const Numbers now = values_of(Tape(g, outputs), world);
    for (std::size_t m = 0; m < count; ++m) all[m * row + size(k)] = now[m] / factorial;
    std::vector<Node> next(count, g.constant(0.0));
    for (const Partial& partial : differentiate(g, outputs, variables)) {
      Node& sum = next[size(partial.row)];
      const Node term = g.binary(Op::mul, partial.value, speeds[size(partial.column)]);
      sum = g.binary(Op::add, sum, term);
    }
    outputs = next;
  }
  return all;
}

/// The polynomial with these coefficients at h.
inline double polynomial(const double* coefficients, int order, double h) {
  double sum = 0.0;
  for (int k = order; k >= 0; --k) sum = sum * h + coefficients[k];
  return sum;
}

}  // namespace support
