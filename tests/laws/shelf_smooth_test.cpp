// The stiff and smooth half of the shelf against its references, with every method that suits a
// scene; and the references against the equations. The references come from shelf_radau/.
#include <saltus/models/models.hpp>
#include <saltus/plan/compile.hpp>
#include <saltus/plan/detail/machine.hpp>
#include <saltus/report/achieved.hpp>
#include <saltus/solver/detail/jacobian.hpp>

#include "support/catch.hpp"

using namespace saltus;

namespace {

const std::vector<std::string> smooth_scenes{
    "robertson", "hires",  "orego",          "van-der-pol",    "vdpol",    "vdpol-1e6", "e5",
    "pollu",     "kepler", "ring-modulator", "brusselator",    "heat-rod", "pleiades",  "lorenz",
    "b5",        "beam",   "cusp",           "brusselator-2d", "plate",    "medakzo",   "emep"};

/// How many local errors of the tolerance an achieved error may be. Ten for one-step methods and
/// Adams. BDF takes hundreds to thousands of steps within the memory of a stiff scene, and its
/// local errors, each up to the tolerance and of either sign, add up like the root of their number.
double allowed(const saltus::Scene& scene, const Results& results) {
  const bool bdf = results.statistics.method.find("bdf") != std::string::npos;
  const double multiple =
      bdf ? std::max(10.0, std::sqrt(static_cast<double>(results.statistics.steps))) : 10.0;
  return multiple * scene.growth;
}

void check_scene(const std::string& name, Method method, double rtol) {
  const saltus::Scene scene = at_tolerance(models::scene(name), method, rtol);
  INFO(name << ", " << method << ", rtol " << rtol);
  const Results results = simulate(scene);
  const Achieved a = achieved(scene, results);
  CHECK(results.status == Status::reached_end);
  CHECK(a.event_mismatch == 0);
  CHECK(a.scaled <= allowed(scene, results));
}

/// The rows at which a reference stands, or 20 of a closed form.
std::vector<Sample> known(const saltus::Scene& scene) {
  if (!scene.exact.state) return scene.exact.samples;
  std::vector<Sample> samples;
  for (int i = 1; i <= 20; ++i) {
    const double t = scene.span.end * (i - 0.5) / 20.0;
    Branch branch;
    if (!scene.exact.events.empty()) {
      const auto& times = scene.exact.events[0].series[0].times;
      branch.events = static_cast<std::size_t>(std::ranges::upper_bound(times, t) - times.begin());
    }
    samples.push_back({t, scene.exact.state(t, branch)});
  }
  return samples;
}

Eigen::VectorXd derivative(Machine& machine, double t, const Eigen::VectorXd& x) {
  Eigen::VectorXd xdot(x.size());
  machine.derivative(t, x.data(), xdot.data());
  return xdot;
}

/// The Jacobian that the leaf declares, as a full matrix.
Eigen::MatrixXd own_jacobian(Machine& machine, const Sample& at) {
  Jacobian jacobian(machine);
  const JacobianPattern& pattern = jacobian.pattern();
  REQUIRE(pattern.own.size() == 1);
  const Eigen::VectorXd xdot = derivative(machine, at.time, at.state);
  Eigen::VectorXd values(static_cast<Index>(pattern.places.rows.size()));
  REQUIRE(jacobian(at.time, at.state.data(), xdot.data(), {}, values.data()));
  Eigen::MatrixXd full = Eigen::MatrixXd::Zero(at.state.size(), at.state.size());
  Index k = 0;
  for (Index j = 0; j < full.cols(); ++j) {
    for (const auto row : pattern.places.column(j)) full(static_cast<Index>(row), j) = values[k++];
  }
  return full;
}

}  // namespace

TEST_CASE("each smooth scene meets its reference with each method that suits it",
          "[laws][models]") {
  for (const std::string& name : smooth_scenes) {
    const auto& entry = *std::ranges::find(models::shelf(), name, &models::ShelfEntry::name);
    auto methods = models::scene(name).methods;
    if (std::ranges::count(methods, Method::bdf) > 0 &&
        std::ranges::count(methods, Method::radau) == 0)
      methods.push_back(Method::radau);
    for (const Method method : methods) {
      if (entry.quick) check_scene(name, method, 1e-9);
      if (entry.quick || method == Method::bdf) check_scene(name, method, 1e-6);
    }
  }
}

TEST_CASE("at the edge of its stability dop853 finds the events there are, and no others",
          "[laws][models]") {
  // The Brusselator with N = 63, 0.02 s a step where its solution asks for 0.3.
  const double rtol = GENERATE(1e-3, 1e-4, 1e-5, 1e-8, 1e-10);
  const saltus::Scene scene = at_tolerance(models::scene("brusselator"), Method::dop853, rtol);
  INFO("rtol " << rtol);
  const Results results = simulate(scene);
  const Achieved a = achieved(scene, results);
  CHECK(a.event_mismatch == 0);
  // Ten tolerances of a state; u moves at 1.4 /s and more where it crosses its level.
  CHECK(a.event_error <= 10.0 * (rtol + scene.options.atol) / 1.4);
}

TEST_CASE("a rod of any number of nodes meets its closed form", "[laws][models]") {
  const Index n = GENERATE(5, 20, 200);
  const saltus::Scene scene = at_tolerance(models::heat_rod({.n = n}), Method::bdf, 1e-6);
  INFO("n " << n);
  const Results results = simulate(scene);
  const Achieved a = achieved(scene, results);
  CHECK(a.event_mismatch == 0);
  CHECK(a.scaled <= allowed(scene, results));
}

