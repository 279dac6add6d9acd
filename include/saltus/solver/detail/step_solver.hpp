// The common part of all methods: the method takes a whole step, then the step is delivered up to
// the first root in it.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "saltus/solver/detail/locate.hpp"
#include "saltus/solver/detail/solver.hpp"
#include "saltus/solver/detail/tangent_step.hpp"

namespace saltus {

/// A method derives from this class and provides four functions:
///   begin(start)       start at (t1_, x1_)
///   undo()             restore t1_ and x1_ after a step that threw, or whose guards threw
///   step(t_stop)       go from t1_ to a new t1_ <= t_stop; set x1_ to the state there and length_
///                      to the size of the step
///   inside_step(u, x)  the state at offset u from the beginning of the step, 0 <= u <= length_
/// This class does everything else, including roots. After a root that changes nothing continuous,
/// the rest of the same step is delivered, so the trajectory is the same as without the root.
///
/// A method whose steps have a higher order than its dense output also provides
///   cut(root)          take the step again from t0_ to just beyond the offset `root`, and set t1_,
///                      x1_ and length_; false if it stays as it is
/// The root is then located in the shorter step, near its end, where the state is as good as there.
template <class Method>
concept CutsSteps = requires(Method method) { method.cut(1.0); };

template <class Method, class Interface = Solver>
class StepSolver : public Interface {
 public:
  StepSolver(Machine& machine, GuardSet& guards, const SolverOptions& options)
      : machine_(&machine),
        guards_(&guards),
        options_(options),
        n_(machine.plan().nx),
        x1_(n_),
        locator_(machine, guards),
        state_(n_),
        next_state_(n_) {}

  void restart(double t, const Eigen::VectorXd& x, const Start& start) final {
    if (start.first)
      statistics_ = {};
    else if (!start.handover)
      ++statistics_.restarts;
    if (start.first) run_begun_ = t;
    t0_ = t1_ = time_ = t;
    x1_ = x;
    delivered_ = true;
    tangent_.leave();
    start.first ? locator_.begin_run() : locator_.forget();
    self().begin(start);
  }

  StopReason advance(double t_stop) final {
    guards_->monitors.clear();
    if (delivered_) take_step(t_stop);
    from_ = offset_;
    try {
      return deliver(t_stop);
    } catch (...) {
      take_back();
      throw;
    }
  }

  double look_ahead(double t_stop) final {
    locator_.keep();
    if constexpr (CutsSteps<Method>) return -std::numeric_limits<double>::infinity();
    if (delivered_) take_step(t_stop);
    from_ = offset_;
    return t1_;
  }

  StopReason recall(double t) final {
    go_back();
    try {
      return deliver_part(t - t0_, t);
    } catch (...) {
      take_back();
      throw;
    }
  }

  double end_of_step() const final { return t1_; }
  void go_back() final {
    guards_->monitors.clear();
    locator_.restore();
    if (from_ > 0.0) read_root(from_);
    offset_ = from_;
    delivered_ = false, time_ = t0_ + offset_;
  }

  void interpolate(double t, double* x) final {
    if (t >= t1_)
      std::copy_n(x1_.data(), n_, x);
    else
      inside(t - t0_, x);
  }

  bool finish_step(double t_stop) final {
    if (delivered_ || tangent_ || t1_ != t_stop) return false;
    machine_->guards(t1_, x1_.data(), guards_->g.data());
    delivered_ = true;
    time_ = t1_;
    locator_.pass_to_stop();
    return true;
  }

  const SolverStatistics& statistics() const override { return statistics_; }
  /// The method, without what `method` adds for the statistics.
  virtual std::string name() const { return this->method(); }
  std::vector<Stretch> stretches() const final {
    return {{name(), run_begun_, time_, this->statistics().steps}};
  }
  bool at_step_end() const final { return delivered_; }
  double time() const final { return time_; }
  const Eigen::VectorXd& state() const final { return delivered_ ? x1_ : state_; }

  // --- one step without guards, for a method that starts with the steps of another
  void begin_at(double t, const Eigen::VectorXd& x, const Start& start) {
    t0_ = t1_ = t, x1_ = x;
    self().begin(start);
  }
  void bare_step(double t_stop) {
    t0_ = t1_;
    self().step(t_stop);
  }
  double step_end() const noexcept { return t1_; }
  double step_length() const noexcept { return length_; }
  const Eigen::VectorXd& step_state() const noexcept { return x1_; }

 protected:
  const double* end_guards() const { return nullptr; }
  /// Whether the last step is none of the method's, but one along the tangent.
  bool is_tangent() const noexcept { return static_cast<bool>(tangent_); }
  /// The number of evenly spaced looks inside a step.
  int even_looks() { return self().degree(); }
  /// See LookPoints; null: the method knows its guards by their values only.
  LookPoints* look_points() { return nullptr; }

  Machine* machine_;
  GuardSet* guards_;
  SolverOptions options_;
  Index n_;
  double t0_ = 0.0, t1_ = 0.0, length_ = 0.0;  // [s] of the last step
  Eigen::VectorXd x1_;
  SolverStatistics statistics_;

