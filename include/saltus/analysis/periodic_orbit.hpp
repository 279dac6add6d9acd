// periodic_orbit: limit cycles by Newton's method on the return of a state.
#pragma once

#include <exception>
#include <iosfwd>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "saltus/analysis/free_value.hpp"
#include "saltus/simulation/simulate.hpp"

namespace saltus {

struct PeriodicOrbitOptions {
  /// A guard, "wheel.spoke" or "spoke", that does not end the run. Empty: no section.
  std::string section = {};
  /// [s] The period of the drive, or a multiple of it.
  std::optional<double> period = {};
  int firings = 1;          ///< the orbit closes at this firing of the section after its start
  double max_period = 1e4;  ///< [s] the time in which the first return is looked for
  double transient = 0.0;   ///< [s] a run before the search: a way towards a stable orbit
  /// Parameters by which `dperiod` and `dx0` differentiate, with the names of the option
  /// `sensitivity`.
  std::vector<std::string> wrt = {};
  /// The search ends when a Newton step is smaller than this part of the size of each state.
  double tolerance = 1e-8;
  int max_iterations = 30;  ///< Newton steps at most
  /// The signals of the run of one period in `results`.
  RecordedSignals recorded_signals = {};
  /// The options of each run. Change single ones, so that the tight tolerances stay.
  SimulatorOptions simulation = {.rtol = 1e-10, .atol = 1e-12};
};

/// A state that returns to itself, the time that this takes, and its stability.
class PeriodicOrbit {
 public:
  Context context;     ///< at the start of the orbit: just after the firing of the section
  Eigen::VectorXd x0;  ///< its continuous states, in the order of the context
  std::vector<std::string> names;  ///< their names, "x[0]" or "ball.x[0]"
  double period = 0.0;             ///< [s]
  /// The Floquet multipliers, the largest first: the eigenvalues of the derivative of the return,
  /// through all events. Of an autonomous system the trivial one, 1 along the flow, is left out. NaN
  /// if the search did not converge.
  Eigen::VectorXcd multipliers;
  double trivial = 0.0;  ///< the trivial multiplier as it was computed; NaN for a driven system
  /// (k, k) the derivatives of the state after one period by the state at the start, at a fixed time.
  /// The states are the continuous ones, then the discrete ones that are numbers.
  Eigen::MatrixXd monodromy;
  /// (k, k) those at the moving time of the return to the section, for which the flow is a null
  /// vector; `monodromy` if there is no section.
  Eigen::MatrixXd return_map;
  double residual = 0.0;  ///< the largest entry of |P(x) - x|
  /// Converged, max_iterations, or stalled.
  SearchStatus status = SearchStatus::converged;
  std::string message;                  ///< the reason for any status but converged
  int iterations = 0;                   ///< Newton steps
  std::vector<std::string> notes;       ///< what a check found that limits the result
  Results results;                      ///< one period from `context`, with dense output
  std::vector<std::string> parameters;  ///< those of `wrt`; a vector has one for each entry

  bool success() const noexcept { return status == SearchStatus::converged; }
  /// Whether all multipliers are inside the unit circle. Empty if the search did not converge, or if
  /// the largest is so close to the circle that its error decides.
  std::optional<bool> stable() const;

  /// [s per unit] The derivative of the period by a parameter of `wrt`, by the implicit function
  /// theorem: the orbit of P(x, p) = x moves by (1 - P_x)^-1 P_p. For a driven system it is 0: its
  /// period is given. Throws ModelError for a name that was not in `wrt`, and for a parameter that
  /// changes the period of a drive; SimulationError if there is no orbit, or one that is not isolated.
  double dperiod(std::string_view parameter) const;
  /// The derivative of `x0` by it. Of an orbit without a section x0 may be any of its points; it moves
  /// across the flow.
  Eigen::VectorXd dx0(std::string_view parameter) const;

  // --- for the engine ---
  struct ByParameters {
    Eigen::MatrixXd x0;      // (n, p)
    Eigen::VectorXd period;  // (p,)
    std::exception_ptr none = {};
  };
  ByParameters by_parameters;

 private:
  Index parameter(std::string_view name) const;
};

/// Writes the status, the period, the start, the multipliers and the notes. Needs `<ostream>`.
std::ostream& operator<<(std::ostream& out, const PeriodicOrbit& orbit);

/// Finds a state x that returns to itself, P(x) = x, by Newton's method. P is one of three maps:
///
/// - with `section`: from just after a firing of this guard to just after its n-th next one
///   (`firings`), through all events on the way. The system must be autonomous.
/// - with `period`: the state after this time, for a driven system.
/// - with neither: the state after a time that is an unknown too, for an autonomous system.
///
/// The derivative of P is that of the runs, with the jump at each event (docs/derivatives.md); its
/// eigenvalues are the Floquet multipliers (P. Mueller, Chaos, Solitons & Fractals 5 (1995) 1671;
/// R. Leine, H. Nijmeijer, Dynamics and Bifurcations of Non-Smooth Mechanical Systems, 2004,
/// chapter 7). A Newton step that leaves the domain, or that does not bring the return closer to the
/// start, is halved. Stable and unstable orbits are found alike. At most 200 continuous states.
///
/// It returns also if the search does not converge; `status` says so, `message` why. Throws
/// ModelError for an argument that makes no sense, a name that is unknown, a system with a part that
/// has no derivatives, and a section or a free period where the time itself moves the system.
/// SimulationError if the section is not reached, a mode or a discrete state does not return, or the
/// first return has no derivative, with the event and the time; from a run that ends badly as from
/// `simulate`.
PeriodicOrbit periodic_orbit(const System& system, const Context& context,
                             const PeriodicOrbitOptions& options = {});

}  // namespace saltus
