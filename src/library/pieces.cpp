// A function of one number that is a line or a constant between knots, with one guard for all knots.
#include "saltus/library/detail/pieces.hpp"

#include <cmath>
#include <utility>

namespace saltus::detail {

Pieces::Pieces(const std::string& block, std::vector<double> points, std::string_view interpolation,
               std::string_view extrapolation)
    : points_(std::move(points)), bounded_(extrapolation == "error") {
  require_known(block, "interpolation", interpolation, {"linear", "nearest", "flat"});
  require_known(block, "extrapolation", extrapolation, {"clip", "linear", "error"});
  insist(points_.size() >= 2, block, "expected 2 points or more, found ", points_.size());
  for (const double point : points_)
    insist(std::isfinite(point), block, "point ", point, "; expected finite points");
  for (std::size_t i = 1; i < points_.size(); ++i) {
    insist(points_[i - 1] < points_[i], block, "point ", i, " is ", points_[i], " after ",
           points_[i - 1], "; expected points that increase");
  }
  insist(interpolation == "linear" || extrapolation != "linear", block,
         "extrapolation 'linear' "
         "needs interpolation 'linear', found '",
         interpolation, "'");
  if (interpolation == "linear")
    set_lines(extrapolation == "clip");
  else
    set_constants(interpolation == "nearest");
}

void Pieces::set_lines(bool clipped) {
  const std::size_t last = points_.size() - 1;
  if (clipped) pieces_.push_back({0, false});
  for (std::size_t i = 0; i < last; ++i) pieces_.push_back({i, true});
  if (clipped) pieces_.push_back({last, false});
  const auto inner = clipped ? 0 : 1;
  knots_.assign(points_.begin() + inner, points_.end() - inner);
}

void Pieces::set_constants(bool nearest) {
  for (std::size_t i = 0; i < points_.size(); ++i) {
    pieces_.push_back({i, false});
    if (i > 0) knots_.push_back(nearest ? 0.5 * (points_[i - 1] + points_[i]) : points_[i]);
  }
}

}  // namespace saltus::detail
