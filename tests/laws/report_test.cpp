// The work-precision report: what it measures is what happened, and nothing is dropped.
#include <nlohmann/json.hpp>
#include <saltus/models/bouncing_ball.hpp>
#include <saltus/models/robertson.hpp>
#include <saltus/models/tutorial.hpp>
#include <saltus/report/table.hpp>
#include <saltus/report/written.hpp>
#include <sstream>

#include "support/catch.hpp"
#include "support/leaves.hpp"

using namespace saltus;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;
using support::Leaf;

namespace {

constexpr TimingOptions no_timing{.least_time = 0.0, .most_repeats = 1, .most_cold = 1};

/// x = cos E - e, y = sqrt(1 - e^2) sin E, where E - e sin E = t: Kepler's equation, by Newton's
/// method from E = t, which converges for e = 0.3.
Eigen::VectorXd kepler_at(double t, double e) {
  double big_e = t;
  for (int i = 0; i < 20; ++i)
    big_e -= (big_e - e * std::sin(big_e) - t) / (1.0 - e * std::cos(big_e));
  const double root = std::sqrt(1.0 - e * e), rate = 1.0 / (1.0 - e * std::cos(big_e));
  return support::vec({std::cos(big_e) - e, root * std::sin(big_e), -std::sin(big_e) * rate,
                       root * std::cos(big_e) * rate});
}

/// An orbit of excentricity 0.3 around a mass at the origin: r'' = -r / |r|^3, one turn in 2 pi.
Scene kepler(double t_end = 10.0) {
  const auto orbit = std::make_shared<const Leaf>("orbit", [](Leaf& l) {
    l.declare_continuous_state(
        {.initial = kepler_at(0.0, 0.3), .ode = [](const At& at, VectorRef d) {
           const double r = std::hypot(at.x[0], at.x[1]), r3 = r * r * r;
           d << at.x[2], at.x[3], -at.x[0] / r3, -at.x[1] / r3;
         }});
    l.declare_continuous_state_output("x");
  });
  return {.name = "orbit",
          .system = orbit,
          .context = orbit->create_context(),
          .span = {0.0, t_end},
          .options = {.recorded_signals = {{"x", orbit->output(0)}}},
          .exact = {.provenance = "Kepler's equation",
                    .state = [](double t, const Branch&) { return kepler_at(t, 0.3); }},
          .invariants = {{"energy",
                          [](double, const Eigen::VectorXd& x) {
                            return (x[2] * x[2] + x[3] * x[3]) / 2 - 1 / std::hypot(x[0], x[1]);
                          }},
                         {"angular momentum", [](double, const Eigen::VectorXd& x) {
                            return x[0] * x[3] - x[1] * x[2];
                          }}}};
}

WorkReport quick(const Scene& scene, std::vector<Method> methods, std::vector<double> rtols) {
  return work_precision(scene, {.methods = std::move(methods),
                                .rtols = std::move(rtols),
                                .atol_over_rtol = 1e-2,
                                .timing = no_timing});
}

std::vector<std::string> split(const std::string& line) {  // fields without commas in quotes
  std::vector<std::string> fields;
  std::istringstream in(line);
  for (std::string field; std::getline(in, field, ',');) fields.push_back(field);
  return fields;
}

}  // namespace

TEST_CASE("the order of a method is visible where rounding is not reached", "[laws][report]") {
  const WorkReport report = quick(kepler(), {Method::dopri5, Method::dop853},
                                  {1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11, 1e-12});
  // The slope over the steps is the order p where C in C n^-p is constant. The control moves steps
  // from where they matter less to where they matter more as it gets tighter: over the three
  // decades of tolerance that count, error and steps scatter by a third, which is half an order
  // over the factor of 10^(3/8) = 2.4 in the steps of dop853, and less of dopri5.
  CHECK_THAT(report.orders.at("dopri5"), WithinAbs(5.0, 0.5));
  CHECK_THAT(report.orders.at("dop853"), WithinAbs(8.0, 1.0));
}

