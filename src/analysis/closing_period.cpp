// The return after a period, which is given or an unknown.
#include <algorithm>
#include <cmath>

#include <Eigen/LU>

#include "closing.hpp"
#include "places.hpp"
#include "saltus/analysis/detail/thresholds.hpp"
#include "saltus/base/error.hpp"
#include "saltus/base/list.hpp"

namespace saltus {

namespace {

/// The context with a parameter that is larger by this part of its value (of 1 if it is 0).
Context moved_parameter(const Context& context, const std::string& name, double part) {
  const ContextEntry entry = find_entry(context.layout(), name);
  const double value = value_in(context, entry);
  return with_number(context, entry, value + part * (value != 0.0 ? std::abs(value) : 1.0), name);
}

class FixedPeriodClosing final : public Closing {
 public:
  FixedPeriodClosing(OrbitRuns& runs, const Context& context, double period)
      : Closing(runs, runs.plain(context, context.time()).context), period_(period) {}

  bool autonomous() const override { return false; }

  Arc arc(const Context& start, const Eigen::VectorXd& /*unknowns*/,
          const std::vector<std::string>& parameters) override {
    const Results results = runs().derived(start, start.time() + period_, names_with(parameters));
    return made(start, results, period_, 0.0, {});
  }

  /// The same start one period later.
  Arc again(const Arc& arc) override {
    return this->arc(states().put(arc.final, arc.start), unknowns(), {});
  }

  std::pair<Eigen::MatrixXd, Eigen::VectorXd> implicit(
      const Arc& arc, const std::vector<std::string>& parameters) override {
    for (const std::string& name : parameters) require_same_drive(arc, name);
    return Closing::implicit(arc, parameters);
  }

 private:
  Eigen::VectorXd end_of(const Context& from, const Arc& arc, const std::string& name) {
    const Context start = states().put(moved_parameter(from, name, drive_part), arc.start);
    return RunStates::of(runs().plain(start, start.time() + period_).context);
  }

  /// Two periods from one start must have one end, also beside the value of the parameter.
  void require_same_drive(const Arc& arc, const std::string& name) {
    const Eigen::VectorXd change =
        (end_of(arc.final, arc, name) - end_of(arc.begin, arc, name)).cwiseAbs()(active());
    if ((change.array() <= same_run * growth(arc) * scale(arc).array()).all()) return;
    throw ModelError(text(runs().where(), ": '", name,
                          "' changes the period of the drive, so beside its value there is no "
                          "orbit of period ",
                          period_,
                          " s; expected a parameter that does not: take the difference of two "
                          "orbits, each with its own period"));
  }

  double period_;
};

class FreePeriodClosing final : public Closing {
 public:
  FreePeriodClosing(OrbitRuns& runs, const Context& context, double guess)
      : Closing(runs, context), guess_(guess) {}

  Eigen::VectorXd unknowns() const override { return with(Closing::unknowns(), guess_); }

  Arc arc(const Context& start, const Eigen::VectorXd& unknowns,
          const std::vector<std::string>& parameters) override {
    const double period = unknowns[unknowns.size() - 1];
    if (!(guess_ / period_range < period && period < guess_ * period_range))
      throw SimulationError(text(runs().where(), ": the period went from the first guess of ",
                                 guess_, " s to ", period, " s"),
                            start.time());
    const Results results = runs().derived(start, start.time() + period, names_with(parameters));
    return made(start, results, period, 0.0, {});
  }

  Eigen::VectorXd residual(const Arc& arc) const override {
    return with(Closing::residual(arc), 0.0);
  }

  Eigen::MatrixXd matrix(const Arc& arc) const override {
    const auto m = static_cast<Index>(active().size());
    Eigen::MatrixXd bordered = Eigen::MatrixXd::Zero(m + 1, m + 1);
    bordered.topLeftCorner(m, m) = Closing::matrix(arc);
    bordered.col(m).head(m) = arc.flow_end(active());
    bordered.row(m).head(m) = phase(arc).transpose();
    return bordered;
  }

  Eigen::VectorXd scale(const Arc& arc) const override {
    return with(Closing::scale(arc), arc.period);
  }

  std::pair<Eigen::MatrixXd, Eigen::VectorXd> implicit(
      const Arc& arc, const std::vector<std::string>& /*parameters*/) override {
    const auto m = static_cast<Index>(active().size());
    Eigen::MatrixXd right = Eigen::MatrixXd::Zero(m + 1, arc.by_parameters.cols());
    right.topRows(m) = -active_rows(arc.by_parameters);
    const Eigen::MatrixXd by = matrix(arc).partialPivLu().solve(right);
    Eigen::MatrixXd start = Eigen::MatrixXd::Zero(states().size(), by.cols());
    start(active(), Eigen::all) = by.topRows(m);
    return {start, by.row(m).transpose()};
  }

