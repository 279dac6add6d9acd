// y[k] = 1 if the truth of u changed from tick k - 1 to tick k in the direction of the edge.
#include "saltus/library/edge_detection.hpp"

namespace saltus {

namespace {

bool is_edge(Edge edge, bool before, bool now) {
  switch (edge) {
    case Edge::rising:
      return now && !before;
    case Edge::falling:
      return before && !now;
    case Edge::either:
      return before != now;
  }
  return false;
}

}  // namespace

EdgeDetection::EdgeDetection(std::string name, double dt, const Options& options)
    : SampledSystem(std::move(name)) {
  declare_input_port({.name = "in", .shape = Shape::scalar()});
  declare_law({.dt = dt,
               .may_inherit = true,
               .state = Eigen::VectorXd::Constant(1, options.initial_state ? 1.0 : 0.0),
               .feedthrough = {0},
               .boolean = true,
               .output =
                   [edge = options.edge](const At& at, const VectorView& s, VectorRef y) {
                     y[0] = is_edge(edge, s[0] != 0.0, at.u(0) != 0.0) ? 1.0 : 0.0;
                   },
               .next = [](const At& at, const VectorView&,
                          VectorRef next) { next[0] = at.u(0) != 0.0 ? 1.0 : 0.0; }});
}

}  // namespace saltus
