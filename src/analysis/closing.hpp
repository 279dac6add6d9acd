// The equations whose solution is a periodic orbit, and runs from a start to its return.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "orbit_runs.hpp"

namespace saltus {

/// A run from the start s to its return P(s), for n states (continuous ones, then discrete ones) and
/// p parameters, with its derivatives.
struct Arc {
  Eigen::VectorXd start, end;     ///< s and P(s)
  double period = 0.0;            ///< [s] the time of the return
  Eigen::MatrixXd monodromy;      ///< (n, n) of the end by the start, at a fixed time
  Eigen::MatrixXd by_start;       ///< (n, n) of P(s), at the moving time of the return
  Eigen::MatrixXd by_parameters;  ///< (n, p) of P(s)
  Eigen::VectorXd period_by_start, period_by_parameters;
  Eigen::VectorXd flow_start, flow_end;  ///< f at both ends
  Context begin, final;
  std::vector<std::string> parameters;  ///< their names; a vector has one for each entry

  /// The first mode or label that has another value at the end, in words; empty if all are as they
  /// were.
  std::string unreturned(const RunStates& states, const std::vector<bool>& labels) const;
};

/// F(u) = P(s) - s for the unknowns u, which are the active states of s, and more in some kinds. All
/// states are active but for labels: discrete states that are whole numbers at both ends and do not
/// depend on the active ones, such as a count or a side.
class Closing {
 public:
  Closing(OrbitRuns& runs, const Context& context);
  virtual ~Closing() = default;

  /// Whether the time itself does not move the system.
  virtual bool autonomous() const { return true; }
  /// The unknowns of the present start.
  virtual Eigen::VectorXd unknowns() const { return values_(active_); }
  /// The run from a start to its return.
  virtual Arc arc(const Context& start, const Eigen::VectorXd& unknowns,
                  const std::vector<std::string>& parameters) = 0;
  /// F at the start of an arc, and its derivatives by the unknowns.
  virtual Eigen::VectorXd residual(const Arc& arc) const;
  virtual Eigen::MatrixXd matrix(const Arc& arc) const;
  /// The size of each unknown on the orbit: its value and the way it moves in a period.
  virtual Eigen::VectorXd scale(const Arc& arc) const { return sizes(arc)(active_); }
  /// (n, p) and (p,): the derivatives of the start and of the period by parameters, by the implicit
  /// function theorem: F_u du/dp + F_p = 0.
  virtual std::pair<Eigen::MatrixXd, Eigen::VectorXd> implicit(
      const Arc& arc, const std::vector<std::string>& parameters);
  /// The same start at another time, at which an autonomous system does the same.
  virtual Arc again(const Arc& arc);
  /// Begins anew at the end of the arc, with its modes and labels.
  virtual void move_to_end(const Arc& arc);
  /// The values of the orbit at its start, just after the firing of a section.
  virtual Context on_orbit(const Arc& arc) { return arc.begin; }
  /// The derivatives of these from those of the start.
  virtual Eigen::MatrixXd to_orbit(const Context& /*at*/, const std::vector<std::string>& /*names*/,
                                   const Eigen::MatrixXd& by) {
    return by;
  }

  Arc at(const Eigen::VectorXd& unknowns, const std::vector<std::string>& parameters = {}) {
    return arc(start(unknowns), unknowns, parameters);
  }
  /// The size of each state on the orbit.
  Eigen::VectorXd sizes(const Arc& arc) const;
  /// Finds the labels among the discrete states.
  void take_labels(const Arc& arc);

  OrbitRuns& runs() const noexcept { return runs_; }
  const RunStates& states() const noexcept { return states_; }
  const Context& base() const noexcept { return base_; }
  const std::vector<Index>& active() const noexcept { return active_; }
  const std::vector<bool>& labels() const noexcept { return labels_; }
  /// The part of a matrix that belongs to the active states.
  Eigen::MatrixXd square(const Eigen::MatrixXd& of) const { return of(active_, active_); }
  /// max(1, the norm of that part): how far a small change can grow in a period.
  double growth(const Arc& arc) const;

 protected:
  /// The names by which a run is differentiated.
  std::vector<std::string> names_with(const std::vector<std::string>& parameters) const;
  /// The context with the unknowns as its active states.
  Context start(const Eigen::VectorXd& unknowns) const;
  /// The arc of a run whose return is `moved` seconds after its end; `times` are the derivatives of
  /// the time of return, empty where it is fixed.
  Arc made(const Context& start, const Results& results, double period, double moved,
           const Eigen::VectorXd& times) const;
  /// Refuses a gap, but for derivatives by labels, which nobody reads.
  void require(const Results& results, const Eigen::MatrixXd& by,
               const Eigen::VectorXd& times) const;
  Eigen::MatrixXd active_rows(const Eigen::MatrixXd& of) const { return of(active_, Eigen::all); }
  /// Takes the values of the start.
  void begin_at(const Context& context);

 private:
  void set_labels(std::vector<bool> labels);

  OrbitRuns& runs_;
  Context base_;
  RunStates states_;
  Eigen::VectorXd values_;
  std::vector<bool> labels_;
  std::vector<Index> active_;
};

/// The return to a guard: P(s) is the state a short delay after its n-th firing. With the delay the
/// start is clear of the guard, and P is defined beside the section too: P' = S + f dtau/ds, with S
/// the derivatives at the fixed time. Along f, P' is 0; its other eigenvalues are those of the map of
/// the section, x+ to x+, for each delay.
std::unique_ptr<Closing> closing_of_section(OrbitRuns& runs, const Context& context,
                                            const std::string& section, int firings,
                                            double longest);
/// The state after a period that is given; the instant at the start has happened already.
std::unique_ptr<Closing> closing_of_period(OrbitRuns& runs, const Context& context, double period);
/// The state after the time T, which is an unknown; the phase condition is f(s).ds = 0 for a Newton
/// step ds. The bordered matrix is regular although P'(s) has the eigenvalue 1 along f (E. Doedel,
/// H. Keller, J. Kernevez, Int. J. Bifurcation and Chaos 1 (1991) 745, section 2).
std::unique_ptr<Closing> closing_of_free_period(OrbitRuns& runs, const Context& context,
                                                double guess);

/// A state and the time after which the run from it comes close to it again. Throws SimulationError
/// if there is none within `longest` seconds.
std::pair<Context, double> guess_period(OrbitRuns& runs, const Context& context, double longest);

}  // namespace saltus
