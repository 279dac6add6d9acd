// The eight stiff scenes on which solvers are compared, with the answers of the shelf.
#pragma once

#include "stiff_ring.hpp"
#include "stiff_shelf.hpp"

namespace bench {

/// The shelf's scene has the answer, the ratio of its tolerances, and the span.
inline StiffScene stiff_scene(const std::string& name, StiffProblem problem) {
  const saltus::Scene shelf = saltus::models::scene(name);
  return {name, std::move(problem), shelf.exact.samples,
          shelf.options.atol.smallest() / shelf.options.rtol.smallest()};
}

inline std::vector<StiffScene> stiff_scenes() {
  return {stiff_scene("vdpol", vdpol<1'000'000>()),
          stiff_scene("vdpol-1e6", vdpol<1'000'000'000'000>()),
          stiff_scene("robertson", robertson()),
          stiff_scene("hires", hires_with_jacobian()),
          stiff_scene("orego", oregonator()),
          stiff_scene("ring-modulator", ring_modulator()),
          stiff_scene("pollu", pollu()),
          stiff_scene("e5", e5())};
}

}  // namespace bench
