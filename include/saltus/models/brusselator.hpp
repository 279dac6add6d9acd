// The Brusselator on a line, by the method of lines: a reaction that oscillates, held at its ends,
// with diffusion. Stiff by the diffusion, whose fastest rate is 4 alpha (N + 1)^2, and of any size.
//   du_i/dt = 1 + u_i^2 v_i - 4 u_i + alpha (N + 1)^2 (u_{i-1} - 2 u_i + u_{i+1})
//   dv_i/dt = 3 u_i - u_i^2 v_i     + alpha (N + 1)^2 (v_{i-1} - 2 v_i + v_{i+1})
//   u_0 = u_{N+1} = 1, v_0 = v_{N+1} = 3;  u_i(0) = 1 + sin(2 pi x_i), v_i(0) = 3
// State: u_1, v_1, u_2, v_2, ... at x_i = i / (N + 1): a band of two entries beside the diagonal.
// Without units. Parameter alpha; N in the block. Monitor "threshold": u = 2 in the middle, node (N
// + 1) / 2. E. Hairer, G. Wanner, Solving Ordinary Differential Equations II, p. 6 and 148, BRUSS.
#pragma once

#include <cmath>
#include <numbers>

#include "saltus/models/reference.hpp"

namespace saltus::models {

class Brusselator final : public LeafSystem {
 public:
  explicit Brusselator(Index n = 63, double alpha = 0.02) : LeafSystem("line"), n_(n) {
    if (n < 1) throw ModelError(text("Brusselator: expected N >= 1 nodes, found ", n));
    Eigen::VectorXd start(2 * n);
    for (Index i = 0; i < n; ++i) {
      start[2 * i] = 1.0 + std::sin(2.0 * std::numbers::pi * static_cast<double>(i + 1) /
                                    static_cast<double>(n + 1));
      start[2 * i + 1] = 3.0;
    }
    declare_continuous_state({.initial = std::move(start), .ode = &Brusselator::ode});
    declare_jacobian_sparsity(band_entries(2 * n, 2, 2));
    declare_continuous_state_output("y");
    alpha_ = declare_dynamic_parameter("alpha", alpha);
    declare_zero_crossing({.name = "threshold", .guard = [u = 2 * ((n + 1) / 2 - 1)](const At& at) {
                             return at.x[u] - 2.0;
                           }});
  }

 private:
  void ode(const At& at, VectorRef xdot) const {
    const double spacing = 1.0 / static_cast<double>(n_ + 1),
                 d = at.p[alpha_] / (spacing * spacing);
    const VectorView& y = at.x;
    for (Index i = 0; i < 2 * n_; i += 2) {
      const bool first = i == 0, last = i == 2 * n_ - 2;
      const double u = y[i], v = y[i + 1], on = u * u * v;
      xdot[i] =
          1.0 + on - 4.0 * u + d * ((first ? 1.0 : y[i - 2]) - 2.0 * u + (last ? 1.0 : y[i + 2]));
      xdot[i + 1] =
          3.0 * u - on + d * ((first ? 3.0 : y[i - 1]) - 2.0 * v + (last ? 3.0 : y[i + 3]));
    }
  }

