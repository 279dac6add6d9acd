// POLLU: the chemistry of an air pollution model, 25 reactions of 20 substances.
//   dy/dt = sum over reactions of k (product of the reactants) (products - reactants)
// State: concentrations [ppm], in the order of the source: NO2, NO, O(3P), O3, HO2, OH, HCHO, CO,
// ALD, MEO2, C2O3, CO2, PAN, CH3O, HNO3, O(1D), SO2, SO4, NO3, N2O5; time in minutes. Rates are the
// parameter k [1/min or 1/(ppm min)]. The fastest radicals follow the other substances within 1e-11
// min and are as scarce as 4e-18 ppm. Nitrogen, sulphur and carbon are conserved. J. G. Verwer,
// SIAM J. Sci. Comput. 15 (1994) 1243; Test Set for IVP Solvers, POLLU.
#pragma once

#include <array>

#include "saltus/models/reference.hpp"

namespace saltus::models {

class Pollu final : public LeafSystem {
 public:
  Pollu() : LeafSystem("air") {
    declare_continuous_state(
        {.initial = detail::column(
             {0, 0.2, 0, 0.04, 0, 0, 0.1, 0.3, 0.01, 0, 0, 0, 0, 0, 0, 0, 0.007, 0, 0, 0}),
         .ode = &Pollu::ode,
         .jacobian = &Pollu::jacobian});
    declare_continuous_state_output("y");
    k_ = declare_dynamic_parameter(
        "k",
        detail::column({0.35,    26.6,   1.23e4, 8.6e-4, 8.2e-4, 1.5e4,  1.3e-4, 2.4e4,  1.65e4,
                        9e3,     0.022,  1.2e4,  1.88,   1.63e4, 4.8e6,  3.5e-4, 0.0175, 1e8,
                        4.44e11, 1240.0, 2.1,    5.78,   0.0474, 1780.0, 3.12}));
  }

 private:
  /// Substances by number, 0 for none: one or two that react, up to three products.
  struct Reaction {
    std::array<Index, 2> from;
    std::array<Index, 3> to;
  };
  static constexpr std::array<Reaction, 25> reactions{{{{1, 0}, {2, 3, 0}},     //
                                                       {{2, 4}, {1, 0, 0}},     //
                                                       {{5, 2}, {1, 6, 0}},     //
                                                       {{7, 0}, {5, 5, 8}},     //
                                                       {{7, 0}, {8, 0, 0}},     //
                                                       {{7, 6}, {5, 8, 0}},     //
                                                       {{9, 0}, {10, 5, 8}},    //
                                                       {{9, 6}, {11, 0, 0}},    //
                                                       {{11, 2}, {1, 10, 12}},  //
                                                       {{11, 1}, {13, 0, 0}},   //
                                                       {{13, 0}, {11, 1, 0}},   //
                                                       {{10, 2}, {14, 1, 0}},   //
                                                       {{14, 0}, {7, 5, 0}},    //
                                                       {{1, 6}, {15, 0, 0}},    //
                                                       {{3, 0}, {4, 0, 0}},     //
                                                       {{4, 0}, {16, 0, 0}},    //
                                                       {{4, 0}, {3, 0, 0}},     //
                                                       {{16, 0}, {6, 6, 0}},    //
                                                       {{16, 0}, {3, 0, 0}},    //
                                                       {{17, 6}, {18, 5, 0}},   //
                                                       {{19, 0}, {2, 0, 0}},    //
                                                       {{19, 0}, {1, 3, 0}},    //
                                                       {{1, 4}, {19, 0, 0}},    //
                                                       {{19, 1}, {20, 0, 0}},   //
                                                       {{20, 0}, {19, 1, 0}}}};

  /// Subtracts `rate` from the substances that react and adds it to the products.
  template <class Column>
  static void convert(const Reaction& r, double rate, Column&& xdot) {
    for (const Index i : r.from)
      if (i > 0) xdot[i - 1] -= rate;
    for (const Index i : r.to)
      if (i > 0) xdot[i - 1] += rate;
  }
  void ode(const At& at, VectorRef xdot) const {
    const VectorView k = at.parameter(k_);
    xdot.setZero();
    for (std::size_t n = 0; n < reactions.size(); ++n) {
      const auto [a, b] = reactions[n].from;
      const double rate = k[static_cast<Index>(n)] * at.x[a - 1];
      convert(reactions[n], b > 0 ? rate * at.x[b - 1] : rate, xdot);
    }
  }
  void jacobian(const At& at, MatrixRef out) const {
    const VectorView k = at.parameter(k_);
    out.setZero();
    for (std::size_t n = 0; n < reactions.size(); ++n) {
      const auto [a, b] = reactions[n].from;
      const double rate = k[static_cast<Index>(n)];
      convert(reactions[n], b > 0 ? rate * at.x[b - 1] : rate, out.col(a - 1));
      if (b > 0) convert(reactions[n], rate * at.x[a - 1], out.col(b - 1));
    }
  }

