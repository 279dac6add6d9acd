// BDF from many starts: none may fail.
#include "saltus/models/orego.hpp"
#include "support/run.hpp"

using namespace saltus;
using namespace support;

/// An eigenvalue moves by five orders of magnitude in a jump. Jacobians of many steps ago made
/// Newton's corrections too small there, and the run left its slow manifold: 11 of these failed.
TEST_CASE("BDF goes through the jumps of the Oregonator from sixty starts", "[bdf]") {
  const models::Oregonator reaction;
  for (int k = 0; k < 60; ++k) {
    // 1 to 5 and 3 to 23, evenly in shuffled orders, and 2 to 109 in equal factors
    const Eigen::Vector3d start(1.0 + (k * 19 % 60) / 15.0, 2.0 * std::exp(k / 15.0),
                                3.0 + (k * 37 % 60) / 3.0);
    INFO("start " << start.transpose());
    const Results results = simulate(
        reaction, reaction.create_context().with_continuous_state(start), {0.0, 360.0},
        {.rtol = 1e-4, .atol = 1e-6, .ode_solver_method = Method::bdf, .throw_errors = false});
    CHECK(results.status == Status::reached_end);
    // All concentrations are positive, and the second one is at most s^2 q^-1 (Hairer and Wanner).
    CHECK(results.context.continuous_state().minCoeff() > 0.0);
  }
}