  Index n_;
  ParameterIndex alpha_;
};

struct BrusselatorParameters {
  Index n = 63;  ///< nodes
  double alpha = 0.02;
  double t_end = 10.0;
};

namespace detail {

inline Exact brusselator_reference(const BrusselatorParameters& with) {
  if (with.n != 63 || with.alpha != 0.02)
    return {.provenance = "none: not N = 63 and alpha = 0.02"};
  return {
      .provenance =
          "Radau IIA of order 9 in 34 digits, agrees with order 7 to 18; SciPy's Radau at 1e-11 "
          "and DOP853 at 1e-13 agree to "
          "11 and 10",
      .events = {firings("line.threshold", {6.3175388669679853, 7.1328937873023897})},
      .samples = {
          {10,
           column({0.95952917607116894, 3.0510447431347463, 0.91946620572739590, 3.1015626908495144,
                   0.88018773357352287, 3.1510621528674845, 0.84202945716560362, 3.1990997816260287,
                   0.80527913965402598, 3.2452905371492249, 0.77017250412151328, 3.2893141645054076,
                   0.73689190699435181, 3.3309182443824077, 0.70556749174771727, 3.3699181121392616,
                   0.67628038501411192, 3.4061941130753524, 0.64906742257740480, 3.4396867625581260,
                   0.62392687906757849, 3.4703904118826507, 0.60082471110357194, 3.4983459957559320,
                   0.57970089381443224, 3.5236333711870955, 0.56047551927176764, 3.5463636673021135,
                   0.54305441861698789, 3.5666719663140389, 0.52733415722791632, 3.5847105392762875,
                   0.51320632758808915, 3.6006427741387106, 0.50056112445575673, 3.6146378622192099,
                   0.48929023098580471, 3.6268662538208805, 0.47928907392617159, 3.6374958536754942,
                   0.47045852317163789, 3.6466889002870340, 0.46270611846342696, 3.6545994576471936,
                   0.45594690646844405, 3.6613714406812758, 0.45010396714585837, 3.6671370948489974,
                   0.44510870107814615, 3.6720158536172396, 0.44090094073302655, 3.6761135034905288,
                   0.43742893944888744, 3.6795215937676238, 0.43464928297164579, 3.6823170363658044,
                   0.43252676001425916, 3.6845618493726868, 0.43103422075383324, 3.6863030061187549,
                   0.43015244546966147, 3.6875723593429321, 0.42987003960075659, 3.6883866173937876,
                   0.43018336623862702, 3.6887473563946243, 0.43109652230358364, 3.6886410589776712,
                   0.43262136018998487, 3.6880391766685472, 0.43477755230494530, 3.6868982194011273,
                   0.43759269146087509, 3.6851598820935707, 0.44110241531500671, 3.6827512248401715,
                   0.44535053779391359, 3.6795849301735459, 0.45038916454059968, 3.6755596680954641,
                   0.45627876276445795, 3.6705606071752892, 0.46308814842030532, 3.6644601179028804,
                   0.47089434545893566, 3.6571187224693618, 0.47978226319879891, 3.6483863528816309,
                   0.48984412909775443, 3.6381039862235105, 0.50117860606256726, 3.6261057311089555,
                   0.51388951697191620, 3.6122214417466618, 0.52808409575478532, 3.5962799339908895,
                   0.54387068603202737, 3.5781128693501096, 0.56135581725413031, 3.5575593559047474,
                   0.58064060696738840, 3.5344712870357360, 0.60181646881357054, 3.5087193975272735,
                   0.62496015115783865, 3.4801999603514888, 0.65012819180693004, 3.4488419759292372,
                   0.67735094922701722, 3.4146146206311347, 0.70662645641961719, 3.3775346273756655,
                   0.73791443322716110, 3.3376731765698051, 0.77113087576632755, 3.2951617921963754,
                   0.80614370425050219, 3.2501966805310194, 0.84276997736338388, 3.2030409341100152,
                   0.88077515826322006, 3.1540240660869117, 0.91987483434148720, 3.1035384498530245,
                   0.95973914820421469, 3.0520324167339337})},
      }};
}

}  // namespace detail

/// Records "y" at the start and at t = 10. The growth: see hires.hpp. With N = 63 it is only mildly
/// stiff: explicit methods run at the edge of their stability.
inline Scene brusselator(const BrusselatorParameters& with = {}) {
  const auto line = std::make_shared<const Brusselator>(with.n, with.alpha);
  return detail::with_rows_at_samples(
      {.name = "Brusselator",
       .system = line,
       .context = line->create_context(),
       .span = {0.0, with.t_end},
       .options = {.rtol = 1e-6, .atol = 1e-6, .recorded_signals = {{"y", line->output(0)}}},
       .exact = detail::until(with.t_end, 10.0, detail::brusselator_reference(with)),
       .methods = {Method::bdf, Method::radau, Method::automatic},
       .growth = 17.0});
}

}  // namespace saltus::models
