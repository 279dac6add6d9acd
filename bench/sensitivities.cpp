// What do the derivatives of a run cost? Two kinds of prey and two that eat
// them, x_i' = x_i (r_i - sum_j a_ij x_j), in an orbit that does not end, without and
// with the derivatives by 1 to 16 of their parameters, in plain runs; and a ball with drag on a floor,
// by its 4 parameters. dopri5 at rtol 1e-6, dop853 at 1e-8. `sensitivities species dopri5 4 2` makes
// one run by 4 parameters, twice as long, for callgrind.
#include <cstdlib>
#include <string>

#include "interleave.hpp"
#include "runner.hpp"
#include "sheet.hpp"

namespace {

using namespace saltus;
using bench::Runner;

constexpr Index species = 4, most = 16;

class Species final : public LeafSystem {
 public:
  Species() : LeafSystem("species") {
    const double growth[] = {1.0, -1.0, 0.9, -0.8};
    const double eaten[species][species] = {
        {0.0, 1.0, 0.0, 0.1}, {-1.0, 0.0, 0.0, 0.0}, {0.0, 0.0, 0.0, 1.0}, {-0.1, 0.0, -1.0, 0.0}};
    std::vector<ParameterIndex> rates, weights;
    for (Index i = 0; i < species; ++i) {
      rates.push_back(declare_dynamic_parameter(text("r", i), growth[i]));
      for (Index j = 0; j < species; ++j)
        weights.push_back(declare_dynamic_parameter(text("a", species * i + j), eaten[i][j]));
    }
    declare_continuous_state(
        {.initial = Eigen::Vector4d(1.5, 1.0, 1.0, 0.6),
         .ode = equations<static_cast<int>(species)>([=](const auto& at, auto& xdot) {
           for (Index i = 0; i < species; ++i) {
             auto sum = at.p(rates[static_cast<std::size_t>(i)], 0) * 1.0;
             for (Index j = 0; j < species; ++j)
               sum = sum - at.p(weights[static_cast<std::size_t>(i * species + j)], 0) * at.x(j);
             xdot[static_cast<std::size_t>(i)] = at.x(i) * sum;
           }
         })});
  }
};

/// y'' = -g - k v |v|; at y = 0 the speed becomes -e v.
class Ball final : public LeafSystem {
 public:
  Ball() : LeafSystem("ball") {
    const ParameterIndex g = declare_dynamic_parameter("g", 9.81);
    const ParameterIndex k = declare_dynamic_parameter("k", 0.02);
    const ParameterIndex e = declare_dynamic_parameter("e", 0.9);
    declare_continuous_state({.initial = Eigen::Vector2d(10.0, 0.0),
                              .ode = equations<2>([=](const auto& at, auto& xdot) {
                                xdot[0] = at.x(1);
                                xdot[1] = -at.p(g, 0) - at.p(k, 0) * at.x(1) * abs(at.x(1));
                              })});
    declare_zero_crossing(
        {.name = "bounce",
         .reset_map = [=](const At& at,
                          Next& next) { next.set_continuous_state({at.x[0], -at.p[e] * at.x[1]}); },
         .direction = Direction::positive_then_non_positive,
         .formula = Formula([](const auto& at) { return at.x(0); })});
  }
};

std::vector<std::string> names(const std::string& scene, Index count) {
  std::vector<std::string> all{"g", "k", "e", "x[0]"};
  if (scene == "species") {
    all.clear();
    for (Index i = 0; i < most; ++i) all.push_back(text("a", i));
  }
  all.resize(static_cast<std::size_t>(count));
  return all;
}

Runner run(const std::string& scene, const std::string& method, Index count, double stretch) {
  const bool low = method == "dopri5";
  SimulatorOptions options{.rtol = low ? 1e-6 : 1e-8,
                           .atol = low ? 1e-8 : 1e-10,
                           .ode_solver_method = low ? Method::dopri5 : Method::dop853};
  options.sensitivity = names(scene, count);
  std::shared_ptr<const System> system;
  if (scene == "species")
    system = std::make_shared<Species>();
  else
    system = std::make_shared<Ball>();
  return {system, system->create_context(), (scene == "species" ? 40.0 : 10.0) * stretch, options};
}

void compare(bench::Sheet& sheet, const std::string& scene, const std::string& method) {
  const std::vector<Index> counts =
      scene == "species" ? std::vector<Index>{0, 1, 2, 4, 8, 16} : std::vector<Index>{0, 1, 4};
  std::vector<Runner> runners;
  for (const Index count : counts) runners.push_back(run(scene, method, count, 1.0));
  std::vector<std::function<void()>> calls;
  for (Runner& one : runners) calls.push_back([&one] { one(); });
  const auto times = bench::interleave(calls, 21);
  for (std::size_t i = 1; i < counts.size(); ++i) {
    const auto p = static_cast<double>(counts[i]);
    sheet.add({{"scene", scene},
               {"method", method},
               {"parameters", counts[i]},
               {"plain [us]", times[0].time * 1e6},
               {"with [us]", times[i].time * 1e6},
               {"ratio", times[i].ratio},
               {"1 + 0.6 p", 1.0 + 0.6 * p}});
    sheet.target(text(scene, ", ", method, ", p = ", counts[i]), times[i].ratio, 1.0 + 0.6 * p);
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc == 5) {
    run(argv[1], argv[2], std::atoi(argv[3]), std::atof(argv[4]))();
    return 0;
  }
  bench::Sheet sheet("sensitivities", "What do the derivatives of a run by p parameters cost?");
  for (const char* scene : {"species", "ball"})
    for (const char* method : {"dopri5", "dop853"}) compare(sheet, scene, method);
}
