// The return to a guard.
#include <algorithm>

#include <Eigen/LU>

#include "closing.hpp"
#include "saltus/analysis/detail/thresholds.hpp"
#include "saltus/base/error.hpp"
#include "saltus/base/list.hpp"

namespace saltus {

namespace {

class SectionClosing final : public Closing {
 public:
  SectionClosing(OrbitRuns& runs, const Context& context, std::string section, int firings,
                 double longest)
      : Closing(runs, context), section_(std::move(section)), firings_(firings), longest_(longest) {
    const EventLog log =
        runs.firings(context, section_, 1 + firings, longest, 2.0 * most_section_delay);
    const std::vector<double> times = log.times(section_);
    const double first = times.front(), last = nth(times, firings);
    double next = last;
    for (std::size_t i = 0; i < log.size(); ++i)
      if (log[i].time > first) next = std::min(next, log[i].time);
    most_ = 0.5 * next - 0.5 * first;
    delay_ = std::min(section_delay * (last - first), most_);
    begin_at(after(context, first));
  }

  Arc arc(const Context& start, const Eigen::VectorXd& /*unknowns*/,
          const std::vector<std::string>& parameters) override {
    const EventLog log = runs().firings(start, section_, firings_, longest_);
    const double guess = nth(log.times(section_), firings_ - 1);
    while (true) {
      const Results results = runs().derived(start, guess + delay_, names_with(parameters));
      const std::vector<double> times = results.events.times(section_);
      if (std::ssize(times) >= firings_) {
        const double tau = nth(times, firings_ - 1);
        const Eigen::VectorXd by = event_derivatives(results, section_).row(firings_ - 1);
        return made(start, results, tau + delay_ - start.time(), tau - guess, by);
      }
      wait_longer(guess);
    }
  }

  /// The values x+ just after the firing, at the end of an arc.
  Context on_orbit(const Arc& arc) override {
    const Results results = runs().dense(arc.begin, arc.final.time());
    const double tau = nth(results.events.times(section_), firings_ - 1);
    return results.context.with_time(tau).with_continuous_state(
        results.at(tau, Side::right).continuous_state);
  }

  /// s = phi(x+, p), so ds = phi_x dx+ + phi_p.
  Eigen::MatrixXd to_orbit(const Context& plus, const std::vector<std::string>& parameters,
                           const Eigen::MatrixXd& by) override {
    const Index n = states().size();
    const std::vector<std::string> names = names_with(parameters);
    const Results results = runs().derived(plus, plus.time() + delay_, names);
    const Eigen::MatrixXd along = derivatives_of(results);
    std::vector<Index> used = active();
    for (Index k = n; k < along.cols(); ++k) used.push_back(k);
    std::vector<std::string> read;
    for (const Index k : used) read.push_back(nth(results.sensitivities.parameters, k));
    refuse_gap(runs().where(), results, read, along(active(), used));
    Eigen::MatrixXd out = Eigen::MatrixXd::Zero(by.rows(), by.cols());
    const Eigen::MatrixXd right = active_rows(by) - active_rows(along).rightCols(along.cols() - n);
    const Eigen::MatrixXd found = square(along).partialPivLu().solve(right);
    out(active(), Eigen::all) = found;
    return out;
  }

 private:
  /// The values a delay after the first firing.
  Context after(const Context& context, double first) {
    while (true) {
      const Results results = runs().plain(context, first + delay_);
      if (!results.events.times(section_).empty()) return results.context;
      wait_longer(first);
    }
  }

  /// A run to just after a firing did not see it: its steps, and their errors, are others.
  void wait_longer(double time) {
    if (delay_ >= most_)
      throw SimulationError(text(runs().where(), ": t = ", time, " s: the time of the section '",
                                 section_, "' differs by more than ", delay_,
                                 " s between two runs; give a smaller rtol and atol"),
                            time);
    delay_ = std::min(10.0 * delay_, most_);
  }

  std::string section_;
  int firings_;
  double longest_, most_ = 0.0, delay_ = 0.0;
};

}  // namespace

std::unique_ptr<Closing> closing_of_section(OrbitRuns& runs, const Context& context,
                                            const std::string& section, int firings,
                                            double longest) {
  return std::make_unique<SectionClosing>(runs, context, section, firings, longest);
}

}  // namespace saltus
