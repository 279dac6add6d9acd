// Expressions drawn at random from a seed, and their values by other means than a tape.
#pragma once

#include <array>
#include <complex>
#include <vector>

#include "saltus/tape/graph.hpp"

namespace support {

/// Steps over earlier ones; the first `variables` of them are states.
struct RandomExpression {
  struct Step {
    saltus::tape::Op op = saltus::tape::Op::constant;
    std::array<std::size_t, 3> from = {};
    double value = 0.0;  ///< of a constant
  };
  std::size_t variables = 0;
  std::vector<Step> steps = {};
  std::vector<std::size_t> outputs = {};
  bool analytic = true;  ///< complex numbers can go through all of it
};

/// Gives the same expression for the same seed. Values stay between about 1e-3 and 1e3, and away
/// from the ends of the domain of each operation.
RandomExpression random_expression(unsigned seed);

/// The outputs as nodes of a graph, of states 0, 1, ... or of any other nodes.
std::vector<saltus::tape::Node> write(const RandomExpression& e, saltus::tape::Graph& graph);
std::vector<saltus::tape::Node> write(const RandomExpression& e, saltus::tape::Graph& graph,
                                      const std::vector<saltus::tape::Node>& variables);

/// The outputs in the arithmetic of a number type: double, long double, std::complex<double>.
template <class Number>
std::vector<Number> evaluate(const RandomExpression& e, const std::vector<Number>& x);

}  // namespace support