 private:
  Method& self() { return static_cast<Method&>(*this); }

  /// The state at offset u from the beginning of the step.
  void inside(double u, double* x) { tangent_ ? tangent_.inside(u, x) : self().inside_step(u, x); }

  /// Delivers the step to its first root, or to its end.
  StopReason deliver(double t_stop) {
    const auto look = [this](double u, double* x) { inside(u, x); };
    if (!guards_->active().all.empty() && find_root(look)) {
      const double root = locator_.offset();
      if (root < length_) read_root(root);
      offset_ = root;
      delivered_ = root >= length_;
      time_ = delivered_ ? t1_ : t0_ + root;
      if (delivered_ && t1_ >= t_stop) locator_.pass_to_stop();
      return StopReason::root;
    }
    if (tangent_) tangent_.give_up();
    delivered_ = true;
    time_ = t1_;
    if (t1_ >= t_stop) locator_.note_beside_stop();
    return t1_ >= t_stop ? StopReason::stop_time : StopReason::step;
  }

  /// Delivers the step to `to`, an offset inside it at t [s], or to a root before.
  StopReason deliver_part(double to, double t) {
    if constexpr (CutsSteps<Method>) {
      if (is_whole()) self().cut(to);
    }
    const auto look = [this](double u, double* x) { inside(u, x); };
    locator_.forget();
    const bool searched = offset_ < to && !guards_->active().all.empty();
    if (!searched) guards_->begin_search();
    const bool stops =
        searched &&
        locator_.find({t0_, offset_, to, nullptr, nullptr, part_points(to), points()}, look);
    const double end = stops ? locator_.offset() : to;
    if (searched && !stops) locator_.note_beside_stop();
    read_root(end);
    locator_.forget();  // its looks are those of a step that ends here
    offset_ = end, delivered_ = false;
    time_ = end < to ? t0_ + end : t;
    return stops ? StopReason::root : StopReason::stop_time;
  }

  LookPoints* points() {
    const bool by_values = guards_->scan_points || tangent_;
    return by_values ? nullptr : self().look_points();
  }

  /// Whether nothing of the step is delivered, and the method itself has taken it.
  bool is_whole() const noexcept { return offset_ == 0.0 && !tangent_; }

  /// Whether a root is so near to the end of the step that the state is as good as there.
  bool is_at_end(double root) const { return length_ - root <= thresholds::beside_stop * length_; }

  template <class Inside>
  bool find_root(const Inside& inside) {
    const auto find = [&](const double* guards) {
      return locator_.find({t0_, offset_, length_, x1_.data(), guards, scan_points(), points()},
                           inside);
    };
    if constexpr (CutsSteps<Method>) {
      before_ = guards_->g;
      if (!find(nullptr)) return false;
      if (!is_whole() || is_at_end(locator_.offset()) || !self().cut(locator_.offset()))
        return true;
      guards_->restore(), guards_->monitors.clear(), locator_.forget();
      guards_->g = before_;
      return find(nullptr);
    } else {
      const double* guards = is_whole() ? self().end_guards() : nullptr;
      if (offset_ == 0.0 && guards == nullptr && locator_.passes(t0_, length_, x1_.data()))
        return false;
      return find(guards);
    }
  }

  /// The default is as many points as the degree of the interpolant, at least three: that of
  /// a multistep method that begins is a line, but its guard need not be.
  int scan_points() {
    return guards_->scan_points ? *guards_->scan_points
                                : std::max(thresholds::least_scan_points, self().even_looks());
  }

  /// As far apart as in the whole step.
  int part_points(double to) {
    const double share = (to - offset_) / length_;
    return std::max(1, static_cast<int>(std::ceil(scan_points() * std::min(share, 1.0))));
  }

  void read_root(double root) {
    try {
      inside(root, next_state_.data());
    } catch (...) {
      guards_->restore();
      throw;
    }
    state_.swap(next_state_);
  }

  /// A look inside the step threw: time and state are again those before `advance`. At a root in
  /// the step they have not changed.
  void take_back() {
    if (offset_ != 0.0) return;
    self().undo();
    delivered_ = true;
  }

  void take_step(double t_stop) {
    t0_ = t1_;
    tangent_.leave();
    try {
      self().step(t_stop);
    } catch (...) {
      self().undo();
      if (guards_->active().all.empty() || !tangent_.prepare(*machine_, t1_, x1_, t_stop)) throw;
      t1_ = t0_ + tangent_.length();
      x1_ = tangent_.end();
      length_ = tangent_.length();
    }
    offset_ = 0.0;
    delivered_ = false;
  }

  detail::TangentStep tangent_;  // after the method's own step was refused
  Locator locator_;
  double time_ = 0.0, offset_ = 0.0, run_begun_ = 0.0;
  double from_ = 0.0;      // offset_ before the last call of `advance`
  bool delivered_ = true;  // the last step is delivered to its end
  Eigen::VectorXd state_;  // the state at a root inside the last step
  Eigen::VectorXd next_state_;
  std::vector<double> before_;  // the guards at the begin of a step that may be cut
};

}  // namespace saltus
