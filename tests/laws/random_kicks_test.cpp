// Oscillators drawn at random, the same ones each time, that are kicked where x or v reaches a
// level: between kicks a circle, so each event has a closed form.
#include <random>

#include "support/cases.hpp"

using namespace saltus;
using namespace support;

namespace {

const double pi = std::acos(-1.0);

struct Kick {
  bool of_x;  // the guard looks at x, else at v
  double level;
  int direction;  // +1 upward, -1 downward
  double scale;   // of v, at the kick
  double push;    // on v
};

/// x' = v, v' = -x.
struct Oscillator {
  double x, v;
  std::vector<Kick> kicks;

  explicit Oscillator(std::mt19937& random) {
    const auto real = [&](double low, double high) {
      return std::uniform_real_distribution<>(low, high)(random);
    };
    x = real(-1.0, 1.0), v = real(-1.0, 1.0);
    for (int k = std::uniform_int_distribution<>(1, 4)(random); k > 0; --k)
      kicks.push_back({real(0.0, 1.0) < 0.5, real(-1.0, 1.0), real(0.0, 1.0) < 0.5 ? 1 : -1,
                       real(-1.0, 1.0), real(-0.5, 0.5)});
  }

  std::shared_ptr<Leaf> leaf() const {
    return make_leaf("oscillator", [self = *this](Leaf& l) {
      l.declare_continuous_state(
          {.initial = vec({self.x, self.v}),
           .ode = [](const At& at, VectorRef xdot) { xdot << at.x[1], -at.x[0]; }});
      for (std::size_t k = 0; k < self.kicks.size(); ++k) {
        const Kick kick = self.kicks[k];
        l.declare_zero_crossing(
            {.name = text("kick_", k),
             .guard = [=](const At& at) { return at.x[kick.of_x ? 0 : 1] - kick.level; },
             .reset_map =
                 [=](const At& at, Next& next) {
                   next.set_continuous_state({at.x[0], kick.scale * at.x[1] + kick.push});
                 },
             .direction = kick.direction > 0 ? Direction::negative_then_non_negative
                                             : Direction::positive_then_non_positive});
      }
    });
  }
};

struct Course {
  std::vector<double> times;
  std::vector<std::string> names;
  double growth = 1.0;  // of an error of the start, until the last event
  bool sound = true;    // no graze, no tie, no jump over another level
};

Course by_hand(const Oscillator& o, double end) {
  Course course;
  double x = o.x, v = o.v, t = 0.0;
  for (int just = -1; course.sound && course.times.size() < 40;) {
    // x = r cos(s + a), v = -r sin(s + a).
    const double r = std::hypot(x, v), a = std::atan2(-v, x);
    double dt = end - t, tie = infinite;
    int next = -1;
    for (int k = 0; k < static_cast<int>(o.kicks.size()); ++k) {
      const Kick& kick = o.kicks[static_cast<std::size_t>(k)];
      course.sound &= std::abs(r - std::abs(kick.level)) > 1e-2;  // grazing
      if (r < std::abs(kick.level)) continue;
      // x falls through the level at s + a = acos, v at s + a = asin(-level / r), and so on.
      const double c = std::acos(kick.level / r);
      double at = kick.of_x ? (kick.direction < 0 ? c : -c)
                            : (kick.direction < 0 ? c - 0.5 * pi : -c - 0.5 * pi);
      at = std::fmod(at - a + 6.0 * pi, 2.0 * pi);
      if (k == just && (at < 1e-9 || at > 2.0 * pi - 1e-9)) at = 2.0 * pi;
      tie = std::min({tie, std::abs(at - dt), at});
      if (at < dt) dt = at, next = k;
    }
    course.sound &= tie > 1e-4;
    t += dt;
    const double xe = r * std::cos(a + dt), ve = -r * std::sin(a + dt);
    if (next < 0) return course;
    const Kick& kick = o.kicks[static_cast<std::size_t>(next)];
    course.times.push_back(t), course.names.push_back(text("kick_", next));
    x = xe, v = kick.scale * ve + kick.push, just = next;
    // The time of an event moves by the error over the slope; the kick turns that into an error of
    // its own: the saltation matrix, in the norm, generously.
    const double slope = std::abs(kick.of_x ? ve : xe);
    course.growth *= 1.0 + (std::abs(x) + std::abs(v) + r) / slope;
    course.sound &= slope > 0.05;
    for (int k = 0; k < static_cast<int>(o.kicks.size()); ++k) {
      const Kick& other = o.kicks[static_cast<std::size_t>(k)];
      if (other.of_x && k != next) course.sound &= std::abs(x - other.level) > 1e-3;
      if (other.of_x) continue;
      const double before = ve - other.level, after = v - other.level;
      course.sound &= std::abs(after) > 1e-3 && (k == next || before * after > 0.0);
    }
    // Turned round on its own surface it were a contact; put beyond its own level it would wait.
    course.sound &= kick.of_x ? ve * v > 1e-3 : kick.direction * (v - kick.level) < 0.0;
  }
  course.sound = false;
  return course;
}

void agree(Method method) {
  std::mt19937 random{20260304};
  const double rtol = 1e-10, atol = 1e-12, end = 20.0;
  int scenes = 0;
  double most = 0.0;
  for (int n = 0; n < 6000; ++n) {
    const Oscillator oscillator(random);
    const Course course = by_hand(oscillator, end);
    if (!course.sound || course.times.empty() || course.growth > 1e4) continue;
    const auto leaf = oscillator.leaf();
    const auto results =
        simulate(*leaf, leaf->create_context(), {0.0, end},
                 {.rtol = rtol, .atol = atol, .ode_solver_method = method, .throw_errors = false});
    ++scenes;
    INFO("scene " << n << ", method " << method << ": " << to_string(results.status) << " "
                  << results.message);
    CHECK(results.status == Status::reached_end);
    CHECK(firing_names(results.events) == course.names);
    most = std::max(most, worst(firing_times(results.events), course.times) / course.growth);
  }
  CHECK(scenes > 100);
  // Ten local errors (BDF: a hundred) a second, of a circle of radius 2 at most, over a slope of
  // 0.05.
  within("random kicks, over the growth", method, most,
         allowed(method, rtol, atol, 2.0, end) / 0.05);
}

}  // namespace

TEST_CASE("random kicked oscillators have the events of their circles", "[laws][random]") {
  agree(GENERATE(from_range(methods)));
}
