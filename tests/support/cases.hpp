// The common parts of cases whose answers are known: forms of a scene, and a line for each
// comparison.
#pragma once

#include <cstdlib>
#include <fstream>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "support/balls.hpp"
#include "support/leaves.hpp"

namespace support {

/// A leaf that is made at its place of use, as a system that forms share.
template <class Declare>
std::shared_ptr<Leaf> make_leaf(std::string name, Declare declare) {
  return std::make_shared<Leaf>(std::move(name), declare);
}

/// A leaf alone, or as the only block of a diagram: the same events, the same numbers.
struct Form {
  std::shared_ptr<const saltus::System> system;
  std::string name;

  saltus::Context context(double t = 0.0) const { return system->create_context(t); }
};

inline std::vector<Form> forms(const std::shared_ptr<Leaf>& leaf) {
  saltus::DiagramBuilder builder;
  builder.add(leaf);
  return {{leaf, "leaf"}, {std::make_shared<saltus::Diagram>(builder.build()), "diagram"}};
}

/// Ten local errors of a state of this size, times the growth of the problem. For BDF it is a
/// hundred, because BDF takes ten times the steps on a smooth scene that is not stiff.
inline double allowed(saltus::Method method, double rtol, double atol, double size,
                      double growth = 1.0) {
  return (method == saltus::Method::bdf ? 100.0 : 10.0) * (rtol * size + atol) * growth;
}

/// A Runge-Kutta method is exact on parabolas; a multistep method, starting anew, is not.
inline bool one_step(saltus::Method method) {
  return method != saltus::Method::adams && method != saltus::Method::bdf;
}

/// The largest of |found - expected|; infinite if their numbers differ.
inline double worst(const std::vector<double>& found, const std::vector<double>& expected) {
  if (found.size() != expected.size()) return infinite;
  double most = 0.0;
  for (std::size_t i = 0; i < found.size(); ++i) {
    const double error = std::abs(found[i] - expected[i]);
    if (!(error <= most)) most = std::isnan(error) ? infinite : error;
  }
  return most;
}

/// error <= tolerance. With SALTUS_CASES in the environment each comparison is a line of that file:
/// scene, method, error, tolerance.
inline void within(const std::string& scene, saltus::Method method, double error,
                   double tolerance) {
  if (const char* file = std::getenv("SALTUS_CASES")) {
    std::ofstream(file, std::ios::app)
        << scene << '\t' << method << '\t' << error << '\t' << tolerance << '\n';
  }
  INFO(scene << ", method " << method << ": error " << error << ", tolerance " << tolerance);
  CHECK(error <= tolerance);
}

/// The times of all firings, in order, whatever their names.
inline std::vector<double> firing_times(const saltus::EventLog& log) {
  std::vector<double> times;
  for (std::size_t i = 0; i < log.size(); ++i) {
    if (log[i].kind == saltus::EventKind::zero_crossing) times.push_back(log[i].time);
  }
  return times;
}

/// The contacts of the ball of a `BallScene`, leaf or blocks, in order.
inline std::vector<double> contact_times(const saltus::EventLog& log) {
  std::vector<double> times;
  for (std::size_t i = 0; i < log.size(); ++i) {
    const saltus::Event event = log[i];
    if (event.kind == saltus::EventKind::zero_crossing &&
        (event.block == "ball" || event.block == "integrator_y"))
      times.push_back(event.time);
  }
  return times;
}

/// The names of all firings, in order.
inline std::vector<std::string> firing_names(const saltus::EventLog& log) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < log.size(); ++i) {
    if (log[i].kind == saltus::EventKind::zero_crossing) names.emplace_back(log[i].name);
  }
  return names;
}

}  // namespace support
