// lyapunov: the spectrum of Lyapunov exponents, through events.
#pragma once

#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "saltus/analysis/free_value.hpp"
#include "saltus/simulation/simulate.hpp"

namespace saltus {

struct LyapunovOptions {
  /// [s] The length of the run, after the transient. The standard error falls as its root.
  double time = 0.0;
  double transient = 0.0;  ///< [s] a run before, without derivatives: the way to the attractor
  std::optional<double> every = {};  ///< [s] the longest piece; empty: a 200th of the time
  std::optional<int> count = {};     ///< exponents, from the largest on; empty: all
  /// Converged is what has standard errors of at most this part of each exponent, or, where an
  /// exponent may be zero, of the smallest that is not.
  double tolerance = 0.02;
  /// The options of each run. Change single ones, so that the tight tolerances stay.
  SimulatorOptions simulation = {.rtol = 1e-9, .atol = 1e-11};
};

/// The mean rates at which neighbouring states move apart, in k directions.
struct LyapunovSpectrum {
  /// [1/s] The largest first; -infinity where an event leaves nothing of a direction.
  Eigen::VectorXd exponents;
  /// [1/s] Their standard errors, by batches of the time; infinite with too few pieces.
  Eigen::VectorXd errors;
  /// Whether each error is at most `tolerance` times the size of its exponent. An exponent
  /// that is zero within two errors has the size of the smallest other exponent. If all are, it is 1 over the time.
  bool converged = false;
  std::string message;              ///< which exponent has not converged, and what to do
  double begin = 0.0;               ///< [s] the time from which the averages count
  Eigen::VectorXd times;            ///< (pieces,) [s] the ends of the pieces that count
  Eigen::MatrixXd history;          ///< (pieces, k) [1/s] the averages up to these times
  std::vector<std::string> states;  ///< continuous states, then discrete ones that are numbers
  /// The discrete states that are labels, whole numbers on which nothing depends smoothly, and their
  /// values at the end.
  std::vector<NamedValue> frozen;
  Context context;  ///< the values at the end, from which a longer run can go on

  /// [1/s] The mean rate at which a volume of states grows: of a smooth flow the mean of its
  /// divergence, plus ln |det S| for each jump S in that time. Of the first k directions only, if
  /// `count` was given.
  double sum() const { return exponents.sum(); }
  /// The Kaplan-Yorke dimension of the attractor, k + (l_1 + ... + l_k) / |l_(k+1)|, with the largest
  /// k for which the sum is not negative (J. Kaplan, J. Yorke, Lecture Notes in Mathematics 730
  /// (1979) 204). An exponent within two standard errors of zero counts as zero. A lower bound, if
  /// `count` was given and the sum of all is not negative.
  double dimension() const;
};

/// Writes the exponents with their errors, the sum and the dimension. Needs `<ostream>`.
std::ostream& operator<<(std::ostream& out, const LyapunovSpectrum& spectrum);

/// The Lyapunov exponents, the mean rates of ln |dx(t)| for small changes dx of a state.
///
/// The run is made in pieces. The derivative D of the end of a piece by its start goes through all
/// events, with the jump of each (docs/derivatives.md; P. Mueller, Chaos, Solitons & Fractals 5
/// (1995) 1671). Orthonormal directions Q are carried on by D Q = Q' R, and the exponents are the sums
/// of ln |r_ii| divided by the time (G. Benettin, L. Galgani, A. Giorgilli, J.-M. Strelcyn, Meccanica
/// 15 (1980) 9; I. Shimada, T. Nagashima, Prog. Theor. Phys. 61 (1979) 1605). The pieces are so short
/// that two directions grow apart by 1000 or less in one. In the first tenth of the time the
/// directions only turn towards their own ones; it does not count. The standard errors are those of
/// the means of batches (G. Fishman, Monte Carlo, Springer 1996, section 6.3). Discrete states count
/// as states, but for labels, whole numbers that depend on no other state. At most 200 continuous
/// states, autonomous or driven.
///
/// It returns also if the averages have not converged. Throws ModelError for an argument that makes no
/// sense, a system with a part that has no derivatives, and a start with a block at rest.
/// SimulationError if a derivative does not exist, with the event, the time and the reason; if the run
/// ends before its time, or comes to rest for good; from a run that ends badly as from `simulate`.
LyapunovSpectrum lyapunov(const System& system, const Context& context,
                          const LyapunovOptions& options);

}  // namespace saltus