TEST_CASE("references keep the invariants of their equations", "[laws][models]") {
  for (const std::string& name : smooth_scenes) {
    const saltus::Scene scene = models::scene(name);
    INFO(name);
    for (const Invariant& invariant : scene.invariants) {
      const Eigen::VectorXd start = scene.context.continuous_state();
      const double value = invariant.value(scene.span.begin, start);
      for (const Sample& sample : known(scene)) {
        INFO(invariant.name << ", t " << sample.time);
        // Entries are rounded to 17 digits. The sums have up to 28 terms; bodies up to 8 apart, of
        // mass 7, at these times no nearer than 0.4, enlarge a rounding by less than a hundred.
        const double size = sample.state.lpNorm<Eigen::Infinity>();
        CHECK(std::abs(invariant.value(sample.time, sample.state) - value) <=
              28 * 100 * 2.3e-16 * size);
      }
    }
  }
}

TEST_CASE("closed forms satisfy the equations they are of", "[laws][models]") {
  const auto* name = GENERATE("kepler", "heat-rod", "b5");
  const saltus::Scene scene = models::scene(name);
  Machine machine(compile(*scene.system));
  for (const Sample& sample : known(scene)) {
    Context context = scene.context;
    std::size_t switches = 0;
    if (!scene.exact.events.empty())
      for (const double t : scene.exact.events[0].series[0].times) switches += t < sample.time;
    if (name == std::string("heat-rod")) context = context.with_mode(switches % 2 == 0 ? 1 : 0);
    machine.load(context);
    // Central differences of second order, twice, and their limit by Richardson: h^4 times the
    // fifth derivative, below 1e-3 of the largest rate, and roundings of 1e-16 / h.
    const double h = 1e-4 * (name == std::string("kepler") ? 1.0 : 0.1);
    const auto slope = [&](double d) -> Eigen::VectorXd {
      return (scene.exact.state(sample.time + d, {0, switches, false}) -
              scene.exact.state(sample.time - d, {0, switches, false})) /
             (2.0 * d);
    };
    const Eigen::VectorXd expected = (4.0 * slope(h) - slope(2.0 * h)) / 3.0,
                          found = derivative(machine, sample.time, sample.state);
    CHECK((found - expected).lpNorm<Eigen::Infinity>() <=
          1e-9 * (1.0 + found.lpNorm<Eigen::Infinity>()));
  }
}

TEST_CASE("the Jacobians of stiff scenes are those of their equations", "[laws][models]") {
  const auto* name =
      GENERATE("robertson", "hires", "orego", "van-der-pol", "vdpol", "e5", "pollu", "b5", "emep");
  const saltus::Scene scene = models::scene(name);
  Machine machine(compile(*scene.system));
  machine.load(scene.context);
  for (const Sample& sample : known(scene)) {
    const Index n = sample.state.size();
    const Eigen::MatrixXd jacobian = own_jacobian(machine, sample);
    for (Index j = 0; j < n; ++j) {
      // All right-hand sides are of degree three at most: the central difference is d + d''' h^2 /
      // 6, and two of them give d without error but rounding. With a step of the size of the state,
      // that is a few eps of the terms, over the step.
      const double h =
          sample.state[j] != 0.0 ? 0.5 * std::abs(sample.state[j]) : 1e-3 * sample.state.norm();
      const auto slope = [&](double d) -> Eigen::VectorXd {
        Eigen::VectorXd up = sample.state, down = sample.state;
        up[j] += d, down[j] -= d;
        return (derivative(machine, sample.time, up) - derivative(machine, sample.time, down)) /
               (2.0 * d);
      };
      const Eigen::VectorXd expected = (4.0 * slope(h) - slope(2.0 * h)) / 3.0;
      const Eigen::VectorXd terms = jacobian.cwiseAbs() * sample.state.cwiseAbs() / h;
      for (Index i = 0; i < n; ++i) {
        INFO(name << ", t " << sample.time << ", entry " << i << ", " << j);
        CHECK(std::abs(jacobian(i, j) - expected[i]) <=
              1e-13 * (terms[i] + jacobian.row(i).lpNorm<Eigen::Infinity>()));
      }
    }
  }
}

TEST_CASE("a scene with parameters of its own has no reference, and says so", "[laws][models]") {
  CHECK(models::brusselator({.n = 20}).exact.samples.empty());
  CHECK(models::brusselator({.n = 20}).exact.provenance.starts_with("none"));
  CHECK(models::vdpol({.epsilon = 1e-3}).exact.provenance.starts_with("none"));
  CHECK(models::orego({.q = 1e-5}).exact.events.empty());
  CHECK(models::lorenz({.t_end = 4.0}).exact.samples.size() == 2);
  CHECK(models::lorenz({.t_end = 4.0}).exact.events.at(0).series[0].times.size() == 12);
  CHECK(models::beam({.n = 20}).exact.provenance.starts_with("none"));
  CHECK(models::cusp({.epsilon = 1e-3}).exact.provenance.starts_with("none"));
  CHECK(models::plate({.omega = 10.0}).exact.provenance.starts_with("none"));
  CHECK(models::medical_akzo({.t_end = 4.0}).exact.events.empty());
  CHECK(models::brusselator_2d({.n = 16}).exact.samples.empty());
  CHECK(models::emep({.t_end = 2e5}).exact.samples.size() == 1);
  CHECK_THROWS_AS(models::kepler({.e = 1.0}), ModelError);
  CHECK_THROWS_AS(models::heat_rod({.low = 0.4}), ModelError);
  CHECK_THROWS_AS(models::brusselator({.n = 0}), ModelError);
}
