// A long run in pieces.
#include "growth_walk.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/QR>

#include "saltus/analysis/detail/thresholds.hpp"
#include "saltus/base/philox.hpp"

namespace saltus {

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using Mask = Eigen::Array<bool, Eigen::Dynamic, 1>;

constexpr double endless = std::numeric_limits<double>::infinity();

/// Orthonormal directions, the same in each run, none along a state.
MatrixXd generic_frame(Index n, Index directions) {
  MatrixXd random(n, n);
  for (Index i = 0; i < n; ++i)
    for (Index k = 0; k < n; ++k)
      random(i, k) = detail::normal(detail::random_words(1980.0, static_cast<double>(i), k));
  const Eigen::HouseholderQR<MatrixXd> qr(random);
  return qr.householderQ() * MatrixXd::Identity(n, directions);
}

/// One walk along the run.
class Walker {
 public:
  Walker(Pieces& pieces, const Context& start, double time, double longest, Index directions)
      : pieces_(pieces),
        begin_(start.time()),
        time_(time),
        longest_(longest),
        at_(start),
        frame_(generic_frame(static_cast<Index>(pieces.active().size()), directions)),
        lost_(Mask::Constant(directions, false)) {}

  std::optional<Growth> run() {
    double duration = longest_;
    while (left() > last_rest * time_) {
      // two pieces of the same length in place of a long one and a rest
      const double rest =
          left() <= duration ? left() : std::max(0.5 * left(), longest_ * last_rest);
      const auto piece = divided(std::min(duration, rest));
      if (!piece) return {};
      note(*piece);
      const double apart = std::max(apart_of(grown_), least_apart);
      duration = std::min(longest_, piece->duration * std::min(piece_growth, wanted_apart / apart));
      duration = std::max(duration, shortest());
    }
    return growth();
  }

 private:
  double left() const { return begin_ + time_ - at_.time(); }
  double shortest() const { return std::ldexp(longest_, -most_divisions); }

  /// A piece in which the directions do not grow too far apart, with the frame after it. Notes the
  /// directions of which an event leaves nothing.
  std::optional<Piece> divided(double duration) {
    while (true) {
      auto piece = pieces_.run(at_, duration, begin_ + time_);
      if (!piece) return {};
      const MatrixXd turned = orthonormal(piece->matrix * frame_);
      const bool short_enough = piece->rested || duration <= shortest();
      const bool far = apart_of(grown_) > most_apart;
      if (far && !short_enough) {
        duration *= 0.5;
        continue;
      }
      if (far && piece->has_events)
        lost_ =
            lost_ || grown_.array() == -endless || grown_.array() < grown_.maxCoeff() - most_apart;
      frame_ = turned;
      return piece;
    }
  }

  /// Q of the vectors, and ln |r_ii| in `grown_`.
  MatrixXd orthonormal(const MatrixXd& vectors) {
    const Eigen::HouseholderQR<MatrixXd> qr(vectors);
    grown_ = qr.matrixQR().diagonal().head(vectors.cols()).cwiseAbs().array().log();
    return qr.householderQ() * MatrixXd::Identity(vectors.rows(), vectors.cols());
  }

  /// ln of the largest over the smallest growth of the directions that are not lost.
  double apart_of(const VectorXd& grown) const {
    double least = endless, most = -endless;
    for (Index k = 0; k < grown.size(); ++k) {
      if (lost_[k]) continue;
      if (!std::isfinite(grown[k])) return endless;
      least = std::min(least, grown[k]), most = std::max(most, grown[k]);
    }
    return most >= least ? most - least : 0.0;
  }

  void note(const Piece& piece) {
    at_ = piece.end;
    durations_.push_back(piece.duration);
    VectorXd logs = grown_;
    for (Index k = 0; k < logs.size(); ++k)
      if (lost_[k]) logs[k] = -endless;
    logs_.push_back(std::move(logs));
    if (at_.time() <= begin_ + aligned_part * time_) aligned_ = std::ssize(logs_);
  }

  Growth growth() const {
    const auto n = static_cast<Index>(logs_.size());
    Growth all{VectorXd(n), MatrixXd(n, frame_.cols()), aligned_, at_};
    for (Index i = 0; i < n; ++i) {
      all.durations[i] = durations_[static_cast<std::size_t>(i)];
      all.logs.row(i) = logs_[static_cast<std::size_t>(i)];
    }
    return all;
  }

  Pieces& pieces_;
  double begin_, time_, longest_;
  Context at_;
  MatrixXd frame_;
  Mask lost_;
  VectorXd grown_;  // ln |r_ii| of the last piece
  std::vector<double> durations_;
  std::vector<VectorXd> logs_;
  Index aligned_ = 0;
};

}  // namespace

std::optional<Growth> walk(Pieces& pieces, const Context& start, double time, double longest,
                           Index directions) {
  return Walker(pieces, start, time, longest, directions).run();
}

}  // namespace saltus
