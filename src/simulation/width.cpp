// The widths of tolerances: found, expected, and the blocks that the states belong to.
#include "width.hpp"

namespace saltus {

namespace {

/// The blocks with continuous states and their numbers, in order.
std::string words_of_states(const Plan& plan) {
  constexpr int most = 8;
  std::string out;
  int count = 0;
  for (const PlanLeaf& leaf : plan.leaves) {
    if (leaf.nx == 0) continue;
    if (count++ == most) return out + ", ...";
    out += text(count == 1 ? "" : ", ", "'", leaf.path, "' ", leaf.nx);
  }
  return out.empty() ? "there is none" : out;
}

void require_width(const char* name, const Tolerance& tolerance, const Plan& plan) {
  if (!tolerance.by_state() || static_cast<Index>(tolerance.each().size()) == plan.nx) return;
  throw ModelError(text("option ", name, ": expected one number, or ", plan.nx,
                        " numbers, one for each continuous state (", words_of_states(plan),
                        "); found ", tolerance.each().size()));
}

}  // namespace

void require_widths(const SimulatorOptions& options, const Plan& plan) {
  require_width("rtol", options.rtol, plan);
  require_width("atol", options.atol, plan);
}

std::vector<double> each_of(const Tolerance& tolerance, Index n) {
  std::vector<double> all;
  for (Index i = 0; i < n; ++i) all.push_back(tolerance[i]);
  return all;
}

}  // namespace saltus
