// E5: pyrolysis of a substance into a chain of two, the hardest of the STIFF DETEST set: eighteen
// decades between the rates, all but one concentration below 1e-9, thirteen decades of time.
//   dy1/dt = -A y1 - B y1 y3
//   dy2/dt =  A y1 - M C y2 y3
//   dy3/dt =  A y1 - B y1 y3 - M C y2 y3 + C y4
//   dy4/dt =  B y1 y3 - C y4
// State: concentrations, without unit, as is time; y(0) = (1.76e-3, 0, 0, 0). Parameters A =
// 7.89e-10, B = 1.1e7, C = 1.13e3, M = 1e6. y2 - y3 - y4 does not change, which decides the end,
// where y2 ~ y3 ~ 1 / (M C t): the right-hand side takes dy3 from dy2 and dy4, so that only
// rounding breaks it. W. H. Enright, T. E. Hull, B. Lindberg, BIT 15 (1975) 10; E. Hairer, G.
// Wanner, Solving Ordinary Differential Equations II, p. 145; Test Set for IVP Solvers, E5.
#pragma once

#include "saltus/models/reference.hpp"

namespace saltus::models {

class E5 final : public LeafSystem {
 public:
  E5() : LeafSystem("pyrolysis") {
    declare_continuous_state({.initial = Eigen::Vector4d(1.76e-3, 0.0, 0.0, 0.0),
                              .ode = &E5::ode,
                              .jacobian = &E5::jacobian});
    declare_continuous_state_output("y");
    a_ = declare_dynamic_parameter("A", 7.89e-10);
    b_ = declare_dynamic_parameter("B", 1.1e7);
    c_ = declare_dynamic_parameter("C", 1.13e3);
    m_ = declare_dynamic_parameter("M", 1e6);
  }

 private:
  void ode(const At& at, VectorRef xdot) const {
    const double y1 = at.x[0], y3 = at.x[2], decay = at.p[a_] * y1, on = at.p[b_] * y1 * y3,
                 dy2 = decay - at.p[m_] * at.p[c_] * at.x[1] * y3, dy4 = on - at.p[c_] * at.x[3];
    xdot << -decay - on, dy2, dy2 - dy4, dy4;
  }
  void jacobian(const At& at, MatrixRef out) const {
    const double a = at.p[a_], c = at.p[c_], by1 = at.p[b_] * at.x[2], by3 = at.p[b_] * at.x[0],
                 mcy2 = at.p[m_] * c * at.x[2], mcy3 = at.p[m_] * c * at.x[1];
    out << -a - by1, 0.0, -by3, 0.0,     //
        a, -mcy2, -mcy3, 0.0,            //
        a - by1, -mcy2, -mcy3 - by3, c,  //
        by1, 0.0, by3, -c;
  }

