// Trajectory: keeps steps, and reads states inside them.
#include "saltus/simulation/detail/trajectory.hpp"
#include "saltus/base/list.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "saltus/simulation/detail/contact.hpp"

namespace saltus {

Trajectory::Trajectory() = default;
Trajectory::~Trajectory() = default;
Trajectory::Trajectory(const Trajectory&) = default;
Trajectory& Trajectory::operator=(const Trajectory&) = default;
Trajectory::Trajectory(Trajectory&&) noexcept = default;
Trajectory& Trajectory::operator=(Trajectory&&) noexcept = default;

const Trajectory::Held& Trajectory::held(const Spot& spot) const { return held_[spot.held]; }

void Trajectory::start(std::shared_ptr<const Plan> plan, const Context& from,
                       const SimulatorOptions& options) {
  *this = {};
  plan_ = std::move(plan), start_ = from;
  rtol_ = options.rtol, atol_ = options.atol;
  values_ = NodalValues(plan_->nx);
  for (const int i : plan_->order) {
    const Node& of = plan_->node(i);
    if (of.rate == Rate::held && !of.view) held_nodes_.push_back(i);
  }
  first_.begin = first_.end = last_.begin = last_.end = from.time();
}

std::size_t Trajectory::hold(const Machine& machine, const Contacts& contacts) {
  if (!stale_) return held_.size() - 1;
  stale_ = false;
  Held now;
  now.z = machine.z, now.modes = machine.modes;
  std::vector<double> y;
  for (const int i : held_nodes_) {
    const Place& place = plan_->node(i).place;
    y.insert(y.end(), machine.y.data() + place.offset,
             machine.y.data() + place.offset + place.size);
  }
  now.y = Eigen::Map<const Eigen::VectorXd>(y.data(), static_cast<Index>(y.size()));
  std::ranges::copy_if(contacts.all(), std::back_inserter(now.contacts), &SurfaceContact::carried);
  const bool same = !held_.empty() && now.contacts.empty() && held_.back().contacts.empty() &&
                    held_.back().z == now.z && held_.back().y == now.y &&
                    held_.back().modes == now.modes;
  if (!same) held_.push_back(std::move(now));
  return held_.size() - 1;
}

void Trajectory::open(double t, const Machine& machine, const Contacts& contacts) {
  stale_ = true;
  first_ = {
      .held = hold(machine, contacts), .values = values_.put(machine.x), .begin = t, .end = t};
}

void Trajectory::close(double t, const Machine& machine, const Contacts& contacts, bool whole) {
  if (held_.empty()) open(t, machine, contacts);
  if (whole) {
    last_ = {
        .held = hold(machine, contacts), .values = values_.put(machine.x), .begin = t, .end = t};
  } else if (pieces_.empty()) {
    last_ = first_;
  } else {
    const Piece& p = pieces_.back();
    last_ = {
        .held = p.held, .values = values_.place(p.values, p.degree), .begin = p.end, .end = p.end};
  }
}

double* Trajectory::begin_piece(double from, double to, int degree, const Machine& machine,
                                const Contacts& contacts) {
  const std::size_t held = hold(machine, contacts), values = values_.add(degree);
  pieces_.push_back({from, to, values, values, held, degree});
  return values_.at(values);
}

void Trajectory::end_piece(const Eigen::VectorXd& x_end) {
  Piece& piece = pieces_.back();
  std::copy_n(x_end.data(), values_.size(), values_.at(values_.place(piece.values, piece.degree)));
  if (!std::equal(departed_.begin(), departed_.end(), values_.at(piece.values)))
    piece.first = values_.put(departed_);
}

Trajectory Trajectory::of_parts(std::shared_ptr<const Plan> plan, double begin,
                                std::vector<Part> parts) {
  Trajectory all;
  all.plan_ = std::move(plan), all.parts_ = std::move(parts);
  all.first_.begin = begin, all.last_.begin = all.parts_.front().of->end();
  for (const Part& part : all.parts_) all.last_.begin = std::min(all.end(), part.of->end());
  return all;
}

std::size_t Trajectory::memory() const noexcept {
  std::size_t bytes = values_.bytes() + pieces_.size() * sizeof(Piece);
  for (const Part& part : parts_) bytes += part.of->memory();
  return bytes;
}

std::vector<double> Trajectory::joints() const {
  std::vector<double> times;
  for (const Part& part : parts_) {
    const std::vector<double> own = part.of->joints();
    std::ranges::copy_if(own, std::back_inserter(times),
                         [&](double t) { return t >= begin() && t < end(); });
  }
  std::ranges::sort(times);
  times.erase(std::unique(times.begin(), times.end()), times.end());
  for (const Piece& piece : pieces_) times.push_back(piece.begin);
  times.push_back(end());
  return times;
}

void require_kept(const Trajectory& trajectory) {
  if (trajectory.empty())
    throw ModelError("this run kept no dense output; ask for it with the option dense_output");
}

void require_inside(const Trajectory& trajectory, double t) {
  const double begin = trajectory.begin(), end = trajectory.end();
  if (t >= begin && t <= end) return;
  throw ModelError(text("t = ", t, " s is outside the run, which went from ", begin, " s to ", end,
                        " s; dense output does not extrapolate"));
}

Trajectory::Spot Trajectory::spot(double t, Side side) const {
  require_inside(*this, t);
  if (side == Side::right && t == end()) return last_;
  if (side == Side::left && t == begin()) return first_;
  const auto found = side == Side::right
                         ? std::ranges::upper_bound(pieces_, t, {}, &Piece::begin) - 1
                         : std::ranges::lower_bound(pieces_, t, {}, &Piece::end);
  const Piece& p = *found;
  if (t == p.begin) return {p.held, p.first, 0, t, t};
  return {p.held, p.values, p.degree, p.begin, p.end};
}

void Trajectory::state(const Spot& spot, double t, double* x) const {
  const double s = spot.degree == 0 ? 0.0 : (t - spot.begin) / (spot.end - spot.begin);
  values_.polynomial(spot.values, spot.degree, s, x);
}

}  // namespace saltus
