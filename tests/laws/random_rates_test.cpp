// Scenes drawn at random, the same ones each time: three states with constant rates in each of
// three modes, guards on levels, resets and mode changes. Between events everything is linear, so a
// few lines here know every event; no method has an error of its own.
#include <random>

#include "support/cases.hpp"

using namespace saltus;
using namespace support;

namespace {

constexpr int states = 3, modes = 3;

struct Guard {
  int state;
  double level;
  int direction;  // +1 upward, -1 downward, 0 both
  int in, out;    // modes; in = -1: any, out = -1: as it is
  int written;    // state that the reset writes, -1: none
  double value;
};

struct Draw {
  Eigen::Matrix3d rates;  // column: mode
  Eigen::Vector3d start;
  std::vector<Guard> guards;

  explicit Draw(std::mt19937& random) {
    std::uniform_real_distribution<> real(-1.0, 1.0);
    const auto any = [&](int low, int high) {
      return std::uniform_int_distribution<>(low, high)(random);
    };
    for (double& rate : rates.reshaped()) rate = real(random);
    for (double& x : start) x = real(random);
    for (int k = any(2, 8); k > 0; --k) {
      const int in = any(-1, modes - 1), written = any(-1, states - 1);
      guards.push_back({any(0, states - 1), real(random), any(-1, 1), in, any(-1, modes - 1),
                        written, 2.0 * real(random)});
      if (guards.back().out < 0 && written < 0) guards.back().out = any(0, modes - 1);
    }
  }

