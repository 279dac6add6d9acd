// Past: reading, and appending a step.
#include "saltus/library/detail/past.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace saltus::detail {

namespace {

constexpr int degree = 8;
constexpr double eps = std::numeric_limits<double>::epsilon();
/// A step that jumps inside, where no guard shows it, is halved this often.
constexpr int deepest = 20;
/// The polynomial adds a tenth of the error that the tolerance allows the solver.
constexpr double share = 0.1;
/// [of the last piece] How far its polynomial is continued to see a kink. There its own error has
/// grown by T8(1.1) = 17 at most, to twice the tolerance, so a kink of four tolerances is one.
constexpr double beyond = 0.05, kink_room = 4.0;

/// Chebyshev points of the second kind on [0, 1], in ascending order.
const std::array<double, degree + 1>& nodes() {
  static const auto all = [] {
    std::array<double, degree + 1> made{};
    for (int j = 0; j <= degree; ++j) {
      const double s = std::sin(0.5 * std::numbers::pi * j / degree);
      nth(made, j) = s * s;
    }
    return made;
  }();
  return all;
}

/// The place in [0, 1] of time s in a piece.
double place(double s, double begin, double end) {
  return std::clamp((s - begin) / (end - begin), 0.0, 1.0);
}

/// The polynomial with these values at the nodes, n entries each, at a place in [0, 1].
void interpolate(const double* values, double at, VectorRef u) {
  const Index n = u.size();
  u.setZero();
  double sum = 0.0;
  for (int j = 0; j <= degree; ++j) {
    const VectorView value(values + j * n, n);
    const double off = at - nth(nodes(), j);
    if (off == 0.0) {
      u = value;
      return;
    }
    const double half = j == 0 || j == degree ? 0.5 : 1.0;
    const double weight = (j % 2 == 0 ? half : -half) / off;
    u += weight * value;
    sum += weight;
  }
  u /= sum;
}

/// The part of the tolerance for a value of this size; never below the rounding of nine terms.
double allowed(const AcceptedStep& step, double size) {
  return std::max(share * (step.atol + step.rtol * size), 64.0 * eps * size);
}

std::span<double> span_of(Eigen::VectorXd& u) {
  return {u.data(), static_cast<std::size_t>(u.size())};
}

}  // namespace

void Past::value(double s, VectorRef u) const {
  Index low = open_begin(), high = open_end() - 1;
  while (low < high) {
    const Index middle = (low + high + 1) / 2;
    if (begin(middle) <= s)
      low = middle;
    else
      high = middle - 1;
  }
  interpolate(values(low), place(s, begin(low), end(low)), u);
}

void PastWriter::append(const AcceptedStep& step, double oldest, const std::string& block) {
  require_continues(step, block);
  const Index before = pieces();
  const bool all_open = before > 0 && open_end() == before;
  if (2 * before > capacity()) drop(oldest);  // so that half of the room is free, if possible
  const Index kept = pieces();
  const int level = before == 0 ? 0 : level_at(step, next_level());
  out_[3] = 0.0;
  fit(step, step.from, step.to, 0);
  if (full_) {
    out_[0] = static_cast<double>(kept);
    throw SimulationError(
        text("t = ", step.from, " s: block '", block, "' keeps ", capacity(),
             " pieces of its input, and needs more within its delay: the steps here are short "
             "against the delay. Raise its capacity"),
        step.from, block);
  }
  out_[head + kept * stride(n_) + 2] = level;
  if (all_open && level < 0) out_[2] = z_[0];
}

/// Adds the polynomial of a part of a step, or of its halves, if there is room.
void PastWriter::fit(const AcceptedStep& step, double from, double to, int depth) {
  const Index k = pieces();
  full_ = full_ || k == capacity();
  if (full_) return;
  double* piece = out_ + head + k * stride(n_);
  for (int j = 0; j <= degree; ++j) {
    const double t = j == degree ? to : from + (to - from) * nth(nodes(), j);
    step.input(t, {piece + 3 + j * n_, static_cast<std::size_t>(n_)});
  }
  const double middle = from + 0.5 * (to - from);
  const bool can_halve = depth < deepest && from < middle && middle < to;
  if (can_halve && !follows(step, piece + 3, from, to)) {
    fit(step, from, middle, depth + 1);
    fit(step, middle, to, depth + 1);
    return;
  }
  piece[0] = from, piece[1] = to, piece[2] = no_break;
  out_[0] = static_cast<double>(k + 1);
}

