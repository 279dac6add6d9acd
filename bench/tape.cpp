// What does a tape cost, against the same equations as a C++ callback? Both are called as the
// engine calls them, through VectorFunction. `tape ball cpp 1000000` calls one of them that many
// times, for callgrind.
#include <saltus/tape/jacobian.hpp>
#include <saltus/tape/symbol.hpp>

#include <cmath>
#include <cstdlib>
#include <cstring>
#include <functional>

#include "interleave.hpp"
#include "sheet.hpp"

namespace {

using namespace saltus;
using tape::Symbol;

struct Ball {
  static constexpr const char* name = "ball";
  static constexpr int size = 2;
  template <class T>
  static void ode(const T* x, const T* p, T* xdot) {
    xdot[0] = x[1];
    xdot[1] = -p[0];
  }
};

struct VanDerPol {
  static constexpr const char* name = "van_der_pol";
  static constexpr int size = 2;
  template <class T>
  static void ode(const T* x, const T* p, T* xdot) {
    xdot[0] = x[1];
    xdot[1] = p[0] * (1.0 - x[0] * x[0]) * x[1] - x[0];
  }
};

struct Lorenz {
  static constexpr const char* name = "lorenz";
  static constexpr int size = 3;
  template <class T>
  static void ode(const T* x, const T* p, T* xdot) {
    xdot[0] = p[0] * (x[1] - x[0]);
    xdot[1] = x[0] * (p[1] - x[2]) - x[1];
    xdot[2] = x[0] * x[1] - p[2] * x[2];
  }
};

struct Pendulum {
  static constexpr const char* name = "pendulum";
  static constexpr int size = 2;
  template <class T>
  static void ode(const T* x, const T* p, T* xdot) {
    using std::sin;
    xdot[0] = x[1];
    xdot[1] = -p[0] * sin(x[0]) - p[1] * x[1];
  }
};

/// Heat along a rod of n cells.
template <int n>
struct Chain {
  static constexpr const char* name = n == 20 ? "chain of 20" : "chain of 1000";
  static constexpr int size = n;
  template <class T>
  static void ode(const T* x, const T* p, T* xdot) {
    xdot[0] = p[0] * (x[1] - x[0]);
    for (int i = 1; i < n - 1; ++i) xdot[i] = p[0] * (x[i - 1] - 2.0 * x[i] + x[i + 1]);
    xdot[n - 1] = p[0] * (x[n - 2] - x[n - 1]);
  }
};

/// n / 2 masses on springs that harden: q' = v, v' = the forces of both neighbours.
template <int n>
struct Springs {
  static constexpr const char* name = "springs, 20";
  static constexpr int size = n;
  template <class T>
  static void ode(const T* x, const T* p, T* xdot) {
    constexpr int m = n / 2;
    const auto force = [&](const T& d) { return d * (p[0] + p[1] * (d * d)); };
    for (int i = 0; i < m; ++i) {
      const T right = i + 1 < m ? x[i + 1] - x[i] : -x[i];
      const T left = i > 0 ? x[i] - x[i - 1] : x[i] * p[2];
      xdot[i] = x[m + i];
      xdot[m + i] = force(right) - force(left);
    }
  }
};

template <class Model>
VectorFunction callback() {
  return [](const At& at, VectorRef xdot) { Model::ode(at.x.data(), at.p.data(), xdot.data()); };
}

template <class Model>
tape::Tape traced() {
  tape::Graph graph;
  std::vector<Symbol> x, p, xdot(Model::size);
  for (int i = 0; i < Model::size; ++i) x.emplace_back(graph, graph.continuous_state(i));
  for (int i = 0; i < 3; ++i) p.emplace_back(graph, graph.parameter(i));
  Model::ode(x.data(), p.data(), xdot.data());
  std::vector<tape::Node> outputs;
  for (const Symbol& symbol : xdot) outputs.push_back(symbol.in(graph));
  return {graph, outputs};
}

/// Calls a function as a solver does: each state depends on the previous derivative.
class Caller {
 public:
  Caller(VectorFunction function, int size)
      : function_(std::move(function)), x_(static_cast<std::size_t>(size)), xdot_(x_.size()) {
    for (std::size_t i = 0; i < x_.size(); ++i) x_[i] = 0.1 + 0.01 * static_cast<double>(i % 20);
  }
  void operator()(int calls) {
    const Bases bases{x_.data(), nullptr, p_, nullptr};
    const auto n = static_cast<Index>(x_.size());
    for (int i = 0; i < calls; ++i) {
      const At at{0.0,    {x_.data(), n}, {nullptr, 0}, {p_, 3}, 0, Inputs(nullptr, 0, &bases),
                  nullptr};
      function_(leaf(), at, VectorRef(xdot_.data(), n));
      x_[0] += 1e-12 * xdot_[static_cast<std::size_t>(n) - 1];
    }
  }
  const std::vector<double>& last() const { return xdot_; }

 private:
  /// No callback uses its leaf.
  static const LeafSystem& leaf() {
    static const double nothing = 0.0;
    return reinterpret_cast<const LeafSystem&>(nothing);
  }
  VectorFunction function_;
  std::vector<double> x_, xdot_;
  double p_[3] = {1.5, 0.25, 0.75};
};

struct Pair {
  const char* name;
  double limit;
  Caller cpp, tape;
  int instructions;
};

template <class Model>
Pair pair(double limit) {
  const tape::Tape tape = traced<Model>();
  return {Model::name, limit, Caller(callback<Model>(), Model::size),
          Caller(as_vector_function(tape), Model::size), tape.instruction_count()};
}

std::vector<Pair> all() {
  return {pair<Ball>(1.5),        pair<VanDerPol>(1.5), pair<Lorenz>(1.5),     pair<Pendulum>(1.5),
          pair<Springs<20>>(6.0), pair<Chain<20>>(4.0), pair<Chain<1000>>(4.0)};
}

void compare(bench::Sheet& sheet, Pair& pair) {
  constexpr int calls = 100;
  const auto times =
      bench::interleave({[&] { pair.cpp(calls); }, [&] { pair.tape(calls); }}, 51, 1e-3);
  pair.cpp = Caller(pair.cpp), pair.tape = Caller(pair.tape);
  sheet.add({{"model", pair.name},
             {"instructions", pair.instructions},
             {"C++ [ns]", times[0].time * 1e9 / calls},
             {"tape [ns]", times[1].time * 1e9 / calls},
             {"ratio", times[1].ratio}});
  sheet.target(text(pair.name, ": tape against C++"), times[1].ratio, pair.limit);
}

}  // namespace

int main(int count, char** arguments) {
  auto pairs = all();
  if (count == 4) {  // MODEL cpp|tape CALLS
    for (Pair& pair : pairs) {
      if (std::strcmp(pair.name, arguments[1]) != 0) continue;
      (std::strcmp(arguments[2], "cpp") == 0 ? pair.cpp : pair.tape)(std::atoi(arguments[3]));
    }
    return 0;
  }
  bench::Sheet sheet("tape", "What does a tape cost, against the same equations in C++?");
  for (Pair& pair : pairs) compare(sheet, pair);
}