TEST_CASE("a slope is that of the points above the floor", "[laws][report]") {
  std::vector<OrderPoint> runs;
  for (const double n : {10.0, 20.0, 40.0, 80.0, 160.0}) runs.push_back({n, std::pow(n, -4.0)});
  CHECK_THAT(visible_order(runs, 0.0), WithinRel(4.0, 1e-12));
  runs[0].error = runs[1].error = 1.0;  // steps too long for the leading term
  CHECK_THAT(visible_order(runs, 0.0), WithinRel(4.0, 1e-12));
  runs.push_back({320.0, 1e-9});  // here rounding decides
  CHECK(visible_order(runs, 0.0) < 3.5);
  CHECK_THAT(visible_order(runs, 1e-9), WithinRel(4.0, 1e-12));
  CHECK(std::isnan(visible_order(runs, 0.5)));  // two are left
  CHECK(std::isnan(visible_order({{5, 1e-3}, {5, 1e-4}, {5, 1e-5}}, 0.0)));
}

TEST_CASE("a wrong number of events is shown", "[laws][report]") {
  Scene scene = models::bouncing_ball();
  const WorkReport right = quick(scene, {Method::dopri5}, {1e-6});
  CHECK(right.rows[0].achieved.event_mismatch == 0);
  scene.exact.events[0].series[0].times.push_back(11.99);  // a bounce that does not happen
  CHECK(quick(scene, {Method::dopri5}, {1e-6}).rows[0].achieved.event_mismatch == 1);
  scene.exact.events[0].series[0].times.resize(4);
  CHECK(quick(scene, {Method::dopri5}, {1e-6}).rows[0].achieved.event_mismatch == 2);
}

TEST_CASE("a run that fails, or is refused, is a row with its reason", "[laws][report]") {
  const WorkReport slow = work_precision(
      models::robertson(), {.methods = {Method::dopri5}, .rtols = {1e-6}, .time_limit = 0.05});
  REQUIRE(slow.rows.size() == 1);
  CHECK(slow.rows[0].status == Status::interrupted);
  CHECK(std::isnan(slow.rows[0].timing.warm));
  CHECK(slow.rows[0].message.find("run time") != std::string::npos);
  const WorkReport refused = quick(kepler(), {Method::dopri5}, {1e-16, 1e-4});
  REQUIRE(refused.rows.size() == 2);
  CHECK(refused.rows[0].status == Status::failed);
  CHECK(refused.rows[0].message.find("rtol") != std::string::npos);
  CHECK(refused.rows[1].status == Status::reached_end);
}

TEST_CASE("a reference by runs is as good as it claims", "[laws][report]") {
  Scene scene = GENERATE(kepler(), models::bouncing_ball());
  const Exact exact = scene.exact;
  scene.exact = {};
  scene.growth = scene.name == "orbit" ? 30.0 : 1.0;  // a wrong period adds up: 3 pi t
  const Scene ready = detail::prepared(scene);
  const Reference reference = reference_for(ready, {.rtol = 1e-8});
  REQUIRE(reference.kind == ReferenceKind::run);
  REQUIRE(reference.runs.size() == 2);
  CHECK(reference.runs[0].rtol <= 1e-10);
  CHECK(reference.runs[0].method != reference.runs[1].method);
  CHECK(reference.provenance.find(reference.runs[1].method) != std::string::npos);
  CHECK(reference.bound < 1e-6);
  for (const ReferenceRun& run : reference.runs) {
    REQUIRE(run.answer.samples.size() == 100);
    for (const EventTimes& events : exact.events) {
      const auto& found = run.answer.events.at(0).series.at(0).times;
      REQUIRE(found.size() == events.series[0].times.size());
      for (std::size_t i = 0; i < found.size(); ++i)
        CHECK_THAT(found[i], WithinAbs(events.series[0].times[i], reference.event_bound));
    }
    for (const Sample& sample : run.answer.samples) {
      Branch branch;
      if (!exact.events.empty()) {
        const auto& times = exact.events[0].series[0].times;
        branch.events =
            static_cast<std::size_t>(std::ranges::upper_bound(times, sample.time) - times.begin());
      }
      const Eigen::VectorXd off = sample.state - exact.state(sample.time, branch);
      CHECK(off.lpNorm<Eigen::Infinity>() <= reference.bound);
    }
  }
}