  ParameterIndex a_, b_, c_, m_;
};

struct E5Parameters {
  double t_end = 1e13;
};

namespace detail {

/// The end of the Test Set at t = 1e13, y2 = 0.8867655517642120e-22, y3 = 0.8854814626268838e-22,
/// is not used: it breaks y2 = y3 + y4 in its third digit. From t = 1e11 on y1 and y4 are
/// negligible, y2 = y3 and dy2/dt = -M C y2^2, so 1 / y2 grows by M C (1e13 - 1e11): from the value
/// here at 1e11 to 0.88612335212910847e-22, which agrees with the value here in all digits. Nor is
/// its y1 = 1.2e-291 used: y1 < 1.76e-3 exp(-A t) is 1e-3429. From t = 1e12 on y1 and y4 are 0 to a
/// double.
inline Exact e5_reference() {
  return {.provenance =
              "Radau IIA of order 13 in 34 digits, agrees with order 9 to 14 digits"
              "; SciPy's Radau at 1e-12, over the "
              "logarithm of time and with y3 = y2 - y4, to 11",
          .samples = {
              {0.0001, column({0.0017599999999997824, 1.3886399999959502e-16,
                               6.3440593064967235e-17, 7.5423406934627793e-17})},
              {0.001, column({0.0017599999999966909, 1.3886399999087564e-15, 1.4061597338612535e-16,
                              1.2480240265226311e-15})},
              {0.01, column({0.0017599999998996459, 1.3886399954621565e-14, 8.2985310073188227e-16,
                             1.3056546853889682e-14})},
              {0.1, column({0.0017599999923240993, 1.3886395923578427e-13, 7.7222221344379231e-15,
                            1.3114173710134633e-13})},
              {1, column({0.0017599992560697031, 1.3885996986469086e-12, 7.6643739897287910e-14,
                          1.3119559587496207e-12})},
              {10, column({0.0017599259497677897, 1.3846281519376517e-11, 7.6370038530073909e-13,
                           1.3082581134075777e-11})},
              {100, column({0.0017534656083427547, 1.0889061015806116e-10, 6.0263621401267425e-12,
                            1.0286424801793442e-10})},
              {1000, column({0.0016180769999072943, 1.3822370304983736e-10, 8.2515735006838338e-12,
                             1.2997212954915352e-10})},
              {10000, column({0.00072404139018971152, 6.4079971211600726e-11,
                              7.9620340000430090e-12, 5.6117937211557711e-11})},
              {100000, column({7.4813208224292223e-6, 2.3734781561205976e-12,
                               2.2123586689581663e-12, 1.6111948716243113e-13})},
              {1000000, column({4.9367194167280977e-8, 1.8615865976221867e-13,
                                1.8606924128410545e-13, 8.9418478113213638e-17})},
              {10000000, column({4.7150333630401637e-10, 1.8188895860807023e-14,
                                 1.8188812376786725e-14, 8.3484020296321685e-20})},
              {100000000, column({4.5303729679395820e-12, 1.7830699458059196e-15,
                                  1.7830698671707985e-15, 7.8635121053421900e-23})},
              {1000000000, column({3.1317148329356996e-14, 1.4840957952870065e-16,
                                   1.4840957948345692e-16, 4.5243728279782623e-26})},
              {10000000000, column({2.8141371731863629e-18, 1.5712632888969013e-18,
                                    1.5712632888968582e-18, 4.3043588258119595e-32})},
              {100000000000, column({3.7693082197389725e-49, 1.0192582568142706e-20,
                                     1.0192582568142706e-20, 3.7399012194641821e-65})},
              {1e12, column({0.0, 8.9677206407019691e-22, 8.9677206407019691e-22, 0.0})},
              {1e13, column({0.0, 8.8612335212910845e-23, 8.8612335212910845e-23, 0.0})},
          }};
}

}  // namespace detail

/// Records "y" at the times of the reference. atol is a ninth of y2 at the end. The rounding of the
/// right-hand side loses less, although its terms reach 1e-12 while y2 - y3 - y4 must remain below
/// 1e-25. The growth (measured as in hires.hpp) counts errors that keep y2 - y3 - y4, because
/// linear multistep methods make no others; an error that broke it would be enlarged by 1.5e8.
inline Scene e5(const E5Parameters& with = {}) {
  const auto pyrolysis = std::make_shared<const E5>();
  return detail::with_rows_at_samples(
      {.name = "E5",
       .system = pyrolysis,
       .context = pyrolysis->create_context(),
       .span = {0.0, with.t_end},
       .options = {.rtol = 1e-6, .atol = 1e-23, .recorded_signals = {{"y", pyrolysis->output(0)}}},
       .exact = detail::until(with.t_end, with.t_end, detail::e5_reference()),
       .invariants = {{"y2 - y3 - y4",
                       [](double, const Eigen::VectorXd& y) { return y[1] - y[2] - y[3]; }}},
       .methods = {Method::bdf, Method::radau, Method::automatic},
       .growth = 2.8});
}

}  // namespace saltus::models
