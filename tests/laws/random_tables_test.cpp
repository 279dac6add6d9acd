// Balls on vibrating tables drawn at random, against flights in long double whose ends are
// bisected; the growth of each scene is measured by disturbing its start.
#include <random>

#include "support/cases.hpp"

using namespace saltus;
using namespace support;

namespace {

using Long = long double;

struct Scenery {
  double amplitude, w, phase, e, y0, v0, g = 9.81;

  Long height(Long t) const { return amplitude * std::sin(w * t + phase); }
  Long velocity(Long t) const { return amplitude * w * std::cos(w * t + phase); }

  /// The first n contacts; fewer where one is too slow, or a graze nearby, for the scene to say
  /// much.
  std::vector<Long> contacts(int n, Long disturbed = 0.0L) const {
    std::vector<Long> times;
    Long t = 0.0L, y = y0 + disturbed, v = v0;
    while (static_cast<int>(times.size()) < n) {
      const auto gap = [&](Long s) { return y + v * s - 0.5L * g * s * s - height(t + s); };
      const Long step = 2e-3L;
      Long a = times.empty() ? 0.0L : 1e-4L;
      while (gap(a + step) > 0.0L) {
        if (gap(a + step) < 1e-4L && gap(a + 2.0L * step) > gap(a + step) && a > 0.02L)
          return times;
        a += step;
      }
      Long b = a + step;
      for (int i = 0; i < 80; ++i) {
        const Long middle = 0.5L * (a + b);
        (gap(middle) > 0.0L ? a : b) = middle;
      }
      const Long vt = velocity(t + b), before = v - g * b;
      t += b, y = height(t), v = vt - e * (before - vt);
      times.push_back(t);
      if (v - vt < 0.3L) return times;
    }
    return times;
  }

  std::shared_ptr<Leaf> leaf() const {
    return make_leaf("ball", [self = *this](Leaf& l) {
      const auto h = [=](const At& at) { return static_cast<double>(self.height(at.time)); };
      l.declare_continuous_state(
          {.initial = vec({self.y0, self.v0}),
           .ode = [=](const At& at, VectorRef xdot) { xdot << at.x[1], -self.g; }});
      l.declare_zero_crossing({.name = "bounce",
                               .guard = [=](const At& at) { return at.x[0] - h(at); },
                               .reset_map =
                                   [=](const At& at, Next& next) {
                                     const auto vt = static_cast<double>(self.velocity(at.time));
                                     next.set_continuous_state(
                                         {h(at), vt - self.e * (at.x[1] - vt)});
                                   },
                               .direction = Direction::positive_then_non_positive});
    });
  }
};

}  // namespace

TEST_CASE("balls on random vibrating tables follow their flights", "[laws][ball][random]") {
  const auto method = GENERATE(from_range(methods));
  std::mt19937 random{20260302};
  const auto real = [&](double low, double high) {
    return std::uniform_real_distribution<>(low, high)(random);
  };
  const double rtol = 1e-10, atol = 1e-12;
  double most = 0.0;
  int contacts = 0;
  for (int n = 0; n < 200; ++n) {
    const Scenery s{.amplitude = real(0.0, 0.1),
                    .w = real(1.0, 20.0),
                    .phase = real(0.0, 6.3),
                    .e = real(0.3, 1.0),
                    .y0 = real(0.3, 2.0),
                    .v0 = real(-2.0, 2.0)};
    const auto exact = s.contacts(6), disturbed = s.contacts(6, 1e-9L);
    if (exact.size() < 3 || disturbed.size() != exact.size()) continue;
    const auto leaf = s.leaf();
    const double last = static_cast<double>(exact.back());
    const auto results =
        simulate(*leaf, leaf->create_context(), {0.0, last + 1e-3},
                 {.rtol = rtol, .atol = atol, .ode_solver_method = method, .throw_errors = false});
    const auto found = firing_times(results.events);
    INFO("scene " << n << ", method " << method << ": A " << s.amplitude << ", w " << s.w
                  << ", phase " << s.phase << ", e " << s.e << ", y0 " << s.y0 << ", v0 " << s.v0);
    CHECK(found.size() == exact.size());
    for (std::size_t k = 0; k < std::min(found.size(), exact.size()); ++k) {
      // What a flight errs: 40 steps with a multistep method, else 200 eps t of a location at a
      // relative speed below 15. The growth from the start to k, or from any contact before it, is
      // at most `growth` so far; an error of speed moves the next contact by 2 / g each.
      const double made =
          (one_step(method) ? 15.0 * 200.0 * eps * last : 40.0 * (rtol * 10.0 + atol));
      double growth = 1.0;
      for (std::size_t i = 0; i <= k; ++i)
        growth = std::max(growth, static_cast<double>(std::abs(disturbed[i] - exact[i])) * 1e9);
      const double allowed_here = made * static_cast<double>(k + 1) * 3.0 * growth;
      most = std::max(most, std::abs(found[k] - static_cast<double>(exact[k])) / allowed_here);
      ++contacts;
    }
  }
  CHECK(contacts > 500);
  within("random tables, error over what is allowed", method, most, 1.0);
}
