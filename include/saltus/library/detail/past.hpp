// Past: the last part of a signal as polynomials, kept in a discrete state.
#pragma once

#include <algorithm>
#include <limits>

#include "saltus/library/detail/arguments.hpp"

namespace saltus::detail {

/// At an instant the signal may jump, or have a kink. Such a place is a break, with a level: 0 if
/// an event of another block made it, or if the signal jumps there; l + 1 if the delay itself made
/// it when it came to a break of level l. Each level that passes through an integrator is smoother
/// by one derivative, and the breaks of the last level look smooth to every method of order 5. A loop
/// without an integrator makes nothing smoother: there a break of the last level makes another one
/// as long as the signal has a kink.
inline constexpr int last_break_level = 4;
/// The level of a piece that begins without a break.
inline constexpr int no_break = -1;

/// The level of the break with which a step after an instant begins, or -1 if there is none. `echo`
/// is the level that the delay itself made in that instant, or 0.
constexpr int break_level(bool jumped, int echo, bool has_kink) {
  if (jumped) return 0;
  if (echo <= last_break_level) return echo;
  return has_kink ? last_break_level : no_break;
}

/// A number that was read from a state as a whole one from `least` to `most`; `least` for NaN.
constexpr Index whole(double number, Index least, Index most) {
  if (!(number > static_cast<double>(least))) return least;
  return number < static_cast<double>(most) ? static_cast<Index>(number) : most;
}

/// A view of the state that keeps the past of a signal of n entries. Each piece is a polynomial of
/// degree 8, given by its values at the Chebyshev points of the second kind, which include both
/// ends; it is read by the barycentric formula (J.-P. Berrut, L. N. Trefethen, SIAM Review 46
/// (2004) 501, eq. 5.4).
/// A stretch is the pieces from one break to the next. Only one stretch is open, so a reader never
/// sees the signal of the other side of a break, however its time was rounded.
class Past {
 public:
  /// The number of entries of a state for this many pieces.
  static Index size(Index n, Index capacity) { return head + capacity * stride(n); }

  Past(const VectorView& z, Index n)
      : z_(z.data()), n_(n), capacity_((z.size() - head) / stride(n)) {}

  Index capacity() const { return capacity_; }
  Index pieces() const { return count(0, capacity_); }
  bool none_open() const { return open_end() == 0; }
  double begin(Index k) const { return piece(k)[0]; }  ///< [s]
  double end(Index k) const { return piece(k)[1]; }    ///< [s]
  /// [s] The begin of the first stretch that is not open yet; infinite if all are open.
  double next_break() const {
    return open_end() < pieces() ? begin(open_end()) : std::numeric_limits<double>::infinity();
  }
  /// The signal at s in the open stretch; for an s outside of it, the signal at its nearer end.
  void value(double s, VectorRef u) const;

 protected:
  // z = (number of pieces; the first and the end of the open ones; level of the next break; pieces)
  // piece = (begin, end, level, 9 values of n entries)
  static constexpr Index head = 4, points = 9;
  static Index stride(Index n) { return 3 + points * n; }
  Index open_begin() const { return count(1, std::max<Index>(open_end() - 1, 0)); }
  Index open_end() const { return count(2, pieces()); }
  /// A user may have written anything to a context, so no number is used as a place before it is
  /// limited.
  Index count(int entry, Index most) const { return whole(z_[entry], 0, most); }
  int level(Index k) const {
    return static_cast<int>(whole(piece(k)[2], no_break, last_break_level));
  }
  /// The level of the next break.
  int next_level() const { return static_cast<int>(whole(z_[3], 0, last_break_level + 1)); }
  const double* piece(Index k) const { return z_ + head + k * stride(n_); }
  const double* values(Index k) const { return piece(k) + 3; }

  const double* z_;
  Index n_, capacity_;
};

/// Writes a past. Nothing else does.
class PastWriter : public Past {
 public:
  PastWriter(VectorRef z, Index n) : Past({z.data(), z.size()}, n), out_(z.data()) {}

  /// Adds a step. What ended before `oldest` is not read any more. Throws SimulationError for a step
  /// that does not begin where the past ends, and if there is no room; `block` is for the message.
  void append(const AcceptedStep& step, double oldest, const std::string& block);
  /// Opens the next stretch. The next step begins with its echo.
  void open_next();

 private:
  int level_at(const AcceptedStep& step, int echo) const;
  void fit(const AcceptedStep& step, double from, double to, int depth);
  bool follows(const AcceptedStep& step, const double* values, double from, double to) const;
  bool jumps(const AcceptedStep& step) const;
  bool has_kink(const AcceptedStep& step) const;
  void drop(double oldest);
  void require_continues(const AcceptedStep& step, const std::string& block) const;

  double* out_;
  bool full_ = false;
};

}  // namespace saltus::detail