TEST_CASE("each method is compared with another one where nothing is known", "[laws][report]") {
  Scene scene = models::bouncing_ball();
  scene.exact = {};
  const WorkReport report = quick(scene, {Method::dopri5, Method::dop853}, {1e-4, 1e-8});
  CHECK(report.reference.kind == ReferenceKind::run);
  for (const WorkRow& row : report.rows) {
    CHECK(row.against != row.method);
    CHECK(row.achieved.event_mismatch == 0);
    CHECK(row.achieved.error <= 10 * (14.0 * row.rtol + row.atol) + report.reference.bound);
    CHECK(row.achieved.event_error <= 10 * row.rtol);
  }
}

TEST_CASE("an event the reference knows nothing of counts, and a missed one too",
          "[laws][report]") {
  Scene scene = models::bouncing_ball();
  scene.exact = {};
  const Scene ready = detail::prepared(scene);
  Reference reference = reference_for(ready, {.rtol = 1e-6});
  for (ReferenceRun& run : reference.runs) run.answer.events[0].series[0].times.clear();
  SimulatorOptions options = ready.options;
  const WorkRow row = measure(ready, options, reference, {.timing = no_timing});
  CHECK(row.achieved.event_mismatch == 6);
}

TEST_CASE("invariants drift as much as they are wrong", "[laws][report]") {
  Scene scene = kepler();
  const WorkReport right = quick(scene, {Method::dop853}, {1e-10});
  REQUIRE(right.rows[0].achieved.drifts.size() == 2);
  // |dE| <= |v| |dv| + |dx| / r^2 <= 4.3 times the error of the state, where r >= 0.7, v <= 1.4
  CHECK(right.rows[0].achieved.invariant_drift <= 2 * 4.3 * right.rows[0].achieved.error);
  scene.invariants = {{"time", [](double t, const Eigen::VectorXd&) { return 2.0 * t; }}};
  CHECK(quick(scene, {Method::dop853}, {1e-4}).rows[0].achieved.invariant_drift == 20.0);
}

TEST_CASE("penetration is how far the gap goes below zero", "[laws][report]") {
  Scene scene = models::bouncing_ball();
  scene.gap = [](double, const Eigen::VectorXd& x) { return x[0] - 0.5; };
  // The lowest row is the one at a bounce, where the height is zero to within the location error
  // of 100 eps (t + h), t + h <= 24, at a speed of 14.
  CHECK_THAT(quick(scene, {Method::dopri5}, {1e-6}).rows[0].achieved.penetration,
             WithinAbs(0.5, 14 * 100 * 2.3e-16 * 24));
  scene.gap = [](double, const Eigen::VectorXd& x) { return x[0] + 0.5; };
  CHECK(quick(scene, {Method::dopri5}, {1e-6}).rows[0].achieved.penetration == 0.0);
}

TEST_CASE("the rest behind a Zeno point is judged apart", "[laws][report]") {
  const Scene scene = models::tutorial()[2];
  const Achieved a = achieved(scene, simulate(scene));
  CHECK(a.rest_error <= 1e-9);
  CHECK(a.accumulation_error <= 1e-9);
  CHECK(a.release_error == 0.0);
  Scene shifted = scene;
  shifted.exact.state = [state = scene.exact.state](double t, const Branch& branch) {
    return Eigen::VectorXd(state(t, branch).array() + (branch.rest ? 0.25 : 0.0));
  };
  CHECK_THAT(achieved(shifted, simulate(shifted)).rest_error, WithinAbs(0.25, 1e-9));
}

