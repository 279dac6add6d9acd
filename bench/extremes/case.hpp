// An extreme case: a scene, the options of its run, and the law that its result must obey.
#pragma once

#include <array>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <saltus/saltus.hpp>

namespace extremes {

using saltus::At;
using saltus::Context;
using saltus::Direction;
using saltus::Index;
using saltus::LeafSystem;
using saltus::Method;
using saltus::Next;
using saltus::Results;
using saltus::SimulatorOptions;
using saltus::System;
using saltus::text;
using saltus::TimeSpan;
using saltus::VectorRef;

inline constexpr double infinite = std::numeric_limits<double>::infinity();
inline constexpr double eps = std::numeric_limits<double>::epsilon();

using Methods = std::vector<Method>;
inline const Methods every{Method::dopri5, Method::dop853, Method::adams,
                           Method::bdf,    Method::radau,  Method::automatic};
inline const Methods explicit_ones{Method::dopri5, Method::dop853, Method::adams,
                                   Method::automatic};
inline const Methods stiff_ones{Method::bdf, Method::radau, Method::automatic};
inline const Methods runge_kutta{Method::dopri5, Method::dop853, Method::automatic};

/// The distance of a run from the exact answer.
struct Finding {
  double error = 0.0;        ///< in units of the tolerance, see laws.hpp
  double allowed = 10.0;     ///< in the same
  std::string events = {};   ///< "12 of 12", if the law gives the events
  bool events_right = true;  ///< their number; their times are part of the error
};

/// The method is `options.ode_solver_method`.
using Law = std::function<Finding(const Results&, const SimulatorOptions& options)>;

/// One run.
struct Trial {
  std::shared_ptr<const System> system;
  Context start;
  TimeSpan span;
  SimulatorOptions options = {};
  Law law = {};
};

/// The required result.
enum class Expected {
  answer,  ///< the right one
  error,   ///< a clear error: there is no answer, or none in double precision
  either   ///< one or the other: at the edge of double precision
};

/// A row of the table for each method; the worst of several trials counts.
struct Case {
  std::string name;
  Methods methods;
  std::function<std::vector<Trial>()> trials;  ///< made when they are run: some are large
  Expected expected = Expected::answer;
  std::string error_says = {};  ///< a part of the message, where an error is expected
  double error_time = std::numeric_limits<double>::quiet_NaN();  ///< [s] when, to 1e-3 of it
  bool quick = true;                                             ///< short enough for the tests
};

struct Group {
  std::string title, text;
  std::vector<Case> cases;
};

/// A leaf that is declared at its place of use.
class Leaf final : public LeafSystem {
 public:
  template <class Declare>
  Leaf(std::string name, Declare declare) : LeafSystem(std::move(name)) {
    declare(*this);
  }
  using LeafSystem::declare_continuous_state;
  using LeafSystem::declare_default_mode;
  using LeafSystem::declare_discrete_state;
  using LeafSystem::declare_jacobian;
  using LeafSystem::declare_jacobian_sparsity;
  using LeafSystem::declare_one_shot;
  using LeafSystem::declare_periodic_update;
  using LeafSystem::declare_zero_crossing;
};

template <class Declare>
std::shared_ptr<const Leaf> make_leaf(Declare declare) {
  return std::make_shared<const Leaf>("leaf", declare);
}

inline Eigen::VectorXd vec(std::initializer_list<double> values) {
  return Eigen::Map<const Eigen::VectorXd>(values.begin(), static_cast<Index>(values.size()));
}

/// A run that starts from the declared values of the system.
inline Trial trial(const std::shared_ptr<const System>& system, TimeSpan span,
                   SimulatorOptions options, Law law = {}) {
  return {system, system->create_context(span.begin), span, std::move(options), std::move(law)};
}

/// A case of one trial, which needs no list.
inline std::function<std::vector<Trial>()> one(std::function<Trial()> make) {
  return [make] { return std::vector<Trial>{make()}; };
}

}  // namespace extremes
