// Searches of a fit, from one start after the other.
#include "fit_search.hpp"

#include <algorithm>
#include <limits>

#include "fit_loss.hpp"
#include "saltus/analysis/detail/least_squares.hpp"
#include "saltus/base/error.hpp"
#include "saltus/base/list.hpp"

namespace saltus {

namespace {

using Eigen::VectorXd;

/// Searches from one start after the other.
class FitSearch {
 public:
  FitSearch(FitProblem& problem, const FitOptions& options) : problem_(problem), options_(options) {
    problem.seen = [this] { seen(); };
  }
  ~FitSearch() {
    problem_.seen = [] {};
  }
  FitSearch(const FitSearch&) = delete;
  FitSearch& operator=(const FitSearch&) = delete;

  /// The best of all starts, a converged one if there is any.
  FitEnded run(const std::vector<VectorXd>& starts) {
    count_ = static_cast<int>(starts.size());
    try {
      for (const VectorXd& u : starts) from(u);
    } catch (const FitStopped& stopped) {
      if (!problem_.best) throw_failed_fit(stopped.what());
      return {*problem_.best,
              0.5 * problem_.best->residuals.squaredNorm(),
              SearchStatus::interrupted,
              stopped.what(),
              ended_,
              0.0};
    }
    const Found* best = nullptr;
    for (const Found& found : found_)
      if (!best || rank(found) < rank(*best)) best = &found;
    if (!best) throw_failed_fit({});
    return {best->point, best->start.cost, best->start.status, best->start.message, ended_, 0.0};
  }

 private:
  struct Found {
    FitStart start;
    FitPoint point;
  };
  static std::pair<bool, double> rank(const Found& found) {
    return {found.start.status != SearchStatus::converged, found.start.cost};
  }

  void seen() {
    if (options_.progress) options_.progress(progress());
    if (options_.simulation.interrupt && options_.simulation.interrupt())
      throw FitStopped("the option interrupt has ended the fit");
  }

  FitProgress progress() const {
    const bool any = problem_.best.has_value();
    return {problem_.record.evaluations,
            any ? problem_.best->residuals.squaredNorm() : std::numeric_limits<double>::infinity(),
            any ? problem_.coordinates.named(problem_.best->u) : std::vector<NamedValue>(),
            problem_.record.failures,
            std::min(static_cast<int>(ended_.size()), count_ - 1),
            count_};
  }

  void from(const VectorXd& u) {
    const int before = problem_.record.evaluations;
    FitStart start{.start = problem_.coordinates.named(u), .parameters = {}, .message = {}};
    if (!problem_.at(u)) {
      start.parameters = start.start;
      start.cost = std::numeric_limits<double>::infinity();
      start.status = SearchStatus::failed, start.message = problem_.failed->what();
    } else {
      const detail::LeastSquaresFound found = minimised(u);
      const FitPoint point = *problem_.at(back(found.x, u));
      start.parameters = problem_.coordinates.named(point.u);
      start.cost = found.cost;
      judge(start, found, point);
      found_.push_back({start, point});
    }
    start.evaluations = problem_.record.evaluations - before;
    if (!found_.empty()) found_.back().start.evaluations = start.evaluations;
    ended_.push_back(std::move(start));
  }

  /// The parameters of the search have sizes near 1 at its start.
  VectorXd back(const VectorXd& w, const VectorXd& start) const {
    const Coordinates& of = problem_.coordinates;
    return w.cwiseProduct(of.scale(start)).cwiseMax(of.lower).cwiseMin(of.upper);
  }

  detail::LeastSquaresFound minimised(const VectorXd& u) {
    const Coordinates& of = problem_.coordinates;
    const VectorXd scale = of.scale(u);
    detail::LeastSquares squares;
    squares.cost = [&](const VectorXd& w) -> std::optional<double> {
      const FitPoint* point = problem_.at(back(w, u));
      if (!point) return {};
      return cost_of(point->residuals, options_.loss, options_.f_scale);
    };
    squares.linear = [&](const VectorXd& w, VectorXd& residual, Eigen::MatrixXd& jacobian) {
      const FitPoint& point = *problem_.at(back(w, u));
      residual = point.residuals, jacobian = point.jacobian * scale.asDiagonal();
      weigh(residual, jacobian, options_.loss, options_.f_scale);
    };
    const int most = options_.max_nfev.value_or(100 * static_cast<int>(u.size()));
    return detail::least_squares(
        squares, u.cwiseQuotient(scale), of.lower.cwiseQuotient(scale),
        of.upper.cwiseQuotient(scale),
        {.cost = options_.ftol, .step = options_.xtol, .evaluations = most});
  }

  void judge(FitStart& start, const detail::LeastSquaresFound& found, const FitPoint& point) {
    using detail::LeastSquaresEnd;
    if (found.end == LeastSquaresEnd::evaluations) {
      start.status = SearchStatus::max_nfev;
      start.message =
          text(found.evaluations, " evaluations were not enough; give max_nfev, or starts");
    } else if (found.end == LeastSquaresEnd::step && problem_.meets_jump(point)) {
      start.status = SearchStatus::stalled;
      start.message =
          "no shorter step lowers the cost, and its gradient is not zero: the cost jumps there, as "
          "where a sequence of events changes, or runs fail; give starts, or other data";
    } else {
      constexpr std::string_view why[] = {"the gradient is zero", "ftol: the cost changes no more",
                                          "xtol: the parameters change no more"};
      start.message = nth(why, found.end);
    }
  }

  [[noreturn]] void throw_failed_fit(const std::string& stopped) const {
    const auto& failed = problem_.failed;
    const auto results = failed ? failed->results : nullptr;
    const std::string what = !stopped.empty()
                                 ? stopped
                                 : text("the run with ",
                                        count_ == 1 ? std::string("the start values")
                                                    : text("each of ", count_, " starts"),
                                        " failed: ", problem_.record.first_failure,
                                        "; give other start values or bounds");
    SimulationError error(
        "fit: " + what,
        results ? results->context.time() : std::numeric_limits<double>::quiet_NaN(),
        results ? results->block : std::string());
    error.attach(results);
    throw error;
  }

  FitProblem& problem_;
  const FitOptions& options_;
  std::vector<Found> found_;
  std::vector<FitStart> ended_;
  int count_ = 1;
};

}  // namespace

FitEnded search_fit(FitProblem& problem, const std::vector<VectorXd>& starts,
                    const FitOptions& options) {
  return FitSearch(problem, options).run(starts);
}

}  // namespace saltus
