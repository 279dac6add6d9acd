// TangentTrajectory: keeps the derivatives of steps, and finds those of a time.
#include "saltus/simulation/detail/tangent_trajectory.hpp"

#include <algorithm>
#include <utility>

#include "saltus/plan/detail/resting_states.hpp"

namespace saltus {

namespace {

/// Whether two derivatives are equal; NaN is equal to NaN, because a lost column stays lost.
bool same(const auto& a, const auto& b) {
  return a.size() == b.size() &&
         std::equal(a.data(), a.data() + a.size(), b.data(), [](double left, double right) {
           return left == right || (left != left && right != right);
         });
}

}  // namespace

TangentTrajectory TangentTrajectory::of_parts(std::vector<Part> parts) {
  TangentTrajectory all;
  all.parts_ = std::move(parts);
  return all;
}

std::size_t TangentTrajectory::hold(const TangentColumns& at, const RestingStates& resting) {
  const bool known = !std::exchange(stale_, false) && same(held_.back().columns.z, at.z) &&
                     same(held_.back().columns.y, at.y) && same(held_.back().columns.t, at.t);
  if (known) return held_.size() - 1;
  Held now{{{}, at.z, at.y, at.t, at.p}, List<char>(at.x.rows())};
  for (Index i = 0; i < at.x.rows(); ++i) now.rests[i] = resting.rests(i);
  held_.push_back(std::move(now));
  return held_.size() - 1;
}

std::size_t TangentTrajectory::keep(const TangentSizes& sizes) {
  if (sizes_.empty() || !(sizes_.back() == sizes)) sizes_.push_back(sizes);
  return sizes_.size() - 1;
}

TangentTrajectory::Piece TangentTrajectory::constant(double t, const TangentColumns& at,
                                                     const RestingStates& resting,
                                                     const TangentSizes& sizes) {
  const std::size_t kept = keep(sizes);
  return {{t, t, {at.x}}, hold(at, resting), kept, kept};
}

void TangentTrajectory::open(double t, const TangentColumns& at, const RestingStates& resting,
                             const TangentSizes& sizes) {
  *this = {};
  first_ = last_ = constant(t, at, resting, sizes);
}

void TangentTrajectory::add(double from, double to, const std::vector<Variation::Piece>& pieces,
                            const TangentColumns& at, const RestingStates& resting,
                            const TangentSizes& sizes) {
  if (!(to > from)) return;
  const std::size_t held = hold(at, resting), begin = sizes_.size() - 1, kept = keep(sizes);
  if (pieces.empty()) pieces_.push_back({{from, to, {at.x}}, held, begin, kept});
  for (const Variation::Piece& s : pieces)
    pieces_.push_back({s, held, s.from == from ? begin : kept, kept});
}

void TangentTrajectory::close(double t, const TangentColumns& at, const RestingStates& resting,
                              const TangentSizes& sizes, bool whole) {
  if (whole) {
    last_ = constant(t, at, resting, sizes);
  } else if (pieces_.empty()) {
    last_ = first_;
  } else {
    last_ = pieces_.back();
    last_.s = {last_.s.to, last_.s.to, {last_.s.s.back()}};
  }
}

/// As Trajectory::spot.
const TangentTrajectory::Piece& TangentTrajectory::piece(double t, Side side) const {
  const auto begin = [](const Piece& piece) { return piece.s.from; };
  const auto end = [](const Piece& piece) { return piece.s.to; };
  if (side == Side::right && t >= last_.s.to) return last_;
  if (side == Side::left && t <= first_.s.from) return first_;
  return side == Side::right ? *(std::ranges::upper_bound(pieces_, t, {}, begin) - 1)
                             : *std::ranges::lower_bound(pieces_, t, {}, end);
}

TangentTrajectory::Moment TangentTrajectory::at(double t, Side side) const {
  const Piece& found = piece(t, side);
  const bool at_begin = side == Side::right && t == found.s.from;
  Moment moment{held_[found.held].columns, &held_[found.held].rests,
                &sizes_[at_begin ? found.sizes_at_begin : found.sizes]};
  moment.columns.x = found.s.at(t);
  return moment;
}

}  // namespace saltus
