#include "output.hpp"

#include <algorithm>
#include <iomanip>
#include <nlohmann/json.hpp>
#include <saltus/report/table.hpp>
#include <string>
#include <vector>

namespace examples {

namespace {

void print_events(std::ostream& out, const saltus::EventLog& events) {
  constexpr std::size_t most = 12;
  for (std::size_t i = 0; i < std::min(most, events.size()); ++i) {
    const saltus::Event event = events[i];
    out << "  t = " << std::setprecision(15) << event.time << " s  " << event.block << "."
        << event.name << "  " << to_string(event.kind) << "\n";
  }
  if (events.size() > most) out << "  ... and " << events.size() - most << " more\n";
}

}  // namespace

void print_summary(std::ostream& out, const saltus::Scene& scene, const saltus::Results& results) {
  using saltus::detail::short_number, saltus::detail::short_time;
  const saltus::Statistics& s = results.statistics;
  const saltus::Achieved a = achieved(scene, results);
  out << scene.name << ": " << to_string(results.status) << " at t = " << results.context.time()
      << " s, method " << s.method << "\n"
      << results.events.size() << " events\n";
  print_events(out, results.events);
  out << "max error " << short_number(a.error) << ", worst event time "
      << short_number(a.event_error) << " s, events off " << a.event_mismatch << "\n  against: "
      << (scene.exact.provenance.empty() ? "nothing, the answer is not known"
                                         : scene.exact.provenance)
      << "\n";
  out << s.steps << " steps, " << s.rejected << " rejected, " << s.restarts << " restarts, "
      << s.right_hand_side_calls << " right-hand-side, " << s.guard_calls << " guard and "
      << s.jacobian_calls << " Jacobian calls, " << short_time(s.wall_time) << "\n";
}

void write_rows(std::ostream& out, const saltus::Results& results) {
  out << std::setprecision(17) << "time,jump";
  for (const auto& signal : results.signals) {
    for (saltus::Index i = 0; i < signal.shape.size; ++i) {
      out << "," << signal.name;
      if (signal.shape.vector) out << "_" << i;
    }
  }
  out << "\n";
  for (std::size_t row = 0; row < results.time.size(); ++row) {
    out << results.time[row] << "," << results.jump[row];
    const Eigen::VectorXd values = saltus::detail::row_of(results, row);
    for (const double value : values) out << "," << value;
    out << "\n";
  }
}

nlohmann::json to_json(const saltus::Scene& scene, const saltus::Results& results) {
  const saltus::Statistics& s = results.statistics;
  const saltus::Achieved a = achieved(scene, results);
  nlohmann::json events = nlohmann::json::array();
  for (std::size_t i = 0; i < results.events.size(); ++i) {
    const saltus::Event e = results.events[i];
    events.push_back({{"time", e.time},
                      {"jump", e.jump},
                      {"block", e.block},
                      {"name", e.name},
                      {"kind", to_string(e.kind)},
                      {"direction", e.direction},
                      {"predicted", e.predicted},
                      {"before", std::vector(e.before.begin(), e.before.end())},
                      {"after", std::vector(e.after.begin(), e.after.end())}});
  }
  return {{"scene", scene.name},
          {"status", to_string(results.status)},
          {"time", results.context.time()},
          {"method", s.method},
          {"events", events},
          {"achieved",
           {{"error", a.error},
            {"event_error", a.event_error},
            {"event_mismatch", a.event_mismatch},
            {"accumulation_error", a.accumulation_error},
            {"release_error", a.release_error},
            {"against", scene.exact.provenance}}},
          {"statistics",
           {{"steps", s.steps},
            {"rejected", s.rejected},
            {"restarts", s.restarts},
            {"right_hand_side_calls", s.right_hand_side_calls},
            {"guard_calls", s.guard_calls},
            {"jacobian_calls", s.jacobian_calls},
            {"wall_time", s.wall_time}}}};
}

}  // namespace examples
