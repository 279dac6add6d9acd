// Trajectory: the continuous state of a run at every time, as polynomials.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "saltus/simulation/options.hpp"

namespace saltus {

class Contacts;
class Machine;
struct SurfaceContact;

/// Which value at the time of an event: that before it or that after it.
enum class Side { left, right };

/// What the solver's own interpolant drew, step by step: its values at the Chebyshev points of the
/// step, one more than its degree, which determine it. It is read by the barycentric formula (J.-P.
/// Berrut, L. N. Trefethen, "Barycentric Lagrange interpolation", SIAM Review 46 (2004), pp. 504
/// and 507), exact at these points and as stable as the values themselves (N. J. Higham, IMA J.
/// Numer. Anal. 24 (2004) 547). So the method's order is kept, whatever the method was.
///
/// Beside it stands what jumps only at instants and outputs read: discrete state, modes, held
/// signals, blocks that a surface carries. Empty, and without memory, unless it was asked for.
class Trajectory {
 public:
  Trajectory();
  ~Trajectory();
  Trajectory(const Trajectory&);
  Trajectory& operator=(const Trajectory&);
  Trajectory(Trajectory&&) noexcept;
  Trajectory& operator=(Trajectory&&) noexcept;

  /// What stays as it is from one instant to the next.
  struct Held {
    Eigen::VectorXd z, y;  // y: of `held_nodes`, one after the other
    std::vector<int> modes;
    std::vector<SurfaceContact> contacts;  // those that carry
  };
  /// Where to read: a piece, or one of the two ends.
  struct Spot {
    std::size_t held = 0;
    std::size_t values = 0;  // of the state at the nodes
    int degree = 0;          // 0: one value, whatever the time
    double begin = 0.0, end = 0.0;
  };

  bool empty() const noexcept { return held_.empty(); }
  double begin() const noexcept { return first_.begin; }  ///< [s]
  double end() const noexcept { return last_.begin; }     ///< [s]
  /// [s] where its polynomials begin, and where the last one ends.
  std::vector<double> joints() const;
  /// Bytes of the values it keeps.
  std::size_t memory() const noexcept {
    return values_.size() * sizeof(double) + pieces_.size() * sizeof(Piece);
  }

  /// Throws ModelError for a time outside the run: nothing is extrapolated.
  Spot spot(double t, Side side) const;
  /// x(t), t within the spot.
  void state(const Spot& spot, double t, double* x) const;
  const Held& held(const Spot& spot) const;
  const std::vector<int>& held_nodes() const noexcept { return held_nodes_; }
  const std::shared_ptr<const Plan>& plan() const noexcept { return plan_; }
  const Context& start() const noexcept { return start_; }
  SimulatorOptions tolerances() const { return {.rtol = rtol_, .atol = atol_}; }

  // --- for the engine --------------------------------------------------------------------------
  void start(std::shared_ptr<const Plan> plan, const Context& from,
             const SimulatorOptions& options);
  /// The state before anything happened at the beginning.
  void open(double t, const Machine& machine, const Contacts& contacts);
  /// The state with which the next step begins: after an instant not quite what the interpolant of
  /// a multistep method says there.
  void depart(const Eigen::VectorXd& x) { departed_ = x; }
  /// A step, or the part of one up to a root: interpolate(t, x) draws it, x_end ends it.
  template <class Interpolate>
  void add(double from, double to, int degree, const Machine& machine, const Contacts& contacts,
           const Eigen::VectorXd& x_end, Interpolate interpolate) {
    if (!(to > from)) return;
    double* nodes = begin_piece(from, to, degree, machine, contacts);
    for (int k = 0; k < degree; ++k)
      interpolate(from + (to - from) * node(k, degree), nodes + k * size_);
    end_piece(x_end);
  }
  /// An instant: what was held may have changed.
  void instant() noexcept { stale_ = true; }
  /// The end, so far. After a run that failed half way through an instant: the last whole state.
  void close(double t, const Machine& machine, const Contacts& contacts, bool whole);

 private:
  struct Piece {
    double begin, end;
    std::size_t first, values, held;  // first: of the state at its beginning
    int degree;
  };
  static double node(int k, int degree);
  double* begin_piece(double from, double to, int degree, const Machine& machine,
                      const Contacts& contacts);
  void end_piece(const Eigen::VectorXd& x_end);
  std::size_t put(const Eigen::VectorXd& x);
  std::size_t hold(const Machine& machine, const Contacts& contacts);

  std::shared_ptr<const Plan> plan_;
  Context start_;
  double rtol_ = 1e-6, atol_ = 1e-8;
  Index size_ = 0;
  std::vector<int> held_nodes_;
  std::vector<Piece> pieces_;
  std::vector<double> values_;
  std::vector<Held> held_;
  Spot first_, last_;
  Eigen::VectorXd departed_;
  bool stale_ = true;
};

}  // namespace saltus
