// Newton's method for a periodic orbit.
#include "orbit_newton.hpp"

#include <cmath>
#include <exception>

#include <Eigen/SVD>

#include "saltus/analysis/detail/thresholds.hpp"
#include "saltus/base/error.hpp"

namespace saltus {

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// One search.
class OrbitNewton {
 public:
  OrbitNewton(Closing& closing, double tolerance) : closing_(closing), tolerance_(tolerance) {}

  OrbitFound run(int most) {
    OrbitFound found{first_arc()};
    VectorXd unknowns = closing_.unknowns();
    for (; found.iterations < most; ++found.iterations) {
      const VectorXd step = solved(found.arc, closing_.residual(found.arc));
      const double size = size_of(found.arc, step);
      if (size <= tolerance_) return polished(std::move(found), unknowns + step);
      const double part = damped(found.arc, unknowns, step);
      if (part == 0.0) return unhelped(std::move(found), size);
      unknowns += part * step;
      found.arc = std::move(*better_);
    }
    const double size = size_of(found.arc, solved(found.arc, closing_.residual(found.arc)));
    if (size <= tolerance_) return found;
    found.status = SearchStatus::max_iterations;
    found.message =
        text("after ", most, " steps the next one has ", size, " of the size of the states");
    return found;
  }

 private:
  /// The first arc from which modes and labels return.
  Arc first_arc() {
    std::string reason;
    for (int i = 0; i < most_first_returns; ++i) {
      Arc arc = closing_.at(closing_.unknowns());
      closing_.take_labels(arc);
      reason = arc.unreturned(closing_.states(), closing_.labels());
      if (reason.empty()) return arc;
      closing_.move_to_end(arc);
    }
    const double time = closing_.base().time();
    throw SimulationError(
        text(closing_.runs().where(), ": t = ", time, " s: ", reason, ", in each of ",
             most_first_returns,
             " returns; expected that all modes and discrete states return: reset what counts, or "
             "choose more firings or a longer period"),
        time);
  }

  VectorXd sizes(const Arc& arc) const {
    const VectorXd sizes = closing_.scale(arc);
    return (sizes.array() > 0.0).select(sizes, 1.0);
  }

  /// The Newton step; the shortest one, in units of the sizes, where the matrix is singular.
  VectorXd solved(const Arc& arc, const VectorXd& residual) const {
    const VectorXd unit = sizes(arc);
    const MatrixXd scaled = closing_.matrix(arc) * unit.asDiagonal();
    if (scaled.size() == 0) return VectorXd::Zero(unit.size());
    Eigen::JacobiSVD<MatrixXd> svd(scaled, Eigen::ComputeThinU | Eigen::ComputeThinV);
    svd.setThreshold(newton_singular);
    return unit.cwiseProduct(VectorXd(svd.solve(-residual)));
  }

  double size_of(const Arc& arc, const VectorXd& step) const {
    return step.size() == 0 ? 0.0 : step.cwiseQuotient(sizes(arc)).cwiseAbs().maxCoeff();
  }

  double distance(const Arc& arc) const {
    const VectorXd residual = closing_.residual(arc);
    return residual.size() == 0 ? 0.0 : residual.cwiseAbs().maxCoeff();
  }

  /// One more full step if it brings the return closer: it costs little, and squares the error.
  OrbitFound polished(OrbitFound found, const VectorXd& unknowns) {
    if (tried(unknowns) && distance(*better_) < distance(found.arc))
      found.arc = std::move(*better_), ++found.iterations;
    return found;
  }

  OrbitFound unhelped(OrbitFound found, double size) const {
    if (size <= newton_noise * tolerance_) {
      found.message =
          text("the Newton step stays at ", size, " of the states: the error of the runs");
      return found;
    }
    found.status = SearchStatus::stalled, found.message = message_;
    return found;
  }

  /// The largest part of the step that helps, whose arc is then in `better_`; 0 if there is none.
  double damped(const Arc& arc, const VectorXd& unknowns, const VectorXd& step) {
    const double size = size_of(arc, step);
    for (double part = 1.0; part >= least_newton_part; part *= 0.5) {
      if (!tried(unknowns + part * step)) continue;
      const VectorXd next = solved(arc, closing_.residual(*better_));
      if (size_of(arc, next) <= (1.0 - 0.25 * part) * size) return part;
      message_ = "no part of the Newton step brings the return closer to the start";
    }
    return 0.0;
  }

  /// Whether there is an arc from the unknowns, in `better_`; otherwise `message_` says why. Outside
  /// of the domain a function may throw whatever it likes.
  bool tried(const VectorXd& unknowns) {
    better_.reset();
    try {
      better_ = closing_.at(unknowns);
    } catch (const Interruption&) {
      throw;
    } catch (const SimulationError& error) {
      if (error.results() && error.results()->status == Status::interrupted) throw;
      message_ = error.what();
      return false;
    } catch (const std::exception& error) {
      message_ = error.what();
      return false;
    }
    const std::string reason = better_->unreturned(closing_.states(), closing_.labels());
    if (!reason.empty()) message_ = reason, better_.reset();
    return better_.has_value();
  }

  Closing& closing_;
  double tolerance_;
  std::optional<Arc> better_;
  std::string message_;
};

}  // namespace

OrbitFound search_orbit(Closing& closing, double tolerance, int most) {
  return OrbitNewton(closing, tolerance).run(most);
}

}  // namespace saltus
