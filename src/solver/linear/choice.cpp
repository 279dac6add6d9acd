// The choice of a linear solver, by the estimated time of one factorisation.
#include "choice.hpp"

#include <cmath>

#include "fill.hpp"

namespace saltus {

namespace {

// Times of one factorisation and its solves in nanoseconds, fitted to bench/linear_solvers. Only
// the sizes at which they cross matter.
double dense_time(double n) { return 0.06 * n * n * n + 3.0 * n * n; }
double band_time(double n, const Bandwidth& band) {
  const auto lower = static_cast<double>(band.lower), upper = static_cast<double>(band.upper);
  return n * (20.0 + 2.0 * (lower + upper) + 0.15 * (lower + 1.0) * (lower + upper + 1.0));
}
double sparse_time(double n, const Fill& fill) {
  return 300.0 * n + 15.0 * fill.entries + 1.0 * fill.operations;
}
/// The estimate is three times the measured time, because the number of GMRES iterations is not
/// known beforehand.
double gmres_time(Index places) { return 3.0 * 150.0 * static_cast<double>(places); }

/// The count of the entries of a factor stops here.
constexpr double most_entries = 2e7;

std::string facts(const Jacobian& jacobian, Index n, const LinearChoice& choice) {
  const JacobianPattern& pattern = jacobian.pattern();
  std::string out = text("n = ", n);
  if (pattern.overflow) return text(out, ", places unknown or more than ", most_places(n));
  out += text(", ", pattern.places.size(), " places, ");
  out += jacobian.colours() == 0 ? std::string("none by differences")
                                 : text(jacobian.colours(), " colours");
  if (choice.solver == LinearSolver::band)
    out += text(", band ", choice.band.lower, " + 1 + ", choice.band.upper,
                choice.position.empty() ? "" : " after reordering");
  return out;
}

/// Keeps the natural order unless another order makes the band much narrower.
void find_band(const Sparsity& places, LinearChoice& choice) {
  choice.band = bandwidth(places), choice.position.clear();
  if (choice.band.total() <= 8) return;
  std::vector<int> position = reverse_cuthill_mckee(places);
  const Bandwidth other = bandwidth(places, position);
  if (5 * other.total() > 4 * choice.band.total()) return;
  choice.band = other, choice.position = std::move(position);
}

std::string automatic(const Jacobian& jacobian, Index n, LinearChoice& choice) {
  const Sparsity& places = jacobian.pattern().places;
  choice.solver = LinearSolver::dense;
  if (n <= 8) return "few states";
  if (jacobian.pattern().overflow) {
    choice.solver = LinearSolver::gmres;
    return "without a preconditioner: declare the sparsity of the largest blocks for a better one";
  }
  find_band(places, choice);
  const auto size = static_cast<double>(n);
  const double dense = dense_time(size), band = band_time(size, choice.band);
  if (band <= dense && choice.band.total() <= 8) {
    choice.solver = LinearSolver::band;
    return "the band is narrow";
  }
  const Fill fill = predicted_fill(places, most_entries);
  const double sparse = sparse_time(size, fill), direct = std::min({dense, band, sparse});
  if (direct > gmres_time(places.size())) {
    choice.solver = LinearSolver::gmres;
    return "factors would fill up";
  }
  if (direct == dense) return "nothing gained by leaving out zeros";
  choice.solver = direct == band ? LinearSolver::band : LinearSolver::sparse;
  if (direct == band) return "the band is narrow enough";
  return text("about ", fill.entries, " entries in its factors");
}

}  // namespace

LinearChoice choose_linear_solver(const Jacobian& jacobian, Index n, LinearSolver asked) {
  LinearChoice choice{.solver = asked};
  std::string why = "asked for";
  if (asked == LinearSolver::automatic)
    why = automatic(jacobian, n, choice);
  else if (asked == LinearSolver::band && !jacobian.pattern().overflow)
    find_band(jacobian.pattern().places, choice);
  choice.why = text(facts(jacobian, n, choice), "; ", why);
  return choice;
}

}  // namespace saltus
