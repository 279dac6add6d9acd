#include "saltus/simulation/detail/signal_tangents.hpp"

#include <algorithm>

namespace saltus {

Eigen::MatrixXd signal_tangents(TangentProbe& probe, const Plan& plan, double t, const double* x,
                                const TangentColumns& at) {
  Index width = 0;
  for (const Tap& tap : plan.taps) width += plan.node(tap.node).place.size;
  Eigen::MatrixXd all(width, at.size());
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
