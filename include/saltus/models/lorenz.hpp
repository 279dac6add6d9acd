// Lorenz: three modes of convection, the first known strange attractor. Errors grow like exp(0.9 t)
// in the long run; the scene ends before this growth dominates.
//   dx/dt = sigma (y - x),  dy/dt = x (rho - z) - y,  dz/dt = x y - beta z
// State x, y, z, without units, as is time; (0, 1, 0) at the start. Parameters sigma = 10, rho =
// 28, beta = 8/3. Monitor "section": z = rho - 1, the plane of the two fixed points, which the
// trajectory crosses up and down twice a turn. E. N. Lorenz, "Deterministic nonperiodic flow", J.
// Atmospheric Sciences 20 (1963) 130, with his parameters and start.
#pragma once

#include "saltus/models/reference.hpp"

namespace saltus::models {

class Lorenz final : public LeafSystem {
 public:
  explicit Lorenz(double sigma = 10.0, double rho = 28.0, double beta = 8.0 / 3.0)
      : LeafSystem("convection") {
    const auto s = declare_dynamic_parameter("sigma", sigma);
    const auto r = declare_dynamic_parameter("rho", rho);
    const auto b = declare_dynamic_parameter("beta", beta);
    declare_continuous_state({.initial = Eigen::Vector3d(0.0, 1.0, 0.0),
                              .ode = equations<3>([s, r, b](const auto& at, auto& xdot) {
                                const auto x = at.x(0), y = at.x(1), z = at.x(2);
                                xdot[0] = at.p(s, 0) * (y - x);
                                xdot[1] = x * (at.p(r, 0) - z) - y;
                                xdot[2] = x * y - at.p(b, 0) * z;
                              })});
    declare_continuous_state_output("x");
    declare_zero_crossing({.name = "section", .formula = Formula([r](const auto& at) {
                                                           return at.x(2) - (at.p(r, 0) - 1.0);
                                                         }).called()});
  }
};

struct LorenzParameters {
  double sigma = 10.0, rho = 28.0, beta = 8.0 / 3.0;
  double t_end = 10.0;
};

namespace detail {

inline Exact lorenz_reference(const LorenzParameters& with) {
  if (with.sigma != 10.0 || with.rho != 28.0 || with.beta != 8.0 / 3.0)
    return {.provenance = "none: not the parameters of Lorenz"};
  return {.provenance =
              "Taylor series of order 36 in 32 digits and Radau IIA of order 13 in 34: "
              "agree to 19 digits",
          .events = {firings(
              "convection.section",
              {0.36750927349222712, 0.66733815162805477, 0.92172601574566515, 1.2200371124915905,
               1.5425543370671742,  1.8385170878392156,  2.1620549087627157,  2.4573277804795368,
               2.7819450265112260,  3.0764894442925668,  3.4022782611642519,  3.6960528813427156,
               4.0231163478220626,  4.3160770965793906,  4.6445311287067872,  4.9366309037775160,
               5.2666066290451301,  5.5577949430756348,  5.8894416887317877,  6.1796642389207062,
               6.5131533422273087,  6.8023514858427259,  7.1378812228521502,  7.4259913312696249,
               7.7637933963018391,  8.0507460503312807,  8.3910942310757797,  8.6768132060374388,
               9.0200352429917103,  9.3044362108198211,  9.6509304045179416,  9.9339192480479799})},
          .samples = {
              {2, column({-7.7090811273304807, -8.4495184368870238, 24.992522486062430})},
              {4, column({-9.2265690965159664, -10.376811674570190, 26.395461044508842})},
              {6, column({-9.8908843743059567, -9.0242067405166626, 29.778897275585948})},
              {8, column({-7.8042623246689118, -5.8485797842234009, 28.645453200695187})},
              {10, column({-5.9166181217432481, -5.5237177695754118, 24.571964902009601})},
          }};
}

}  // namespace detail

/// Records "x", the state, at the times of the reference. The growth up to t = 10 is measured as in
/// hires.hpp. Most of it is from the first turn, and it is small for this attractor.
inline Scene lorenz(const LorenzParameters& with = {}) {
  const auto convection = std::make_shared<const Lorenz>(with.sigma, with.rho, with.beta);
  return detail::with_rows_at_samples(
      {.name = "Lorenz",
       .system = convection,
       .context = convection->create_context(),
       .span = {0.0, with.t_end},
       .options = {.rtol = 1e-6, .atol = 1e-6, .recorded_signals = {{"x", convection->output(0)}}},
       .exact = detail::until(with.t_end, 10.0, detail::lorenz_reference(with)),
       .methods = {Method::dopri5, Method::dop853, Method::adams, Method::taylor,
                   Method::automatic},
       .growth = 30.0});
}

}  // namespace saltus::models
