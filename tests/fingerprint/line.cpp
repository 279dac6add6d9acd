#include "fingerprint/line.hpp"

#include <algorithm>
#include <cstdlib>
#include <fstream>

#include <saltus/model/context_json.hpp>

#include "fingerprint/hash.hpp"

namespace fingerprint {

namespace {

using saltus::Results;

/// Both sides of each joint of what the solver drew, and one time within.
void add_trajectory(const saltus::Trajectory& drawn, Hash& hash) {
  if (drawn.empty()) return;
  Eigen::VectorXd x(drawn.start().continuous_state().size());
  const auto look = [&](double t, saltus::Side side) {
    drawn.state(drawn.spot(t, side), t, x.data());
    hash.add(t), hash.add(x);
  };
  const std::vector<double> joints = drawn.joints();
  for (std::size_t i = 0; i < joints.size(); ++i) {
    look(joints[i], saltus::Side::left), look(joints[i], saltus::Side::right);
    if (i > 0 && joints[i] > joints[i - 1])
      look(joints[i - 1] + 0.375 * (joints[i] - joints[i - 1]), saltus::Side::right);
  }
}

std::string rows(const Results& results, std::size_t first) {
  Hash hash;
  hash.add(results.time.size());
  for (std::size_t i = first; i < results.time.size(); ++i)
    hash.add(results.time[i]), hash.add(results.jump[i]);
  for (const saltus::RecordedSignal& signal : results.signals) {
    hash.add(signal.name), hash.add(signal.shape.size), hash.add(signal.values.size());
    for (std::size_t i = first * static_cast<std::size_t>(signal.shape.size);
         i < signal.values.size(); ++i)
      hash.add(signal.values[i]);
  }
  add_trajectory(results.trajectory, hash);
  return hash.text();
}

std::string events(const saltus::EventLog& log, std::size_t first) {
  Hash hash;
  hash.add(log.size()), hash.add(log.names());
  for (std::size_t i = first; i < log.size(); ++i) {
    const saltus::Event event = log[i];
    hash.add(event.time), hash.add(event.jump), hash.add(to_string(event.kind));
    hash.add(event.direction), hash.add(event.block), hash.add(event.name);
    hash.add(std::isnan(event.predicted) ? -1.0 : event.predicted);
    hash.add(event.before), hash.add(event.after), hash.add(event.entry);
  }
  return hash.text();
}

/// All but the wall time.
std::string statistics(const saltus::Statistics& s) {
  Hash hash;
  hash.add(s.steps), hash.add(s.rejected), hash.add(s.restarts), hash.add(s.linear_setups);
  hash.add(s.linear_solver), hash.add(s.right_hand_side_calls), hash.add(s.guard_calls);
  hash.add(s.jacobian_calls), hash.add(s.events), hash.add(s.instants), hash.add(s.method);
  for (const auto& [name, count] : s.events_by_name) hash.add(name), hash.add(count);
  for (const saltus::Stretch& part : s.stretches) {
    hash.add(part.method), hash.add(part.begin), hash.add(part.end), hash.add(part.steps);
  }
  return hash.text();
}

std::string context(const saltus::Context& context) {
  const saltus::ContextValues v = context.values();
  Hash hash;
  hash.add(v.time), hash.add(v.continuous_state), hash.add(v.discrete_state);
  hash.add(v.parameters), hash.add(v.modes), hash.add(v.settled);
  return hash.text();
}

/// As it is saved: its form may change where the values of a run do not.
std::string continuation(const saltus::Context& context) {
  Hash hash;
  if (context.continuation() != nullptr) {
    saltus::Continuation copy = *context.continuation();
    hash.add(saltus::detail::written<saltus::detail::JsonTree>(copy).dump());
  }
  return hash.text();
}

std::string what(const std::exception_ptr& cause) {
  if (!cause) return "";
  try {
    std::rethrow_exception(cause);
  } catch (const std::exception& error) {
    return error.what();
  } catch (...) {
    return "no standard exception";
  }
}

std::string error(const Results& results) {
  Hash hash;
  hash.add(to_string(results.status)), hash.add(results.message), hash.add(results.block);
  hash.add(what(results.cause));
  return hash.text();
}

std::size_t written = 0;

}  // namespace

std::string parts(const Results& results, const Seen& seen) {
  if (results.status == saltus::Status::interrupted) return "-\t-\t-\t-\t-\t-\tinterrupted";
  return saltus::text(rows(results, seen.rows), "\t", events(results.events, seen.events), "\t",
                      statistics(results.statistics), "\t", context(results.context), "\t",
                      continuation(results.context), "\t", error(results), "\t",
                      to_string(results.status));
}

std::string refused(const std::string& message) {
  Hash hash;
  hash.add(message);
  return "-\t-\t-\t-\t-\t" + hash.text() + "\trefused";
}

void write(const std::string& scene, const std::string& method, const std::string& parts) {
  ++written;
  const char* name = std::getenv("SALTUS_FINGERPRINT");
  if (name == nullptr) return;
  static std::ofstream file(name, std::ios::app);
  std::string one_line = scene;
  std::ranges::replace(one_line, '\t', ' ');
  file << one_line << "\t" << method << "\t" << parts << std::endl;
}

std::size_t lines() { return written; }

}  // namespace fingerprint
