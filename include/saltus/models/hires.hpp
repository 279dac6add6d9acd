// HIRES: high irradiance responses of photomorphogenesis, eight substances of which two are always
// nearly in balance. The light-driven rise ends within a few units of time. The last reaction, of
// y6 and y8, begins to matter when y6 has nearly vanished, at t = 310, and is fast.
//   dy1/dt = -1.71 y1 + 0.43 y2 + 8.32 y3 + 0.0007
//   dy2/dt =  1.71 y1 - 8.75 y2
//   dy3/dt = -10.03 y3 + 0.43 y4 + 0.035 y5
//   dy4/dt =  8.32 y2 + 1.71 y3 - 1.12 y4
//   dy5/dt = -1.745 y5 + 0.43 (y6 + y7)
//   dy6/dt = -280 y6 y8 + 0.69 y4 + 1.71 y5 - 0.43 y6 + 0.69 y7
//   dy7/dt =  280 y6 y8 - 1.81 y7
//   dy8/dt = -dy7/dt
// State: concentrations, without unit, as is time; y(0) = (1, 0, 0, 0, 0, 0, 0, 0.0057). y7 + y8
// does not change. E. Schaefer, J. Math. Biology 2 (1975) 41; E. Hairer, G. Wanner, Solving
// Ordinary Differential Equations II, p. 144; Test Set for IVP Solvers, HIRES.
#pragma once

#include "saltus/models/reference.hpp"

namespace saltus::models {

class Hires final : public LeafSystem {
 public:
  Hires() : LeafSystem("plant") {
    declare_continuous_state({.initial = detail::column({1.0, 0, 0, 0, 0, 0, 0, 0.0057}),
                              .ode = &Hires::ode,
                              .jacobian = &Hires::jacobian});
    declare_continuous_state_output("y");
  }

 private:
  void ode(const At& at, VectorRef xdot) const {
    const VectorView& y = at.x;
    const double bound = 280.0 * y[5] * y[7] - 1.81 * y[6];
    xdot << -1.71 * y[0] + 0.43 * y[1] + 8.32 * y[2] + 0.0007,  //
        1.71 * y[0] - 8.75 * y[1],                              //
        -10.03 * y[2] + 0.43 * y[3] + 0.035 * y[4],             //
        8.32 * y[1] + 1.71 * y[2] - 1.12 * y[3],                //
        -1.745 * y[4] + 0.43 * (y[5] + y[6]),                   //
        -280.0 * y[5] * y[7] + 0.69 * y[3] + 1.71 * y[4] - 0.43 * y[5] + 0.69 * y[6], bound, -bound;
  }
  void jacobian(const At& at, MatrixRef out) const {
    const double by6 = 280.0 * at.x[7], by8 = 280.0 * at.x[5];
    out << -1.71, 0.43, 8.32, 0, 0, 0, 0, 0,           //
        1.71, -8.75, 0, 0, 0, 0, 0, 0,                 //
        0, 0, -10.03, 0.43, 0.035, 0, 0, 0,            //
        0, 8.32, 1.71, -1.12, 0, 0, 0, 0,              //
        0, 0, 0, 0, -1.745, 0.43, 0.43, 0,             //
        0, 0, 0, 0.69, 1.71, -by6 - 0.43, 0.69, -by8,  //
        0, 0, 0, 0, 0, by6, -1.81, by8,                //
        0, 0, 0, 0, 0, -by6, 1.81, -by8;
  }
};

struct HiresParameters {
  double t_end = 321.8122;  ///< as in the literature
};

namespace detail {

inline Exact hires_reference() {
  return {
      .provenance =
          "Radau IIA of order 13 in 34 digits, agrees with order 9 to 16 digits; the "
          "end with Test Set for IVP Solvers, HIRES, to 15",
      .samples = {
          {5, column({0.031651675704569275, 0.0064815495310581650, 0.0045834510647472853,
                      0.089743232735180326, 0.16245145375265563, 0.68504389614443162,
                      0.0056467003419205476, 0.000053299658079452455})},
          {20, column({0.0059748768923589164, 0.0011682515141061981, 0.0010803789367986787,
                       0.010378086212593913, 0.18197220688826937, 0.73139488274504338,
                       0.0056500638776506651, 0.000049936122349335169})},
          {80, column({0.0048797625115997384, 0.00095404606162337801, 0.00086733149728031496,
                       0.0084394884824136249, 0.14476702495086094, 0.58040694391813485,
                       0.0056372171160930752, 0.000062782883906925175})},
          {200, column({0.0027365120581329542, 0.00053518815262078626, 0.00044850923624214508,
                        0.0046881371963744005, 0.070833957882703552, 0.28046220455861670,
                        0.0055715961340674896, 0.00012840386593251067})},
          {300, column({0.0010211076081657745, 0.00019989944853184133, 0.00011354147346906150,
                        0.0016826415185746178, 0.011779282233421895, 0.041639100432211869,
                        0.0049364731210813058, 0.00076352687891869417})},
          {321.8122, column({0.00073713125733256674, 0.00014424857263161848,
                             0.000058887297409675752, 0.0011756513432831491, 0.0023863561988313304,
                             0.0062389682527427956, 0.0028499983951857689, 0.0028500016048142313})},
      }};
}

}  // namespace detail

/// Records "y" at the times of the reference. The growth is the largest |W^-1 Phi W_s|, in the
/// maximum norm, of the propagators Phi from any time s to the rows, W the scales atol/rtol + |y|.
/// The propagators are integrated with the equation.
inline Scene hires(const HiresParameters& with = {}) {
  const auto plant = std::make_shared<const Hires>();
  return detail::with_rows_at_samples(
      {.name = "HIRES",
       .system = plant,
       .context = plant->create_context(),
       .span = {0.0, with.t_end},
       .options = {.rtol = 1e-6, .atol = 1e-10, .recorded_signals = {{"y", plant->output(0)}}},
       .exact = detail::until(with.t_end, with.t_end, detail::hires_reference()),
       .invariants = {{"y7 + y8", [](double, const Eigen::VectorXd& y) { return y[6] + y[7]; }}},
       .methods = {Method::bdf, Method::radau, Method::automatic},
       .growth = 92.0});
}

}  // namespace saltus::models