/// Whether the polynomial has the values of the input between its points: at two places that no
/// symmetry of the signal about the middle relates.
bool PastWriter::follows(const AcceptedStep& step, const double* values, double from,
                         double to) const {
  Eigen::VectorXd is(n_), has(n_);
  const VectorView all(values, points * n_);
  // The times of the looks are rounded, which changes the values by the slope of the signal times
  // the rounding.
  const double steepest = (all.maxCoeff() - all.minCoeff()) * degree / (to - from);
  const double room =
      allowed(step, all.cwiseAbs().maxCoeff()) + 2.0 * eps * std::abs(to) * steepest;
  for (const double at : {0.0795, 0.573}) {
    const double t = from + (to - from) * at;
    step.input(t, span_of(is));
    interpolate(values, place(t, from, to), VectorRef(has.data(), n_));
    if ((is - has).cwiseAbs().maxCoeff() > room) return false;
  }
  return true;
}

/// Whether the signal at the begin of the step differs from the end of the past by more than the
/// solver's own error.
bool PastWriter::jumps(const AcceptedStep& step) const {
  Eigen::VectorXd now(n_);
  step.input(step.from, span_of(now));
  const VectorView was(values(pieces() - 1) + degree * n_, n_);
  const double size = std::max(was.cwiseAbs().maxCoeff(), now.cwiseAbs().maxCoeff());
  return (now - was).cwiseAbs().maxCoeff() > allowed(step, size) / share;
}

/// Whether the signal leaves the polynomial of the end of the past, continued into the step.
bool PastWriter::has_kink(const AcceptedStep& step) const {
  const Index last = pieces() - 1;
  const double length = end(last) - begin(last);
  const double ahead = std::min(beyond * length, step.to - step.from);
  Eigen::VectorXd now(n_), then(n_);
  step.input(step.from + ahead, span_of(now));
  interpolate(values(last), 1.0 + ahead / length, VectorRef(then.data(), n_));
  const double size = VectorView(values(last), points * n_).cwiseAbs().maxCoeff();
  return (now - then).cwiseAbs().maxCoeff() > kink_room * allowed(step, size) / share;
}

int PastWriter::level_at(const AcceptedStep& step, int echo) const {
  if (!step.after_instant) {  // an instant may have ended the run before
    return step.continues && (jumps(step) || has_kink(step)) ? 0 : no_break;
  }
  const bool jumped = jumps(step);
  const bool kink = !jumped && echo > last_break_level && has_kink(step);
  return break_level(jumped, echo, kink);
}

void PastWriter::open_next() {
  const Index first = open_end();
  if (first == pieces()) return;
  Index end = first + 1;
  while (end < pieces() && level(end) < 0) ++end;
  out_[1] = static_cast<double>(first), out_[2] = static_cast<double>(end);
  out_[3] = level(first) + 1;
}

/// Removes the pieces that no reader needs any more.
void PastWriter::drop(double oldest) {
  Index first = open_begin();
  while (first + 1 < open_end() && end(first) < oldest) ++first;
  const Index kept = pieces() - first, open = open_end() - first;
  const double* from = piece(first);
  std::copy(from, from + kept * stride(n_), out_ + head);
  out_[0] = static_cast<double>(kept), out_[1] = 0.0, out_[2] = static_cast<double>(open);
}

void PastWriter::require_continues(const AcceptedStep& step, const std::string& block) const {
  if (pieces() == 0) return;
  const double last = end(pieces() - 1);
  if (std::abs(step.from - last) <= 4.0 * eps * std::abs(last)) return;
  throw SimulationError(text("t = ", step.from, " s: the past of block '", block,
                             "' ends at t = ", last, " s, so a run from t = ", step.from,
                             " s has no input in between; continue from t = ", last,
                             " s, or begin with a new context, whose past is empty"),
                        step.from, block);
}

}  // namespace saltus::detail
