// A rimless wheel: spokes without a rim that roll down a slope, one after the other.
//   d2theta/dt2 = sin theta                     about the standing spoke
//   theta+ = theta- - 2 alpha, theta'+ = cos(2 alpha) theta'-    when theta rises to slope + alpha
// State: angle of the spoke to the vertical theta [rad], its rate theta'; time in units of sqrt(l /
// g), l the length of a spoke. Each step passes the top of an inverted pendulum, where an error
// grows like e^t. The impacts take energy and lead to a limit cycle. T. McGeer, "Passive dynamic
// walking", Int. J. Robotics Research 9 (1990) 62; M. J. Coleman, A. Chatterjee, A. Ruina, "Motions
// of a rimless spoked wheel", Dynamics and Stability of Systems 12 (1997) 139.
#pragma once

#include <numbers>

#include "saltus/models/pieces.hpp"
#include "saltus/report/scene.hpp"

namespace saltus::models {

struct RimlessWheelParameters {
  double alpha = std::numbers::pi / 8;  ///< [rad] half the angle between two spokes
  double slope = 0.08;                  ///< [rad]
  double rate = 0.4;                    ///< at the start, on a spoke that has just touched
  double t_end = 31.0;

  bool usual() const { return alpha == std::numbers::pi / 8 && slope == 0.08 && rate == 0.4; }
};

class RimlessWheel final : public LeafSystem {
 public:
  explicit RimlessWheel(const RimlessWheelParameters& with) : LeafSystem("wheel"), with_(with) {
    declare_continuous_state({.initial = Eigen::Vector2d(with.slope - with.alpha, with.rate),
                              .ode = equations<2>([](const auto& at, auto& xdot) {
                                using std::sin;
                                xdot[0] = at.x(1), xdot[1] = sin(at.x(0));
                              }),
                              .reads = Reads::continuous_state});
    declare_continuous_state_output("state");
    declare_zero_crossing({.name = "spoke",
                           .reset_map = &RimlessWheel::next_spoke,
                           .direction = Direction::negative_then_non_negative,
                           .formula = Formula([with](const auto& at) {
                                        return at.x(0) - (with.slope + with.alpha);
                                      }).called()});
  }

 private:
  void next_spoke(const At& at, Next& next) const {
    next.set_continuous_state({at.x[0] - 2.0 * with_.alpha, std::cos(2.0 * with_.alpha) * at.x[1]});
  }

  RimlessWheelParameters with_;
};

/// The known answer: the usual wheel, up to its tenth spoke. It uses energy (theta'^2 + 2 cos theta
/// is constant from spoke to spoke) and quadrature of dt = dtheta / theta' in 40 digits. Taylor
/// series in 30 digits, with the impacts as their roots, give the same 17 digits of each number.
inline Exact rimless_wheel_answer(const RimlessWheelParameters& with) {
  if (!with.usual()) return {.provenance = "none: not the usual wheel"};
  Exact exact{.provenance = "quadrature in 40 digits; Taylor series agree to 17 digits",
              .events = {{"wheel.spoke", {{}}}}};
  for (const double t :
       {2.4376494276572002, 5.1785361203034414, 8.1316153535854671, 11.216034587672832,
        14.374810471702362, 17.573374826345081, 20.792554411654779, 24.022231509704741,
        27.257206122412456, 30.494841847727096}) {
    if (t <= with.t_end) exact.events[0].series[0].times.push_back(t);
  }
  if (with.t_end > 33.0) exact.events.clear();  // more spokes than are known
  const std::vector<Sample> samples{
      {1.25, Eigen::Vector2d(0.05170786297150886, 0.25629388412883171)},
      {3.75, Eigen::Vector2d(0.026067627643910917, 0.21179468624475064)},
      {6.5, Eigen::Vector2d(0.0058619958741802828, 0.18653122706535055)},
      {9.5, Eigen::Vector2d(0.0026334475879725378, 0.17337094770385464)},
      {12.5, Eigen::Vector2d(-0.01752563684005322, 0.16734156057820489)},
      {16.0, Eigen::Vector2d(0.035594026931770733, 0.16669016912614519)},
      {19.0, Eigen::Vector2d(0.0013413298499978439, 0.16103411901448114)},
      {22.5, Eigen::Vector2d(0.046096722215800844, 0.16661455007231895)},
      {25.5, Eigen::Vector2d(0.0082776155541853325, 0.15986631751779373)},
      {29.0, Eigen::Vector2d(0.051146144962040349, 0.16742311964232737)},
      {31.0, Eigen::Vector2d(-0.16873172825752039, 0.23190788546761152)},
  };
  std::ranges::copy_if(samples, std::back_inserter(exact.samples),
                       [&](const Sample& sample) { return sample.time <= with.t_end; });
  return exact;
}

/// Ten spokes with the defaults. Records the state (theta, theta').
///
/// Growth: an error d of theta' on landing becomes 2 d at the top, where the wheel is slowest, and
/// an error of time of some 10 d, which the impacts hardly reduce. Each of 11 pieces adds 2 to 33,
/// in total 270 (perturbed runs at 1e-13).
inline Scene rimless_wheel(const RimlessWheelParameters& with = {}) {
  const auto wheel = std::make_shared<const RimlessWheel>(with);
  Scene scene{
      .name = "rimless wheel",
      .system = wheel,
      .context = wheel->create_context(),
      .span = {0.0, with.t_end},
      .options = {.rtol = 1e-6, .atol = 1e-7, .recorded_signals = {{"state", wheel->output(0)}}},
      .exact = rimless_wheel_answer(with),
      .gap = [with](double,
                    const Eigen::VectorXd& row) { return with.slope + with.alpha - row[0]; },
      .methods = {Method::dopri5, Method::dop853, Method::adams, Method::taylor, Method::automatic},
      .growth = 270.0};
  for (const Sample& sample : scene.exact.samples) scene.options.save_at.push_back(sample.time);
  return scene;
}

}  // namespace saltus::models
