// d(xdot)/d(x) of a machine: from the leaves' own Jacobians if they have one, otherwise by
// differences.
#pragma once

#include <random>
#include <string>

#include "saltus/base/list.hpp"
#include "saltus/plan/detail/machine.hpp"
#include "saltus/solver/detail/colouring.hpp"

namespace saltus {

/// How far a difference moves a state.
struct Increments {
  double rtol = 1e-6, atol = 1e-8;
  double h = 0.0;                                   ///< [s] the step the Jacobian is for
  const double *rtols = nullptr, *atols = nullptr;  ///< of each state; null: one for all

  /// The error of state j that counts as one, where the state has this size.
  double tolerance(Index j, double size) const {
    return rtols == nullptr ? rtol * size + atol : rtols[j] * size + atols[j];
  }
};

/// Each run has its own Jacobian. No function allocates after construction.
class Jacobian {
 public:
  /// Throws the exceptions of jacobian_pattern.
  explicit Jacobian(Machine& machine, const FoundBlocks& found = {});

  const JacobianPattern& pattern() const { return pattern_; }
  /// Calls of the right-hand side that one evaluation costs.
  Index colours() const { return colouring_.colours(); }

  /// Fills a pattern that overflowed: every place may differ from zero.
  void fill_up();
  /// Entry k of the pattern will go to out[places[k]]; without it, to out[k].
  void store_at(std::vector<Index> places) { places_ = std::move(places); }

  /// Writes the entries at (t, x), where the derivative is `xdot`; the entries of states at rest
  /// are zero. Differences replace entries of a leaf's own Jacobian that are not finite, such as
  /// the slope of a square root at 0: only Newton's iteration uses them, and `words` reports them.
  /// False if the derivative nearby is not finite. Throws SimulationError if a leaf's own Jacobian
  /// is not zero outside its declared sparsity. Exceptions of a user's function pass through.
  ///
  /// Column j is (f(x + d e_j) - f(x)) / d, columns of one colour together, with the increment of
  /// CVODE's own differences, d = max(sqrt(eps) |x_j|, s (rtol |x_j| + atol)) where s = 1000 |h|
  /// eps n |f| and |f| the weighted root mean square (A. C. Hindmarsh, R. Serban, User
  /// Documentation for CVODE, "Direct linear solvers", (2.9)). While a block rests on a moving
  /// surface, the carried states count as constant.
  bool operator()(double t, const double* x, const double* xdot, const Increments& by, double* out);

  /// Whether these values, of (t, x), explain how f moves: for a random v, |v_j| from s w_j / 2 to
  /// s w_j with w_j = rtol |x_j| + atol and s = min(1, sqrt(eps) / rtol), no row of f(x + v) - f(x)
  /// - J v is beyond 1 % of |J| |v| plus a hundred roundings while h times it is beyond 1 % of s w.
  /// This finds a missing place, with probability 1, as soon as Newton's iteration could notice it.
  /// It may also find a kink. Costs one call.
  bool explains(double t, const double* x, const double* xdot, const Increments& by,
                const double* values);

  /// From now on differences replace all entries of the leaves' own Jacobians: Newton's iteration
  /// does not converge with them, and they do not explain how f moves.
  void distrust() { distrusted_ = true; }
  bool distrusted() const { return distrusted_; }
  /// Whether there are own Jacobians, and they are used.
  bool trusts_own() const { return !own_.empty() && !distrusted_; }

  /// The faults of the leaves' own Jacobians; empty if there were none.
  std::string words() const;
  auto mended() const noexcept { return mended_; }  ///< evaluations with replaced entries

 private:
  /// Entry `entry` of the pattern is value `from` of a leaf's own Jacobian.
  struct Copy {
    Index entry, from;
    int row, column;
  };
  struct Own {
    int leaf;
    Index size;  // number of its values
    std::vector<Copy> copies;
  };

  void prepare();
  void add_own(int leaf);
  bool move(double t, Index colour, double least, const Increments& by);
  bool differences(double t, const double* x, const double* xdot, const Increments& by,
                   double* out);
  void move_by_values(const double* values);
  const double* begin_at(double t, const double* x, const double* xdot);
  double least_increment(const double* x, const double* xdot, const Increments& by) const;
  double increment(Index j, double x, double least, const Increments& by) const;
  bool take(const Own& own, double t, const double* x, const double* xdot, const Increments& by,
            double* out);
  bool mend(const Own& own, double t, const double* x, const double* xdot, const Increments& by);
  void note(const Copy& bad, const PlanLeaf& leaf, double t, double declared, double found);
  void ode_of(const PlanLeaf& leaf, double t, Eigen::VectorXd& xdot);
  [[noreturn]] void refuse(const Own& own, double t, const char* what) const;
  Index place(Index entry) const { return places_.empty() ? entry : places_[entry]; }

  Machine* machine_;
  JacobianPattern pattern_;
  Colouring colouring_;
  List<Index> places_;
  std::vector<Own> own_;
  Eigen::VectorXd x_, f_, base_, moved_, block_;
  Eigen::VectorXd sum_, least_;  // of rows; made at their first use
  std::mt19937_64 random_{1};
  bool distrusted_ = false;  // the own Jacobians are wrong
  std::string first_mended_;
  int mended_ = 0;  // evaluations in which own entries were replaced
};

}  // namespace saltus
