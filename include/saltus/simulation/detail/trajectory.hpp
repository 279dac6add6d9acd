// Trajectory: the continuous state of a run at every time, as polynomials.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "saltus/simulation/detail/nodal_values.hpp"
#include "saltus/simulation/options.hpp"

namespace saltus {

class Contacts;
class Machine;
struct SurfaceContact;

/// Which value at the time of an event: the value before it or the value after it.
enum class Side { left, right };

/// The solver's own interpolant, step by step, as NodalValues. So the order of every method is
/// kept.
///
/// The trajectory also keeps the values that change only at instants and that outputs read:
/// discrete state, modes, held signals, blocks that a surface carries. It is empty, and uses no
/// memory, unless the user asked for it.
///
/// That of a run by islands has parts, one for each island, and no polynomials of its own.
class Trajectory {
 public:
  Trajectory();
  ~Trajectory();
  Trajectory(const Trajectory&);
  Trajectory& operator=(const Trajectory&);
  Trajectory(Trajectory&&) noexcept;
  Trajectory& operator=(Trajectory&&) noexcept;

  /// The values that do not change between two instants.
  struct Held {
    Eigen::VectorXd z, y;  // y: of `held_nodes`, one after the other
    std::vector<int> modes;
    std::vector<SurfaceContact> contacts;  // the contacts that carry
  };
  /// The place to read: a piece, or one of the two ends.
  struct Spot {
    std::size_t held = 0;
    std::size_t values = 0;  // index of the states at the nodes
    int degree = 0;          // 0: one value at all times
    double begin = 0.0, end = 0.0;
  };

  /// The trajectory of an island, and where its values are among those of all.
  struct Part {
    struct States {
      Index from, to, size;  ///< offsets in the state of the island, and in that of all
    };
    std::shared_ptr<const Trajectory> of;
    std::vector<States> states;
    std::vector<int> signals;  ///< the number in all of each of its recorded signals
  };
  /// The trajectory of a run by islands, from `begin` [s] to the end that all parts have.
  static Trajectory of_parts(std::shared_ptr<const Plan> plan, double begin,
                             std::vector<Part> parts);
  const std::vector<Part>& parts() const noexcept { return parts_; }

  bool empty() const noexcept { return held_.empty() && parts_.empty(); }
  double begin() const noexcept { return first_.begin; }  ///< [s]
  double end() const noexcept { return last_.begin; }     ///< [s]
  /// [s] The times at which its polynomials begin, and the end of the last one.
  std::vector<double> joints() const;
  /// Bytes of the values it keeps.
  std::size_t memory() const noexcept;

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
  /// Sets the state with which the next step begins. After an instant it differs slightly from the
  /// interpolant of a multistep method there.
  void depart(const Eigen::VectorXd& x) { departed_ = x; }
  /// Adds a step, or the part of a step before a root. interpolate(t, x) gives the state inside it,
  /// x_end is the state at its end.
  template <class Interpolate>
  void add(double from, double to, int degree, const Machine& machine, const Contacts& contacts,
           const Eigen::VectorXd& x_end, Interpolate interpolate) {
    if (!(to > from)) return;
    double* nodes = begin_piece(from, to, degree, machine, contacts);
    for (int k = 0; k < degree; ++k)
      interpolate(from + (to - from) * NodalValues::node(k, degree), nodes + k * values_.size());
    end_piece(x_end);
  }
  /// An instant happened: the held values may have changed.
  void instant() noexcept { stale_ = true; }
  /// Sets the present end. After a run that failed in the middle of an instant, the end is the last
  /// whole state.
  void close(double t, const Machine& machine, const Contacts& contacts, bool whole);

 private:
  struct Piece {
    double begin, end;
    std::size_t first, values, held;  // first: index of the state at its beginning
    int degree;
  };
  double* begin_piece(double from, double to, int degree, const Machine& machine,
                      const Contacts& contacts);
  void end_piece(const Eigen::VectorXd& x_end);
  std::size_t hold(const Machine& machine, const Contacts& contacts);

  std::shared_ptr<const Plan> plan_;
  Context start_;
  Tolerance rtol_ = 1e-6, atol_ = 1e-8;
  std::vector<int> held_nodes_;
  std::vector<Piece> pieces_;
  NodalValues values_;
  std::vector<Held> held_;
  std::vector<Part> parts_;
  Spot first_, last_;
  Eigen::VectorXd departed_;
  bool stale_ = true;
};

/// Throws ModelError for a run without dense output.
void require_kept(const Trajectory& trajectory);
/// Throws ModelError for a time outside the run: nothing is extrapolated.
void require_inside(const Trajectory& trajectory, double t);

}  // namespace saltus