  ParameterIndex k_;
};

struct PolluParameters {
  double t_end = 60.0;  ///< [min]
};

namespace detail {

inline Exact pollu_reference() {
  return {.provenance =
              "Radau IIA of order 13 in 34 digits, agrees with order 9 to 15 digits; the "
              "end with Test Set for IVP Solvers, POLLU, to 14",
          .samples = {
              {1, column({0.037326304298863848,   0.16251325412678647,     2.7344389306112268e-9,
                          0.0032994065756909441,  3.1151619387247727e-7,   2.6534918501662523e-7,
                          0.099423103666211862,   0.30061731277574838,     0.0099269949383152308,
                          2.9529601826602432e-8,  2.0994901154651784e-8,   0.000065714929568266723,
                          5.9742964653865925e-6,  0.000027858639506122130, 0.00013959464032071978,
                          2.6002979092384103e-18, 0.0069973974657435659,   2.6025342564343066e-6,
                          3.8171954507742246e-7,  7.2454590092549258e-6})},
              {5, column({0.039568428180805471,    0.15957174621366516,     2.8980351316840525e-9,
                          0.0032497430412911097,   3.0470275827103299e-7,   2.5477366252563179e-7,
                          0.097437218780779156,    0.30283183868163688,     0.0096752739776742036,
                          2.8205190501915601e-8,   2.0034969045789761e-8,   0.00028535869793576836,
                          0.000032956645254391165, 0.000029054318662424881, 0.00079876207872260825,
                          2.5611575421117924e-18,  0.0069883056902533512,   0.000011694309746648742,
                          6.2476583725870047e-7,   0.000013741057857562209})},
              {20, column({0.045720273508043772,   0.15092528896753440,     3.3497488389283728e-9,
                           0.0039741200426562963,  2.6092963724766137e-7,   2.0779290683500181e-7,
                           0.090922494632550199,   0.31007672187946389,     0.0088917587908850185,
                           2.2810877760508716e-8,  1.6125443597443767e-8,   0.00097247932383680465,
                           0.00011128830044474743, 0.000022154919724617773, 0.0031906290018972544,
                           3.1320468699159390e-18, 0.0069585819039869809,   0.000041418096013019470,
                           9.9671204326055335e-7,  0.000025761755018284729})},
              {60, column({0.056462554800227695,   0.13424841304223384,     4.1397343310994266e-9,
                           0.0055231402074843597,  2.0189772623021960e-7,   1.4645418634939657e-7,
                           0.077842491189979643,   0.32450753533960180,     0.0074940133838804057,
                           1.6222931573015605e-8,  1.1358638332570748e-8,   0.0022305059757213599,
                           0.00020871628827986299, 0.000013969210168401579, 0.0089648848568982947,
                           4.3528463693301038e-18, 0.0068992196962634053,   0.00010078030373659460,
                           1.7721465139699844e-6,  0.000056829432923163932})},
          }};
}

/// Atoms of one kind: a sum of concentrations with the number of them in each substance.
inline Invariant atoms(std::string name, std::vector<std::pair<Index, double>> count) {
  return {std::move(name), [count = std::move(count)](double, const Eigen::VectorXd& y) {
            double sum = 0.0;
            for (const auto& [substance, number] : count) sum += number * y[substance - 1];
            return sum;
          }};
}

}  // namespace detail

/// Records "y" at the times of the reference. The growth: see hires.hpp.
inline Scene pollu(const PolluParameters& with = {}) {
  const auto air = std::make_shared<const Pollu>();
  return detail::with_rows_at_samples(
      {.name = "POLLU",
       .system = air,
       .context = air->create_context(),
       .span = {0.0, with.t_end},
       .options = {.rtol = 1e-6, .atol = 1e-16, .recorded_signals = {{"y", air->output(0)}}},
       .exact = detail::until(with.t_end, with.t_end, detail::pollu_reference()),
       .invariants = {detail::atoms("nitrogen",
                                    {{1, 1}, {2, 1}, {13, 1}, {15, 1}, {19, 1}, {20, 2}}),
                      detail::atoms("sulphur", {{17, 1}, {18, 1}}),
                      detail::atoms(
                          "carbon",
                          {{7, 1}, {8, 1}, {9, 2}, {10, 1}, {11, 2}, {12, 1}, {13, 2}, {14, 1}})},
       .methods = {Method::bdf, Method::radau, Method::automatic},
       .growth = 4.3});
}

}  // namespace saltus::models
