// What an example says of one run: on the screen, as rows, as JSON.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <ostream>
#include <saltus/report/written.hpp>

namespace examples {

void print_summary(std::ostream& out, const saltus::Scene& scene, const saltus::Results& results);

/// Writes time, pass, and the recorded signals, with one line for each row.
void write_rows(std::ostream& out, const saltus::Results& results);

nlohmann::json to_json(const saltus::Scene& scene, const saltus::Results& results);

}  // namespace examples