  void move_to_end(const Arc& arc) override {
    Closing::move_to_end(arc);
    guess_ = arc.period;
  }

 private:
  static Eigen::VectorXd with(const Eigen::VectorXd& values, double last) {
    Eigen::VectorXd all(values.size() + 1);
    all << values, last;
    return all;
  }

  /// The phase condition in units of the sizes, so that no state decides by its unit alone.
  Eigen::VectorXd phase(const Arc& arc) const {
    Eigen::VectorXd phase = arc.flow_start(active());
    const Eigen::VectorXd size = sizes(arc)(active());
    for (Index i = 0; i < phase.size(); ++i)
      phase[i] = size[i] > 0.0 ? phase[i] / (size[i] * size[i]) : 0.0;
    const double norm = phase.norm();
    return norm > 0.0 ? Eigen::VectorXd(phase / norm) : phase;
  }

  double guess_;
};

/// The first time at which the state crosses the plane through its begin across the flow, in the
/// direction of the flow and near the begin; empty if it does not.
std::optional<double> first_return(const Eigen::VectorXd& flow, const Eigen::VectorXd& times,
                                   const Eigen::MatrixXd& states) {
  const Eigen::VectorXd size = states.rowwise().maxCoeff() - states.rowwise().minCoeff();
  const Eigen::VectorXd largest = states.cwiseAbs().rowwise().maxCoeff();
  std::vector<Index> used;
  for (Index i = 0; i < size.size(); ++i)
    if (size[i] > 1e-12 * largest[i] && size[i] > 0.0) used.push_back(i);
  const Eigen::VectorXd unit = size(used), along = flow(used);
  if (used.empty() || along.isZero(0.0)) return {};
  Eigen::MatrixXd way = states(used, Eigen::all);
  way.colwise() -= Eigen::VectorXd(way.col(0));
  way = unit.cwiseInverse().asDiagonal() * way;
  const Eigen::VectorXd height = way.transpose() * along.cwiseQuotient(unit);
  const Eigen::VectorXd apart = way.colwise().norm();
  bool left = false;  // a look was away from the begin
  for (Index i = 0; i + 1 < times.size(); ++i) {
    left = left || apart[i] > return_near;
    if (!left || !(height[i] < 0.0 && height[i + 1] >= 0.0 && apart[i + 1] < return_near)) continue;
    const double part = height[i] / (height[i] - height[i + 1]);
    return times[i] + part * (times[i + 1] - times[i]) - times[0];
  }
  return {};
}

}  // namespace

std::unique_ptr<Closing> closing_of_period(OrbitRuns& runs, const Context& context, double period) {
  return std::make_unique<FixedPeriodClosing>(runs, context, period);
}

std::unique_ptr<Closing> closing_of_free_period(OrbitRuns& runs, const Context& context,
                                                double guess) {
  return std::make_unique<FreePeriodClosing>(runs, context, guess);
}

// Each span is looked at for a return. The next one begins at the end of this one and is longer, so
// that a transient dies out.
std::pair<Context, double> guess_period(OrbitRuns& runs, const Context& context, double longest) {
  Context at = context;
  const double begin = context.time();
  double span = first_return_look * longest;
  while (true) {
    span = std::min(span, begin + longest - at.time());
    const Results results = runs.dense(at, at.time() + span);
    const Eigen::VectorXd times =
        Eigen::VectorXd::LinSpaced(return_looks, at.time(), at.time() + span);
    DenseOutput dense(results.trajectory);
    Eigen::MatrixXd states(at.continuous_state().size(), times.size());
    for (Index i = 0; i < times.size(); ++i) {
      dense.move_to(std::min(times[i], results.context.time()));
      states.col(i) = dense.state();
    }
    const auto found = first_return(runs.flow(at).head(states.rows()), times, states);
    if (found) return {at, *found};
    at = results.context;
    if (at.time() >= begin + longest * (1.0 - 1e-9)) break;
    span *= return_growth;
  }
  throw SimulationError(
      text(
          runs.where(), ": t = ", at.time(),
          " s: the state came close to none of those that it had before; expected a return within ",
          longest,
          " s: give a larger max_period, a start nearer to the orbit, a section, or the period of "
          "a driven system"),
      at.time());
}

}  // namespace saltus
