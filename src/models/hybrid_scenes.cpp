#include "saltus/models/bouncing_ball.hpp"
#include "saltus/models/bouncing_ball_diagram.hpp"
#include "shelf.hpp"

namespace saltus::models::detail {

std::vector<ShelfEntry> hybrid_scenes() {
  return {
      {"bouncing-ball", "a ball over a floor, as one leaf", [] { return bouncing_ball(); }},
      {"bouncing-ball-blocks", "the same of blocks", [] { return bouncing_ball_diagram(); }},
  };
}

}  // namespace saltus::models::detail
