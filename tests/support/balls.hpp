// Balls over floors: as a leaf, as a leaf with the floor as an input, and from blocks.
#pragma once

#include <cmath>
#include <memory>
#include <span>
#include <string>

#include "saltus/library/library.hpp"
#include "saltus/model/diagram_builder.hpp"
#include "support/run.hpp"

namespace support {

using saltus::Direction;

struct BallOptions {
  double g = 9.81;     ///< [m/s^2]
  double e = 0.9;      ///< coefficient of restitution
  double floor = 0.0;  ///< [m]
  std::optional<double> zeno_tolerance = {};
};

/// State: height [m], velocity [m/s]. The floor is a parameter.
class Ball final : public saltus::LeafSystem {
 public:
  explicit Ball(const BallOptions& options = {}, std::string name = "ball")
      : LeafSystem(std::move(name)), e_(options.e) {
    declare_continuous_state(2, &Ball::ode);
    declare_continuous_state_output("state");
    g_ = declare_dynamic_parameter("g", options.g);
    floor_ = declare_dynamic_parameter("floor", options.floor);
    declare_zero_crossing({.name = "bounce",
                           .guard = &Ball::height,
                           .reset_map = &Ball::bounce,
                           .direction = Direction::positive_then_non_positive,
                           .zeno_tolerance = options.zeno_tolerance});
  }

 private:
  void ode(const At& at, VectorRef xdot) const { xdot << at.x[1], -at.p[g_]; }
  double height(const At& at) const { return at.x[0] - at.p[floor_]; }
  void bounce(const At& at, Next& next) const {
    next.set_continuous_state({at.p[floor_], -e_ * at.x[1]});
  }

  double e_;
  saltus::ParameterIndex g_, floor_;
};

/// The same with the floor [m] as input 0.
class BallOnTable final : public saltus::LeafSystem {
 public:
  explicit BallOnTable(const BallOptions& options = {}, std::string name = "ball")
      : LeafSystem(std::move(name)), g_(options.g), e_(options.e) {
    declare_continuous_state({.initial = Eigen::VectorXd::Zero(2),
                              .ode = &BallOnTable::ode,
                              .reads = saltus::Reads::continuous_state});
    declare_input_port({.name = "floor", .shape = saltus::Shape::scalar()});
    declare_continuous_state_output("state");
    declare_zero_crossing({.name = "bounce",
                           .guard = &BallOnTable::height,
                           .reset_map = &BallOnTable::bounce,
                           .direction = Direction::positive_then_non_positive,
                           .zeno_tolerance = options.zeno_tolerance});
  }

 private:
  void ode(const At& at, VectorRef xdot) const { xdot << at.x[1], -g_; }
  double height(const At& at) const { return at.x[0] - at.u(0); }
  void bounce(const At& at, Next& next) const {
    next.set_continuous_state({at.u(0), -e_ * at.x[1]});
  }

  double g_, e_;
};

/// The signal by which a diagram knows that the ball touches the floor: a relation, or an opaque
/// boolean.
enum class Contact { comparator, reduce, function };
inline constexpr std::array contacts{Contact::comparator, Contact::reduce, Contact::function};

/// A ball as a system of any form, with the facts that a test needs.
struct BallScene {
  std::shared_ptr<const saltus::System> system;
  std::string form;
  saltus::OutputPort height;
  int monitors = 1;  ///< Zeno monitors of one ball; two integrators have one each
  bool leaf = true;

