// The scenes that no other test runs in full: the shelf by every method that suits each scene, at
// two tolerances, and the extreme cases. Hidden from those who run all tests.
#include <saltus/models/shelf.hpp>

#include "extremes/all.hpp"
#include "fingerprint/line.hpp"
#include "support/catch.hpp"

namespace {

/// Runs, and makes sure that the run was seen: see hook.cpp.
template <class Run>
void run(const std::string& scene, saltus::Method method, Run run_it) {
  INFO(scene << ", method " << to_string(method));
  const std::size_t before = fingerprint::lines();
  try {
    const fingerprint::Named name(scene, std::string(to_string(method)));
    run_it();
  } catch (const saltus::ModelError& error) {  // refused before it ran
    if (fingerprint::lines() == before)
      fingerprint::write(scene, std::string(to_string(method)), fingerprint::refused(error.what()));
  }
  REQUIRE(fingerprint::lines() == before + 1);
}

/// Ten seconds and more, by a method.
bool is_long(const extremes::Case& c) {
  return c.name.starts_with("1e6 ") || c.name.starts_with("1e4 guards of a leaf, monitors");
}

void run_extreme(const extremes::Case& c, saltus::Method method) {
  int number = 0;
  for (extremes::Trial& trial : c.trials()) {
    trial.options.ode_solver_method = method;
    trial.options.throw_errors = false;
    run(saltus::text("extremes/", c.name, " #", ++number), method,
        [&] { saltus::simulate(*trial.system, trial.start, trial.span, trial.options); });
  }
}

}  // namespace

TEST_CASE("fingerprint: shelf", "[.fingerprint][.]") {
  for (const saltus::models::ShelfEntry& entry : saltus::models::shelf()) {
    for (const double rtol : {1e-4, 1e-8}) {
      saltus::Scene scene = saltus::models::scene(entry.name);
      scene.options.atol *= rtol / scene.options.rtol;
      scene.options.rtol = rtol;
      scene.options.throw_errors = false;
      for (const saltus::Method method : scene.methods) {
        scene.options.ode_solver_method = method;
        run(saltus::text("shelf/", entry.name, " ", rtol), method, [&] { simulate(scene); });
      }
    }
  }
}

// None of them is stopped by a clock, as bench/extremes does: where it stops is not repeatable.
TEST_CASE("fingerprint: extremes", "[.fingerprint][.]") {
  for (const extremes::Group& group : extremes::all_groups()) {
    for (const extremes::Case& c : group.cases) {
      if (is_long(c)) continue;
      for (const saltus::Method method : c.methods) run_extreme(c, method);
    }
  }
}
