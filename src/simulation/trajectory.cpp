// Trajectory: keeps steps, and reads states inside them.
#include "saltus/simulation/detail/trajectory.hpp"
#include "saltus/base/list.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <numbers>
#include <utility>

#include "saltus/simulation/detail/contact.hpp"
#include "saltus/tape/series.hpp"

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
  size_ = plan_->nx;
  for (const int i : plan_->order) {
    const Node& of = plan_->node(i);
    if (of.rate == Rate::held && !of.view) held_nodes_.push_back(i);
  }
  first_.begin = first_.end = last_.begin = last_.end = from.time();
}

namespace {

/// The Chebyshev points of the second kind on [0, 1], including both ends, for each degree up to
/// the highest order of a Taylor series.
constexpr int highest_degree = tape::Series::highest_order;
using Nodes = std::array<std::array<double, highest_degree + 1>, highest_degree + 1>;

const Nodes& nodes() {
  static const Nodes all = [] {
    Nodes made{};
    for (int degree = 1; degree <= highest_degree; ++degree) {
      for (int k = 0; k <= degree; ++k) {
        const double s = std::sin(0.5 * std::numbers::pi * k / degree);
        nth(nth(made, degree), k) = k == degree ? 1.0 : s * s;
      }
    }
    return made;
  }();
  return all;
}

}  // namespace

double Trajectory::node(int k, int degree) { return nth(nodes()[degree], k); }

std::size_t Trajectory::put(const Eigen::VectorXd& x) {
  values_.insert(values_.end(), x.begin(), x.end());
  return values_.size() - static_cast<std::size_t>(x.size());
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
  first_ = {.held = hold(machine, contacts), .values = put(machine.x), .begin = t, .end = t};
}

void Trajectory::close(double t, const Machine& machine, const Contacts& contacts, bool whole) {
  if (held_.empty()) open(t, machine, contacts);
  if (whole) {
    last_ = {.held = hold(machine, contacts), .values = put(machine.x), .begin = t, .end = t};
  } else if (pieces_.empty()) {
    last_ = first_;
  } else {
    const Piece& p = pieces_.back();
    const std::size_t last_node = p.values + static_cast<std::size_t>(p.degree * size_);
    last_ = {.held = p.held, .values = last_node, .begin = p.end, .end = p.end};
  }
}

double* Trajectory::begin_piece(double from, double to, int degree, const Machine& machine,
                                const Contacts& contacts) {
  const std::size_t held = hold(machine, contacts), values = values_.size();
  pieces_.push_back({from, to, values, values, held, degree});
  values_.resize(values + static_cast<std::size_t>((degree + 1) * size_));
  return values_.data() + values;
}

void Trajectory::end_piece(const Eigen::VectorXd& x_end) {
  Piece& piece = pieces_.back();
  std::copy_n(x_end.data(), size_,
              values_.data() + piece.values + static_cast<std::size_t>(piece.degree * size_));
  if (!std::equal(departed_.begin(), departed_.end(),
                  values_.begin() + static_cast<std::ptrdiff_t>(piece.values)))
    piece.first = put(departed_);
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
  std::size_t bytes = values_.size() * sizeof(double) + pieces_.size() * sizeof(Piece);
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

void Trajectory::require_kept() const {
  if (empty())
    throw ModelError("this run kept no dense output; ask for it with the option dense_output");
}

void Trajectory::require_inside(double t) const {
  if (t >= begin() && t <= end()) return;
  throw ModelError(text("t = ", t, " s is outside the run, which went from ", begin(), " s to ",
                        end(), " s; dense output does not extrapolate"));
}

Trajectory::Spot Trajectory::spot(double t, Side side) const {
  require_inside(t);
  if (side == Side::right && t == end()) return last_;
  if (side == Side::left && t == begin()) return first_;
  const auto found = side == Side::right
                         ? std::ranges::upper_bound(pieces_, t, {}, &Piece::begin) - 1
                         : std::ranges::lower_bound(pieces_, t, {}, &Piece::end);
  const Piece& p = *found;
  if (t == p.begin) return {p.held, p.first, 0, t, t};
  return {p.held, p.values, p.degree, p.begin, p.end};
}

/// The second barycentric form, applied to differences from the first value: a constant state is
/// constant to the last bit.
void Trajectory::state(const Spot& spot, double t, double* x) const {
  using Row = Eigen::Map<const Eigen::VectorXd>;
  const auto value = [&](int k) { return Row(values_.data() + spot.values + k * size_, size_); };
  Eigen::Map<Eigen::VectorXd> out(x, size_);
  const double s = spot.degree == 0 ? 0.0 : (t - spot.begin) / (spot.end - spot.begin);
  const int d = spot.degree;
  for (int k = 0; k <= d; ++k) {
    if (s != node(k, d)) continue;
    out = value(k);
    return;
  }
  out.setZero();
  double weights = 0.0;
  for (int k = 0; k <= d; ++k) {
    const double end = k == 0 || k == d ? 0.5 : 1.0;
    const double weight = (k % 2 == 0 ? end : -end) / (s - node(k, d));
    weights += weight;
    if (k > 0) out += weight * (value(k) - value(0));
  }
  out = value(0) + out / weights;
}

}  // namespace saltus