  saltus::Context context(double y, double v, double t = 0.0) const {
    Eigen::VectorXd x(2);
    x << y, v;
    return system->create_context(t).with_continuous_state(
        x);  // blocks: integrator_y is added first
  }
};

/// The tutorial's diagram: two integrators, a floor, and the comparison y < floor in the form of `contact`.
inline BallScene blocks(Contact contact, const BallOptions& options,
                        std::shared_ptr<const saltus::System> floor) {
  using namespace saltus;
  DiagramBuilder builder;
  const Integrator::Options integrator{.enable_reset = true,
                                       .enable_external_reset = true,
                                       .zeno_tolerance = options.zeno_tolerance};
  auto& y = builder.add<Integrator>("integrator_y", integrator);
  auto& v = builder.add<Integrator>("integrator_v", integrator);
  auto& gravity = builder.add<Constant>("gravity", -options.g);
  auto& reflect = builder.add<Gain>("reflect", -options.e);
  builder.add(floor);
  builder.connect(gravity.output(), v.input("in"));
  builder.connect(v.output(), y.input("in"));
  OutputPort touches;
  const char* names[] = {"Comparator", "ReduceBlock", "FunctionBlock"};
  if (contact == Contact::function) {
    auto& gap = builder.add<Adder>("gap", "+-");
    auto& below = builder.add<FunctionBlock>("touches", [](double h) { return h < 0.0; });
    builder.connect(y.output(), gap.input(0)), builder.connect(floor->output(), gap.input(1));
    builder.connect(gap.output(), below.input());
    touches = below.output();
  } else if (contact == Contact::reduce) {
    auto& below = builder.add<ReduceBlock>("touches", 2,
                                           [](std::span<const double> u) { return u[0] < u[1]; });
    builder.connect(y.output(), below.input(0)), builder.connect(floor->output(), below.input(1));
    touches = below.output();
  } else {
    auto& below = builder.add<Comparator>("touches", "<");
    builder.connect(y.output(), below.input(0)), builder.connect(floor->output(), below.input(1));
    touches = below.output();
  }
  builder.connect(touches, y.input("reset_trigger")),
      builder.connect(touches, v.input("reset_trigger"));
  builder.connect(floor->output(), y.input("reset_value"));
  builder.connect(v.output(), reflect.input()),
      builder.connect(reflect.output(), v.input("reset_value"));
  const OutputPort height = y.output();
  return {std::make_shared<Diagram>(builder.build()), names[static_cast<std::size_t>(contact)],
          height, 2, false};
}

inline BallScene blocks(Contact contact, const BallOptions& options = {}) {
  return blocks(contact, options, std::make_shared<saltus::Constant>("floor", options.floor));
}

inline BallScene leaf(const BallOptions& options = {}) {
  auto ball = std::make_shared<Ball>(options);
  const saltus::OutputPort height = ball->output(0);
  return {ball, "leaf", height};
}

/// A leaf over a floor that is the output of another block.
inline BallScene leaf_on(const BallOptions& options, std::shared_ptr<const saltus::System> floor) {
  saltus::DiagramBuilder builder;
  auto& ball = builder.add<BallOnTable>(options);
  builder.add(floor);
  builder.connect(floor->output(), ball.input());
  return {std::make_shared<saltus::Diagram>(builder.build()), "leaf with floor", ball.output()};
}

/// All forms of a ball over a fixed floor.
inline std::vector<BallScene> all_forms(const BallOptions& options = {}) {
  std::vector<BallScene> all{
      leaf(options), leaf_on(options, std::make_shared<saltus::Constant>("floor", options.floor))};
  for (const Contact contact : contacts) all.push_back(blocks(contact, options));
  return all;
}

/// All forms of a ball over the floor that `make_floor` makes.
template <class MakeFloor>
std::vector<BallScene> all_forms_over(const BallOptions& options, MakeFloor make_floor) {
  std::vector<BallScene> all{leaf_on(options, make_floor())};
  for (const Contact contact : contacts) all.push_back(blocks(contact, options, make_floor()));
  return all;
}

/// Closed forms of a ball dropped from height h [m] above its floor.
struct BallExact {
  double g, e, h;
  double first() const { return std::sqrt(2.0 * h / g); }  ///< [s] first contact
  double speed(int k) const {
    return std::pow(e, k) * g * first();
  }  ///< [m/s] after contact k = 1, 2, ...
  double contact(int k) const {  ///< [s] contact k = 1, 2, ...
    double t = first();
    for (int i = 1; i < k; ++i) t += 2.0 * speed(i) / g;
    return t;
  }
  double rest() const {
    return first() * (1.0 + e) / (1.0 - e);
  }  ///< [s] where the contacts accumulate
};

}  // namespace support
