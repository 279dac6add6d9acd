#include "saltus/simulation/detail/signal_tangents.hpp"

#include <algorithm>

namespace saltus {

namespace {

/// Whether a recorded signal is entries of the state.
bool is_view(const Plan& plan, const Tap& tap) {
  const Space space = plan.node(tap.node).place.space;
  return space == Space::x || space == Space::z;
}

}  // namespace

Eigen::MatrixXd signal_tangents(TangentProbe& probe, const Plan& plan, double t, const double* x,
                                const TangentColumns& at) {
  Index width = 0;
  for (const Tap& tap : plan.taps) width += plan.node(tap.node).place.size;
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(width, at.size());
  if (std::ranges::all_of(plan.taps, [&](const Tap& tap) { return is_view(plan, tap); }))
    return all;
  const auto read = [&](Machine& moved, double, double* out) {
    const Values values = moved.evaluate_taps(t, moved.x.data());
    for (const Tap& tap : plan.taps) {
      const Place& place = plan.node(tap.node).place;
      out = std::copy_n(values(place), place.size, out);
    }
  };
  for (Index k = 0; k < at.size(); ++k)
    probe.derivative(x, at.column(k), width, read, all.col(k).data());
  return all;
}

void put_views(const Plan& plan, const Eigen::MatrixXd& by_x, const Eigen::MatrixXd& by_z,
               Eigen::MatrixXd& all) {
  Index first = 0;
  for (const Tap& tap : plan.taps) {
    const Place& place = plan.node(tap.node).place;
    if (place.space == Space::x)
      all.middleRows(first, place.size) = by_x.middleRows(place.offset, place.size);
    if (place.space == Space::z)
      all.middleRows(first, place.size) = by_z.middleRows(place.offset, place.size);
    first += place.size;
  }
}

}  // namespace saltus
