// SimulatorOptions: the refusal of values that make no sense.
#include "saltus/simulation/options.hpp"

#include <cmath>

namespace saltus {

namespace {

void require(bool right, std::string_view option, double found, std::string_view expected) {
  if (!right) throw ModelError(text("option ", option, ": expected ", expected, ", found ", found));
}

}  // namespace

namespace detail {

void check(const SimulatorOptions& o) {
  require(o.rtol > 0.0 && std::isfinite(o.rtol), "rtol", o.rtol, "a positive number");
  require(o.atol > 0.0 && std::isfinite(o.atol), "atol", o.atol, "a positive number");
  require(o.rtol >= 1e-15, "rtol", o.rtol, "at least 1e-15: a double has no more digits");
  require(!o.max_major_steps || *o.max_major_steps > 0, "max_major_steps",
          static_cast<double>(o.max_major_steps.value_or(1)), "a positive number, or none");
  require(o.max_major_step_length > 0.0, "max_major_step_length", o.max_major_step_length,
          "a time > 0 s");
  require(o.min_minor_step_size >= 0.0, "min_minor_step_size", o.min_minor_step_size,
          "a time >= 0 s");
  require(o.max_minor_step_size > o.min_minor_step_size, "max_minor_step_size",
          o.max_minor_step_size, "more than min_minor_step_size");
  require(o.zeno_tolerance >= 0.0, "zeno_tolerance", o.zeno_tolerance, "a time >= 0 s");
  require(o.event_scan_points >= 0, "event_scan_points", o.event_scan_points, "0 or more");
  require(o.max_passes > 0, "max_passes", o.max_passes, "1 or more");
  if (!o.event_rows && o.save_at.empty())
    throw ModelError("option event_rows = false: say with save_at when rows are wanted");
  for (const double t : o.save_at) require(std::isfinite(t), "save_at", t, "increasing times");
  for (std::size_t i = 1; i < o.save_at.size(); ++i) {
    require(o.save_at[i] > o.save_at[i - 1], "save_at", o.save_at[i], "increasing times");
  }
}

}  // namespace detail

}  // namespace saltus
