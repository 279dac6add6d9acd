// trim: a state at which rates and outputs have chosen values.
#pragma once

#include <iosfwd>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "saltus/analysis/free_value.hpp"
#include "saltus/simulation/linearize.hpp"

namespace saltus {

/// The rate of a continuous state that is wanted where it is not 0.
struct WantedRate {
  std::string name = {};             ///< of the state: "x[0]", "plant.angle"
  std::optional<double> value = {};  ///< [unit of the state per s]; empty: any rate
};

/// An output that has to have a value.
struct WantedOutput {
  /// An output of the system by its name, "y", or an entry of a vector, "y[1]".
  WantedOutput(std::string of, double at)
      : name(std::move(of)), value(Eigen::VectorXd::Constant(1, at)) {}
  WantedOutput(std::string of, Eigen::VectorXd at) : name(std::move(of)), value(std::move(at)) {}
  /// An output of a block in the system, under a name of your choice.
  WantedOutput(std::string of, OutputPort from, double at) : WantedOutput(std::move(of), at) {
    port = from;
  }
  WantedOutput(std::string of, OutputPort from, Eigen::VectorXd at)
      : WantedOutput(std::move(of), std::move(at)) {
    port = from;
  }

  std::string name;
  Eigen::VectorXd value;
  OutputPort port = {};
};

struct TrimOptions {
  /// What may change: continuous states, open inputs and dynamic parameters, and an entry of a vector
  /// as "u[1]". A start that is not given is that of the context, 0 of an open input, if it lies
  /// within the bounds, or else their middle. Empty: all continuous states that `hold` does not name.
  std::optional<std::vector<FreeValue>> free = {};
  /// Values of states, parameters and open inputs that stay fixed; without a value those of the
  /// context. An open input that is not free needs a value here or by `fix_input`.
  std::vector<LinearInput> hold = {};
  std::vector<WantedRate> derivatives = {};
  std::vector<WantedOutput> outputs = {};
  /// Converged means |r| <= tolerance |J| |v| for each residual r, with its derivatives J and the
  /// sizes |v| of the free values. The search goes on to the rounding.
  double tolerance = 1e-9;
  /// Evaluations of the least squares at most. Empty: 100 for each free value.
  std::optional<int> max_nfev = {};
  /// May give leaves other functions while the plan is made.
  std::shared_ptr<Refinement> refinement = {};
};

enum class Stability { stable, unstable, undecided, no_states };

std::string_view to_string(Stability stability);

/// The values at which rates and outputs are as they were wanted.
struct OperatingPoint {
  Context context;                  ///< of the point, with the values that were found
  std::vector<NamedValue> values;   ///< that were found, in the order of `free`
  std::vector<LinearInput> inputs;  ///< open inputs that were free or held; `linearize` takes them
  /// found - wanted: "rate of angle" for the rate of a state, "y" for an output.
  std::vector<NamedValue> residuals;
  SearchStatus status = SearchStatus::converged;
  std::string message;  ///< the reason for any status but converged
  int rank = 0;         ///< of the derivatives of the residuals by the free values
  std::vector<std::string> undetermined;  ///< the free values that the equations leave open
  std::vector<std::string> at_bounds;     ///< the free values at one of their bounds
  /// The guards with an effect that lie between the start and this point: a run from the one to the
  /// other leaves the mode in which the point was found.
  std::vector<std::string> crossed;
  std::vector<std::string> notes;  ///< what limits the result, in words
  /// The matrices at the point, by the free and held open inputs and the free parameters; at a kink
  /// those of the present side.
  Linearization linearization;
  bool smooth = true;   ///< false at a kink or at a guard, where no linearisation exists
  double margin = 0.0;  ///< [1/s] the error of the largest real part of a pole
  int evaluations = 0;

  bool success() const noexcept { return status == SearchStatus::converged; }
  /// A value that was found, by its name; a ModelError lists the names there are.
  double value(std::string_view name) const;
  /// The eigenvalues of A [1/s], by increasing real part.
  Eigen::VectorXcd poles() const { return linearization.poles(); }
  /// By the poles. Undecided if the search did not converge, there is no linearisation, or the largest
  /// real part is zero to its error (A. M. Lyapunov 1892: the linearisation decides only beside the
  /// imaginary axis).
  Stability stability() const;
};

/// Writes the values, the largest residual, the poles and the notes. Needs `<ostream>`.
std::ostream& operator<<(std::ostream& out, const OperatingPoint& point);

/// Finds an operating point: 0 = f(x, u, p), or chosen derivatives and outputs. It solves
///
///     f_i(v) = r_i for the rates, and h_k(v) = y_k for the outputs
///
/// for the free values v within their bounds, with everything else fixed: time, modes and discrete
/// states stay. Least squares within bounds (detail/least_squares.hpp) are followed by Newton steps
/// to the rounding. The Jacobian has the rows of A, B, C and D, as `linearize` computes them.
///
/// It returns also if the search does not converge; `status` says so, `message` why. Throws
/// ModelError for an unknown name, with the nearest one, a name that is free twice or free and held,
/// an open input without a value, a value that is not finite at the start, a system without anything
/// to solve for, and a block that is at rest or keeps a history.
OperatingPoint trim(const System& system, const Context& context, const TrimOptions& options = {});

}  // namespace saltus
