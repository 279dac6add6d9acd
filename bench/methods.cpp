// Which method is best when, and what does "auto" cost? Smooth and stiff scenes, without recording,
// by every method at rtol 1e-3 to 1e-12: right-hand-side calls, time, achieved error at the end.
#include <cstdio>
#include <cstring>
#include <string>

#include "ball.hpp"
#include "interleave.hpp"

namespace {

using saltus::At;
using saltus::VectorRef;

/// x' = f(x), with the methods of its runs.
class Flow final : public saltus::LeafSystem {
 public:
  template <class Ode>
  Flow(Eigen::VectorXd start, Ode ode) : LeafSystem("flow") {
    declare_continuous_state({.initial = std::move(start), .ode = ode});
  }
};

/// A leaf with two modes, as the sum of a slow oscillator and x2' = rate (cos t - x2): stiff in
/// mode 1, not in mode 0; they change every second.
class TwoModes final : public saltus::LeafSystem {
 public:
  TwoModes() : LeafSystem("two_modes") {
    declare_continuous_state(
        {.initial = Eigen::Vector3d(1.0, 0.0, 1.0), .ode = [](const At& at, VectorRef xdot) {
           const double rate = at.mode == 1 ? 1e6 : 1.0;
           xdot << 6.0 * at.x[1], -6.0 * at.x[0], rate * (std::cos(at.time) - at.x[2]);
         }});
    declare_default_mode(0);
    for (int i = 0; i < 6; ++i)
      declare_zero_crossing({.name = "switch_" + std::to_string(i),
                             .guard = [i](const At& at) { return at.time - (i + 1.0); },
                             .start_mode = i % 2,
                             .end_mode = 1 - i % 2});
  }
};

Eigen::VectorXd vec(std::initializer_list<double> v) {
  return Eigen::Map<const Eigen::VectorXd>(v.begin(), static_cast<Eigen::Index>(v.size()));
}

struct Problem {
  const char* name;
  std::shared_ptr<const saltus::System> system;
  saltus::Context start;
  double t_end;
  double scale;  ///< atol / rtol
  std::vector<saltus::Method> methods = {};
};

/// Two bodies, eccentricity e, `periods` turns.
Problem kepler(double e, double periods) {
  auto flow = std::make_shared<Flow>(vec({1.0 - e, 0.0, 0.0, std::sqrt((1.0 + e) / (1.0 - e))}),
                                     [](const At& at, VectorRef xdot) {
                                       const double r2 = at.x[0] * at.x[0] + at.x[1] * at.x[1];
                                       const double w = -1.0 / (r2 * std::sqrt(r2));
                                       xdot << at.x[2], at.x[3], w * at.x[0], w * at.x[1];
                                     });
  return {"kepler", flow, flow->create_context(), 6.283185307179586 * periods, 1.0, {}};
}

/// Hairer, Norsett, Wanner I, p. 129, (0.1): the orbit of Arenstorf, one period.
Problem arenstorf() {
  auto flow = std::make_shared<Flow>(
      vec({0.994, 0.0, 0.0, -2.00158510637908252240537862224}), [](const At& at, VectorRef xdot) {
        constexpr double mu = 0.012277471, nu = 1.0 - mu;
        const double x = at.x[0], y = at.x[1];
        const double d1 = std::pow((x + mu) * (x + mu) + y * y, 1.5),
                     d2 = std::pow((x - nu) * (x - nu) + y * y, 1.5);
        xdot << at.x[2], at.x[3], x + 2.0 * at.x[3] - nu * (x + mu) / d1 - mu * (x - nu) / d2,
            y - 2.0 * at.x[2] - nu * y / d1 - mu * y / d2;
      });
  return {"arenstorf", flow, flow->create_context(), 17.0652165601579625588917206249, 1.0, {}};
}

Problem van_der_pol(const char* name, double mu, double t_end) {
  auto flow = std::make_shared<Flow>(vec({2.0, 0.0}), [mu](const At& at, VectorRef xdot) {
    xdot << at.x[1], mu * (1.0 - at.x[0] * at.x[0]) * at.x[1] - at.x[0];
  });
  return {name, flow, flow->create_context(), t_end, 1.0, {}};
}

Problem robertson() {
  auto flow = std::make_shared<Flow>(vec({1.0, 0.0, 0.0}), [](const At& at, VectorRef xdot) {
    const double decay = 0.04 * at.x[0], back = 1e4 * at.x[1] * at.x[2],
                 on = 3e7 * at.x[1] * at.x[1];
    xdot << back - decay, decay - back - on, on;
  });
  return {"robertson", flow, flow->create_context(), 4e10, 1e-4, {}};
}

std::vector<Problem> problems() {
  const auto ball = std::make_shared<bench::BallLeaf>(bench::Ball{.k = 9.81 / 400.0});
  const std::vector<saltus::Method> smooth{saltus::Method::dopri5, saltus::Method::dop853,
                                           saltus::Method::adams, saltus::Method::automatic},
      stiff{saltus::Method::bdf, saltus::Method::automatic};
  std::vector<Problem> all{
      {"drag ball", ball, ball->create_context().with_continuous_state(vec({10.0, 0.0})), 12.0,
       1e-2},
      kepler(0.6, 10.0),
      arenstorf(),
      van_der_pol("vdp 1", 1.0, 100.0)};
  for (auto& p : all) p.methods = smooth;
  const auto modes = std::make_shared<TwoModes>();
  for (Problem p : {van_der_pol("vdp 30", 30.0, 300.0), van_der_pol("vdp 1000", 1e3, 2000.0),
                    robertson(), Problem{"two modes", modes, modes->create_context(), 7.0, 1.0}}) {
    p.methods = stiff;
    all.push_back(std::move(p));
  }
  return all;
}

Eigen::VectorXd end_of(const Problem& p, saltus::Method method, double rtol) {
  saltus::Simulator run(*p.system,
                        {.rtol = rtol, .atol = p.scale * rtol, .ode_solver_method = method});
  run.initialize(p.start);
  run.advance_to(p.t_end);
  return run.results().context.continuous_state();
}

void compare(const Problem& p, double rtol, const Eigen::VectorXd& exact, bool timed) {
  std::vector<std::unique_ptr<saltus::Simulator>> runs;
  std::vector<std::function<void()>> runners;
  for (saltus::Method method : p.methods) {
    auto& run = runs.emplace_back(std::make_unique<saltus::Simulator>(
        *p.system, saltus::SimulatorOptions{
                       .rtol = rtol, .atol = p.scale * rtol, .ode_solver_method = method}));
    runners.push_back([&p, &run = *run] { run.initialize(p.start), run.advance_to(p.t_end); });
  }
  std::vector<bench::Timing> timings(runs.size());
  if (timed)
    timings = bench::interleave(runners, 7);
  else
    for (const auto& runner : runners) runner();
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const saltus::Results& r = runs[i]->results();
    const double error = (r.context.continuous_state() - exact).cwiseAbs().maxCoeff();
    std::printf("%-10s %6.0e  %-7s %10.1f us %6.2f  %8ld steps %9ld rhs %6.2f  %8.1e  %s\n", p.name,
                rtol, to_string(p.methods[i]).data(), timings[i].time * 1e6, timings[i].ratio,
                r.statistics.steps, r.statistics.right_hand_side_calls,
                static_cast<double>(r.statistics.right_hand_side_calls) /
                    static_cast<double>(runs[0]->results().statistics.right_hand_side_calls),
                error, r.statistics.method.substr(0, 90).c_str());
  }
}

}  // namespace

/// Arguments: "calls" omits the times; the beginning of a problem's name chooses that problem.
int main(int argc, char** argv) {
  const bool timed = argc < 2 || std::strcmp(argv[1], "calls") != 0;
  const char* only = argc > 2 ? argv[2] : "";
  std::printf("ratios to the first method of the problem\n");
  for (const Problem& p : problems()) {
    if (std::strncmp(p.name, only, std::strlen(only)) != 0) continue;
    const bool stiff = p.methods[0] == saltus::Method::bdf;
    const Eigen::VectorXd exact =
        end_of(p, stiff ? saltus::Method::bdf : saltus::Method::dop853, 1e-13);
    for (int digits = 3; digits <= 12; ++digits) compare(p, std::pow(10.0, -digits), exact, timed);
  }
}
