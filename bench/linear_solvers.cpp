// Which linear solver is best when? The same scene runs on BDF with each of them, in turns: bands
// of several widths, a square and a cube of diffusing points, blocks where every state is coupled
// to every other. The ratio is to the solver that "auto" chooses, which the last column names.
// `factor` is the time of one set-up of the linear solver, from the difference of two solvers; the
// rule in src/solver/linear/choice.cpp is fitted to it.
#include <cstdio>
#include <string>

#include "interleave.hpp"
#include "saltus/saltus.hpp"

namespace {

using namespace saltus;

/// x_i' = sum over the neighbours j of (x_j - x_i) rate - x_i^3 + 1, for these neighbours.
class Diffusion final : public LeafSystem {
 public:
  Diffusion(Index n, const std::vector<std::pair<Index, Index>>& pairs, double rate)
      : LeafSystem("diffusion") {
    std::vector<MatrixEntry> entries;
    for (Index i = 0; i < n; ++i) entries.push_back({i, i});
    for (const auto& [i, j] : pairs) entries.push_back({i, j}), entries.push_back({j, i});
    const Eigen::VectorXd start = (Eigen::ArrayXd::LinSpaced(n, 0.0, 9.0).sin() + 1.0).matrix();
    declare_continuous_state({.initial = start, .ode = [=](const At& at, VectorRef xdot) {
                                for (Index i = 0; i < n; ++i)
                                  xdot[i] = 1.0 - at.x[i] * at.x[i] * at.x[i];
                                for (const auto& [i, j] : pairs) {
                                  const double flow = rate * (at.x[j] - at.x[i]);
                                  xdot[i] += flow, xdot[j] -= flow;
                                }
                              }});
    declare_sparse_jacobian(entries, [=](const At& at, VectorRef out) {
      for (Index i = 0; i < n; ++i) out[i] = -3.0 * at.x[i] * at.x[i];
      Index k = n;
      for (const auto& [i, j] : pairs) {
        out[i] -= rate, out[j] -= rate;
        out[k++] = rate, out[k++] = rate;
      }
    });
  }
};

using Pairs = std::vector<std::pair<Index, Index>>;

/// Each point is coupled to the next `width`.
Pairs band(Index n, Index width) {
  Pairs pairs;
  for (Index i = 0; i < n; ++i)
    for (Index j = i + 1; j <= std::min(n - 1, i + width); ++j) pairs.emplace_back(i, j);
  return pairs;
}

/// Points of a box, each with its neighbours.
Pairs box(Index a, Index b, Index c) {
  Pairs pairs;
  for (Index x = 0; x < a; ++x)
    for (Index y = 0; y < b; ++y)
      for (Index z = 0; z < c; ++z) {
        const Index k = (x * b + y) * c + z;
        if (z + 1 < c) pairs.emplace_back(k, k + 1);
        if (y + 1 < b) pairs.emplace_back(k, k + c);
        if (x + 1 < a) pairs.emplace_back(k, k + b * c);
      }
  return pairs;
}

void compare(const std::string& name, Index n, const Pairs& pairs,
             const std::vector<std::string>& solvers) {
  const Diffusion scene(n, pairs, 1e3);
  const Context start = scene.create_context();
  std::vector<Simulator> simulators;
  std::vector<std::function<void()>> runs;
  std::vector<std::string> all{"auto"};
  all.insert(all.end(), solvers.begin(), solvers.end());
  for (const std::string& solver : all)
    simulators.emplace_back(scene, SimulatorOptions{.rtol = 1e-5,
                                                    .atol = 1e-5,
                                                    .ode_solver_method = Method::bdf,
                                                    .linear_solver = linear_solver_from(solver)});
  for (Simulator& simulator : simulators)
    runs.emplace_back([&] { simulator.initialize(start), simulator.advance_to(1.0); });
  const auto times = bench::interleave(runs, n < 1000 ? 9 : 3, 2e-3);
  for (std::size_t i = 0; i < all.size(); ++i) {
    const auto& s = simulators[i].results().statistics;
    std::printf("%-10s %6td  %-7s %10.3f ms %8.3f  %4ld %4ld  %s\n", name.c_str(), n,
                all[i].c_str(), times[i].time * 1e3, times[i].ratio, static_cast<long>(s.steps),
                static_cast<long>(s.linear_setups), i == 0 ? s.linear_solver.c_str() : "");
  }
  std::fflush(stdout);
}

}  // namespace

int main() {
  std::printf("scene      states  solver          time     ratio  steps setups  chosen\n");
  const std::vector<std::string> all{"dense", "band", "sparse", "gmres"},
      large{"band", "sparse", "gmres"};
  for (const Index n : {6, 12, 24, 48, 100, 300}) {
    compare("all meet", n, band(n, n), {"dense", "band", "sparse"});
    compare("band 1", n, band(n, 1), all);
    compare("band 4", n, band(n, 4), all);
  }
  for (const Index width : {1, 4, 16, 64})
    compare("band " + std::to_string(width), 2000, band(2000, width), large);
  for (const Index side : {10, 20, 40, 80})
    compare("square", side * side, box(1, side, side), large);
  compare("square", 200 * 200, box(1, 200, 200), {"sparse", "gmres"});
  for (const Index side : {6, 12})
    compare("cube", side * side * side, box(side, side, side), large);
  compare("cube", 24 * 24 * 24, box(24, 24, 24), {"sparse", "gmres"});
}