TEST_CASE("quartiles are those of the definition", "[laws][report]") {
  // definition 7: at 1 + 3 q of four values
  CHECK(detail::quantile({4.0, 1.0, 3.0, 2.0}, 0.25) == 1.75);
  CHECK(detail::quantile({4.0, 1.0, 3.0, 2.0}, 0.5) == 2.5);
  CHECK(detail::quantile({7.0}, 0.75) == 7.0);
}

TEST_CASE("run times are measured, cold and warm", "[laws][report]") {
  const WorkReport report = work_precision(
      models::bouncing_ball(),
      {.methods = {Method::dopri5}, .rtols = {1e-6}, .timing = {.least_time = 0.01}});
  const Timing& t = report.rows[0].timing;
  CHECK(t.quartile1 <= t.warm);
  CHECK(t.warm <= t.quartile3);
  CHECK(t.quartile1 > 0.0);
  CHECK(t.cold > 0.0);
  int made = 0;
  Scene scene = models::bouncing_ball();
  scene.build = [&made, system = scene.system] { return ++made, system; };
  CHECK(quick(scene, {Method::dopri5}, {1e-6}).cold_makes_system);
  CHECK(made == 1);
  CHECK(t.repeats >= 1);
}

TEST_CASE("JSON and CSV give the same bits back", "[laws][report]") {
  Scene scene = kepler();
  const WorkReport report = quick(scene, {Method::dopri5, Method::adams}, {1e-4, 1e-8, 1e-16});
  std::ostringstream json, csv, words;
  write_json(json, report), write_csv(csv, report), write_text(words, report);
  const auto data = nlohmann::json::parse(json.str());
  CHECK(data.at("environment").at("sundials") == environment().sundials);
  CHECK(data.at("reference").at("kind") == "exact");
  REQUIRE(data.at("rows").size() == 6);
  std::istringstream lines(csv.str());
  std::string line;
  while (std::getline(lines, line) && line.starts_with("#")) {
  }
  const auto names = split(line);
  for (std::size_t i = 0; i < report.rows.size(); ++i) {
    const WorkRow& row = report.rows[i];
    const auto& found = data.at("rows")[i];
    CHECK(found.at("method") == row.method);
    CHECK(found.at("rtol").get<double>() == row.rtol);
    CHECK(found.at("status") == to_string(row.status));
    REQUIRE(std::getline(lines, line));
    if (row.status == Status::failed) {
      CHECK(found.at("error").is_null());
      CHECK(found.at("message") == row.message);
      continue;
    }
    CHECK(found.at("error").get<double>() == row.achieved.error);
    CHECK(found.at("drift of energy").get<double>() == row.achieved.drifts[0]);
    CHECK(found.at("seconds").get<double>() == row.timing.warm);
    const auto fields = split(line);
    REQUIRE(fields.size() >= names.size() - 1);
    for (std::size_t k = 0; k < fields.size(); ++k) {
      if (names[k] == "error") CHECK(std::stod(fields[k]) == row.achieved.error);
      if (names[k] == "steps") CHECK(std::stoll(fields[k]) == row.statistics.steps);
    }
  }
  CHECK(words.str().find("Kepler's equation") != std::string::npos);
  CHECK(words.str().find("rtol 1.0e-16: ") != std::string::npos);
}

TEST_CASE("a known answer of the wrong width is refused", "[laws][report]") {
  Scene scene = kepler();
  scene.exact.state = [](double, const Branch&) { return support::vec({1.0}); };
  CHECK_THROWS_AS(quick(scene, {Method::dopri5}, {1e-4}), ModelError);
  scene = kepler();
  scene.options.recorded_signals.clear();
  CHECK_THROWS_AS(quick(scene, {Method::dopri5}, {1e-4}), ModelError);
}