  std::shared_ptr<Leaf> leaf() const {
    return make_leaf("leaf", [self = *this](Leaf& l) {
      l.declare_continuous_state({.initial = self.start, .ode = [=](const At& at, VectorRef xdot) {
                                    xdot = self.rates.col(at.mode);
                                  }});
      l.declare_default_mode(0);
      for (std::size_t k = 0; k < self.guards.size(); ++k) {
        const Guard g = self.guards[k];
        ZeroCrossing crossing{.name = text("guard_", k),
                              .guard = [=](const At& at) { return at.x[g.state] - g.level; }};
        crossing.direction = g.direction > 0   ? Direction::negative_then_non_negative
                             : g.direction < 0 ? Direction::positive_then_non_positive
                                               : Direction::crosses_zero;
        if (g.in >= 0) crossing.start_mode = g.in;
        if (g.out >= 0) crossing.end_mode = g.out;
        if (g.written >= 0) {
          crossing.reset_map = [=](const At& at, Next& next) {
            Eigen::VectorXd x = at.x;
            x[g.written] = g.value;
            next.set_continuous_state(x);
          };
        }
        l.declare_zero_crossing(std::move(crossing));
      }
    });
  }
};

struct Fired {
  std::vector<double> times;
  std::vector<std::string> names;
  double close = infinite;  // the smallest distance of two roots: below 1e-6 a scene says nothing
  bool turned = false;      // some reset put its own guard beyond zero and turned the flow
};

/// All events until t = 10 s, by hand. A guard that a reset or a mode change put beyond zero waits
/// until it has been back where its mode was entered, and fires next where a jump carried it.
Fired by_hand(const Draw& draw) {
  Fired fired;
  Eigen::Vector3d x = draw.start;
  double t = 0.0;
  int mode = 0;
  while (fired.times.size() < 60) {
    double dt = 10.0 - t;
    int next = -1;
    for (std::size_t k = 0; k < draw.guards.size(); ++k) {
      const Guard& g = draw.guards[k];
      const double rate = draw.rates(g.state, mode), away = g.level - x[g.state];
      if (g.in >= 0 && g.in != mode) continue;
      if (std::abs(away) < 1e-9) continue;  // it fired just now, and was passed through
      if (away / rate <= 0.0 || g.direction * rate < 0.0) continue;
      fired.close = std::min(fired.close, std::abs(away / rate - dt));
      if (away / rate < dt) dt = away / rate, next = static_cast<int>(k);
    }
    t += dt;
    x += dt * draw.rates.col(mode);
    if (next < 0) return fired;
    const Guard& g = draw.guards[static_cast<std::size_t>(next)];
    fired.times.push_back(t);
    fired.names.push_back(text("guard_", next));
    const int before = mode;
    const Eigen::Vector3d x_before = x;
    if (g.written >= 0) x[g.written] = g.value;
    if (g.out >= 0) mode = g.out;
    for (const Guard& other : draw.guards) {  // jumped over: a second pass, not for this reference
      const double a = x_before[other.state] - other.level, b = x[other.state] - other.level;
      const bool seen = other.in < 0 || (other.in == mode && before == mode);
      if (seen && &other != &g && (a > 0.0) != (b > 0.0)) return fired.close = 0.0, fired;
      if (std::abs(b) < 1e-6 && &other != &g) return fired.close = 0.0, fired;
    }
    if (g.written == g.state) {
      const double b = x[g.state] - g.level;
      fired.close = std::min(fired.close, std::abs(b));
      fired.turned |= draw.rates(g.state, before) * draw.rates(g.state, mode) < 0.0;
    } else if (g.in < 0 && draw.rates(g.state, before) * draw.rates(g.state, mode) < 0.0) {
      return fired.close = 0.0, fired;  // the flow turns round on the level: not for here
    }
  }
  return fired.close = 0.0, fired;
}

void agrees(Method method) {
  std::mt19937 random{20260301};
  int scenes = 0, events = 0;
  double most = 0.0;
  for (int n = 0; n < 2000; ++n) {
    const Draw draw(random);
    const Fired expected = by_hand(draw);
    if (expected.close < 1e-6 || expected.times.empty()) continue;
    const auto leaf = draw.leaf();
    const auto results = simulate(*leaf, leaf->create_context(), {0.0, 10.0},
                                  {.ode_solver_method = method, .throw_errors = false});
    ++scenes, events += static_cast<int>(expected.times.size());
    INFO("scene " << n << ", method " << method << ": " << to_string(results.status) << " "
                  << results.message);
    CHECK(results.status == Status::reached_end);
    CHECK(firing_names(results.events) == expected.names);
    most = std::max(most, worst(firing_times(results.events), expected.times));
  }
  CHECK(scenes > 200);
  // A location errs by 100 eps (t + h) <= 2000 eps s, which a slow rate, 1e-3 at least among so
  // many, turns into a thousand times as much in the next; sixty events at most.
  within("random constant rates", method, most, 60.0 * 1e3 * 2000.0 * eps);
}

}  // namespace

TEST_CASE("random scenes of constant rates have the events that hand calculation says",
          "[laws][random]") {
  agrees(GENERATE(from_range(methods)));
}

TEST_CASE("random scenes of constant rates that are cut in two have the events of one run",
          "[laws][random]") {
  const auto method = GENERATE(filter(one_step, from_range(methods)));
  std::mt19937 random{20260305};
  int scenes = 0;
  for (int n = 0; n < 1500; ++n) {
    const Draw draw(random);
    const double cut = std::uniform_real_distribution<>(0.0, 10.0)(random);
    const Fired expected = by_hand(draw);
    if (expected.close < 1e-6 || expected.times.empty() || expected.turned) continue;
    const auto near = [&](double t) { return std::abs(t - cut) < 1e-6; };
    if (std::ranges::any_of(expected.times, near)) continue;
    const auto leaf = draw.leaf();
    const SimulatorOptions options{.ode_solver_method = method, .throw_errors = false};
    const auto first = simulate(*leaf, leaf->create_context(), {0.0, cut}, options);
    const auto second = simulate(*leaf, first.context, {cut, 10.0}, options);
    auto names = firing_names(first.events);
    const auto rest = firing_names(second.events);
    names.insert(names.end(), rest.begin(), rest.end());
    INFO("scene " << n << ", method " << method << ", cut " << cut);
    CHECK(names == expected.names);
    ++scenes;
  }
  CHECK(scenes > 150);
}
