// Robertson's reaction A -> B, 2 B -> B + C, B + C -> A + C: three rates nine decades apart, run
// over eleven decades of time.
//   dy1/dt = -0.04 y1 + 1e4 y2 y3
//   dy2/dt =  0.04 y1 - 1e4 y2 y3 - 3e7 y2^2
//   dy3/dt =  3e7 y2^2
// State: concentrations y1, y2, y3 (without unit), y1 + y2 + y3 = 1; time in seconds; y(0) = (1, 0,
// 0). The rates are parameters k1, k2, k3. Two monitors, as in the example cvRoberts_dns of
// SUNDIALS: y1 = 1e-4 and y3 = 0.01. H. H. Robertson, "The solution of a set of reaction rate
// equations", in J. Walsh (ed.), Numerical Analysis, 1966; E. Hairer, G. Wanner, Solving Ordinary
// Differential Equations II, p. 144, ROBER. It shows the use of a stiff method.
#pragma once

#include "saltus/report/scene.hpp"

namespace saltus::models {

class Robertson final : public LeafSystem {
 public:
  explicit Robertson(double k1 = 0.04, double k2 = 1e4, double k3 = 3e7) : LeafSystem("reaction") {
    declare_continuous_state({.initial = Eigen::Vector3d(1.0, 0.0, 0.0),
                              .ode = &Robertson::ode,
                              .jacobian = &Robertson::jacobian});
    declare_continuous_state_output("y");
    k1_ = declare_dynamic_parameter("k1", k1);
    k2_ = declare_dynamic_parameter("k2", k2);
    k3_ = declare_dynamic_parameter("k3", k3);
    declare_zero_crossing(
        {.name = "y1_is_1e-4", .guard = [](const At& at) { return at.x[0] - 1e-4; }});
    declare_zero_crossing(
        {.name = "y3_is_0.01", .guard = [](const At& at) { return at.x[2] - 0.01; }});
  }

 private:
  void ode(const At& at, VectorRef xdot) const {
    const double decay = at.p[k1_] * at.x[0], back = at.p[k2_] * at.x[1] * at.x[2],
                 on = at.p[k3_] * at.x[1] * at.x[1];
    xdot << back - decay, decay - back - on, on;
  }
  void jacobian(const At& at, MatrixRef out) const {
    const double k1 = at.p[k1_], by2 = at.p[k2_] * at.x[2], by3 = at.p[k2_] * at.x[1],
                 on = 2.0 * at.p[k3_] * at.x[1];
    out << -k1, by2, by3,     //
        k1, -by2 - on, -by3,  //
        0.0, on, 0.0;
  }

  ParameterIndex k1_, k2_, k3_;  // [1/s]
};

struct RobertsonParameters {
  double k1 = 0.04, k2 = 1e4, k3 = 3e7;  ///< [1/s]
  double t_end = 4e10;                   ///< [s]
};

namespace detail {

/// The values have 16 digits, by Radau IIA of order 13 in 40 digits, 20 steps to a decade; order 9
/// gives the same to 6e-13. The known value at 1e11 s (Test Set for IVP Solvers, ROBER:
/// 2.083340149701255e-8,
/// 8.333360770334713e-14, 0.9999999791665050) differs from the result by 2e-14 of its size. The
/// value at 4e10 s in cvRoberts_dns (5.20834743e-8, 2.08333908e-13) is good to 6 digits.
inline const std::vector<Sample>& robertson_samples() {
  static const std::vector<Sample> samples{
      {4e-1, Eigen::Vector3d(0.98517211386098986, 3.3863953789749041e-5, 0.014794022185220389)},
      {4e0, Eigen::Vector3d(0.90551867858425391, 2.2404756875602014e-5, 0.094458916658870486)},
      {4e1, Eigen::Vector3d(0.71582706871940509, 9.1855347645577704e-6, 0.28416374574583035)},
      {4e2, Eigen::Vector3d(0.45051866847110242, 3.2229014416746115e-6, 0.54947810862745590)},
      {4e3, Eigen::Vector3d(0.18320225777671093, 8.9423712527759093e-7, 0.81679684798616541)},
      {4e4, Eigen::Vector3d(0.038983377085482852, 1.6217683159096824e-7, 0.96101646073768556)},
      {4e5, Eigen::Vector3d(0.0049382745209798156, 1.9849940879543754e-8, 0.99506170562907930)},
      {4e6, Eigen::Vector3d(5.1680960149243842e-4, 2.0682944912244536e-9, 0.99948318833021307)},
      {4e7, Eigen::Vector3d(5.2030718441205474e-5, 2.0813357318925327e-10, 0.99994796907342522)},
      {4e8, Eigen::Vector3d(5.2077021035731725e-6, 2.0830915594153650e-11, 0.99999479227706551)},
      {4e9, Eigen::Vector3d(5.2082766114359351e-7, 2.0833117166045720e-12, 0.99999947917025554)},
      {4e10, Eigen::Vector3d(5.2083451767992392e-8, 2.0833381779254890e-13, 0.99999994791633990)},
  };
  return samples;
}

}  // namespace detail

/// The known answer for the original rates, up to t_end; for other rates none is known.
inline Exact robertson_answer(const RobertsonParameters& with) {
  if (with.k1 != 0.04 || with.k2 != 1e4 || with.k3 != 3e7)
    return {.provenance = "none: not the original rates"};
  const auto until = [&](double t) {
    return t <= with.t_end ? std::vector{t} : std::vector<double>{};
  };
  Exact exact{
      .provenance =
          "Radau IIA of order 13 in 40 digits; agrees with the Test Set for IVP Solvers, ROBER",
      .events = {{"reaction.y3_is_0.01", {{.times = until(0.26401907818763256)}}},
                 {"reaction.y1_is_1e-4", {{.times = until(20795496.883026623)}}}}};
  for (const Sample& sample : detail::robertson_samples()) {
    if (sample.time <= with.t_end) exact.samples.push_back(sample);
  }
  return exact;
}

/// Records "y" at the times of the reference, 0.4, 4, 40, ... s. atol is so small because of y2,
/// which reaches 3.6e-5 and ends at 2e-13. The growth: see hires.hpp.
inline Scene robertson(const RobertsonParameters& with = {}) {
  const auto reaction = std::make_shared<const Robertson>(with.k1, with.k2, with.k3);
  Scene scene{
      .name = "Robertson",
      .system = reaction,
      .context = reaction->create_context(),
      .span = {0.0, with.t_end},
      .options = {.rtol = 1e-6, .atol = 1e-14, .recorded_signals = {{"y", reaction->output(0)}}},
      .exact = robertson_answer(with),
      .invariants = {{"y1 + y2 + y3", [](double, const Eigen::VectorXd& y) { return y.sum(); }}},
      .methods = {Method::bdf, Method::radau, Method::automatic},
      .growth = 2.0};
  for (const Sample& sample : scene.exact.samples) scene.options.save_at.push_back(sample.time);
  return scene;
}

}  // namespace saltus::models
