// What does one expansion of a solution into a Taylor series cost? `series kepler 20 1000000`
// expands one model that many times to that order, for callgrind.
#include <saltus/tape/series.hpp>
#include <saltus/tape/symbol.hpp>

#include <cmath>
#include <cstdlib>
#include <cstring>

#include "interleave.hpp"
#include "sheet.hpp"

namespace {

using namespace saltus;
using tape::Symbol;
using Symbols = std::vector<Symbol>;

/// Two bodies in a plane: position, velocity.
void kepler(const Symbols& x, Symbols& xdot) {
  const Symbol square = x[0] * x[0] + x[1] * x[1];
  const Symbol cube = square * sqrt(square);
  xdot = {x[2], x[3], -x[0] / cube, -x[1] / cube};
}

/// The same with a power.
void kepler_power(const Symbols& x, Symbols& xdot) {
  const Symbol cube = Symbol::apply(tape::Op::pow, {x[0] * x[0] + x[1] * x[1], -1.5});
  xdot = {x[2], x[3], -x[0] * cube, -x[1] * cube};
}

void pendulum(const Symbols& x, Symbols& xdot) { xdot = {x[1], -9.8 * sin(x[0])}; }

void lorenz(const Symbols& x, Symbols& xdot) {
  xdot = {10.0 * (x[1] - x[0]), x[0] * (28.0 - x[2]) - x[1], x[0] * x[1] - 8.0 / 3.0 * x[2]};
}

/// Seven bodies of mass 1 ... 7: all x, all y, then their velocities.
void pleiades(const Symbols& x, Symbols& xdot) {
  for (std::size_t i = 0; i < 14; ++i) xdot[i] = x[14 + i];
  for (std::size_t i = 0; i < 7; ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const Symbol dx = x[j] - x[i], dy = x[7 + j] - x[7 + i];
      const Symbol square = dx * dx + dy * dy;
      const Symbol cube = square * sqrt(square);
      const double of_i = static_cast<double>(i) + 1.0, of_j = static_cast<double>(j) + 1.0;
      xdot[14 + i] += of_j * (dx / cube);
      xdot[21 + i] += of_j * (dy / cube);
      xdot[14 + j] -= of_i * (dx / cube);
      xdot[21 + j] -= of_i * (dy / cube);
    }
  }
}

struct Model {
  const char* name;
  void (*rates)(const Symbols& x, Symbols& xdot);
  std::vector<double> x;
};

const std::vector<Model>& models() {
  static const std::vector<Model> all{
      {"kepler", kepler, {0.4, 0.0, 0.0, 2.0}},
      {"kepler with pow", kepler_power, {0.4, 0.0, 0.0, 2.0}},
      {"pendulum", pendulum, {0.05, 0.1}},
      {"lorenz", lorenz, {1.0, 2.0, 20.0}},
      {"pleiades", pleiades, {3.0, 3.0,  -1.0, -3.0,  2.0, -2.0, 2.0,   //
                              3.0, -3.0, 2.0,  0.0,   0.0, -4.0, 4.0,   //
                              0.0, 0.0,  0.0,  0.0,   0.0, 1.75, -1.5,  //
                              0.0, 0.0,  0.0,  -1.25, 1.0, 0.0,  0.0}}};
  return all;
}

tape::Series series_of(const Model& model) {
  tape::Graph graph;
  Symbols x, xdot(model.x.size());
  for (std::size_t i = 0; i < xdot.size(); ++i) {
    x.emplace_back(graph, graph.continuous_state(static_cast<Index>(i)));
  }
  model.rates(x, xdot);
  std::vector<tape::Node> rates;
  for (const Symbol& symbol : xdot) rates.push_back(symbol.in(graph));
  return {graph, rates, {}};
}

/// Expands one after the other; each point depends on the last coefficient of the one before, as
/// the steps of a solver do.
class Caller {
 public:
  explicit Caller(const Model& model)
      : series_(series_of(model)), x_(model.x), coefficients_(x_.size() * 31) {}
  void operator()(int order, int calls) {
    const Bases bases{x_.data(), nullptr, nullptr, nullptr};
    const auto n = static_cast<Index>(x_.size());
    for (int i = 0; i < calls; ++i) {
      const At at{0.0,    {x_.data(), n}, {nullptr, 0}, {nullptr, 0}, 0, Inputs(nullptr, 0, &bases),
                  nullptr};
      series_.expand(at, order, nullptr, coefficients_.data());
      x_[0] += 1e-300 * coefficients_[x_.size() * static_cast<std::size_t>(order)];
    }
  }

 private:
  tape::Series series_;
  std::vector<double> x_, coefficients_;
};

}  // namespace

int main(int count, char** arguments) {
  if (count == 4) {  // MODEL ORDER CALLS
    for (const Model& model : models()) {
      if (std::strcmp(model.name, arguments[1]) != 0) continue;
      Caller caller(model);
      caller(std::atoi(arguments[2]), std::atoi(arguments[3]));
    }
    return 0;
  }
  bench::Sheet sheet("series", "What does one expansion into a Taylor series cost?");
  for (const Model& model : models()) {
    Caller caller(model);
    constexpr int calls = 100;
    const auto times = bench::interleave({[&] { caller(8, calls); }, [&] { caller(13, calls); },
                                          [&] { caller(15, calls); }, [&] { caller(20, calls); }},
                                         51, 1e-3);
    const auto nanoseconds = [&](std::size_t i) { return times[i].time * 1e9 / calls; };
    sheet.add({{"model", model.name},
               {"order 8 [ns]", nanoseconds(0)},
               {"order 13 [ns]", nanoseconds(1)},
               {"order 15 [ns]", nanoseconds(2)},
               {"order 20 [ns]", nanoseconds(3)}});
  }
}
