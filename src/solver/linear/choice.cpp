// The rule: estimated time of one factorisation by each solver.
#include "choice.hpp"

#include <cmath>

#include "fill.hpp"

namespace saltus {

namespace {

// Times of one factorisation in nanoseconds, fitted to bench/linear_solvers; what counts is where
// they cross.
double dense_time(double n) { return n < 48.0 ? 0.4 * n * n * n : 0.1 * n * n * n + 40.0 * n * n; }
double band_time(double n, const Bandwidth& band) {
  const auto lower = static_cast<double>(band.lower), upper = static_cast<double>(band.upper);
  return n * (10.0 + 0.8 * (lower + 1.0) * (lower + upper + 1.0));
}
double sparse_time(double n, const Fill& fill) {
  return 300.0 * n + 15.0 * fill.entries + 1.0 * fill.operations;
}

/// A factor of more entries does not pay: GMRES.
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

/// The natural order unless another one makes the band narrower by far.
void find_band(const Sparsity& places, LinearChoice& choice) {
  choice.band = bandwidth(places), choice.position.clear();
  if (choice.band.total() <= 8) return;
  std::vector<int> position = reverse_cuthill_mckee(places);
  const Bandwidth other = bandwidth(places, position);
  if (5 * other.total() > 4 * choice.band.total()) return;
  choice.band = other, choice.position = std::move(position);
}

std::string automatic(const Jacobian& jacobian, Index n, LinearChoice& choice) {
  const JacobianPattern& pattern = jacobian.pattern();
  const auto size = static_cast<double>(n);
  choice.solver = LinearSolver::dense;
  if (n <= 8) return "few states";
  if (pattern.overflow) {
    choice.solver = LinearSolver::gmres;
    return "without a preconditioner: declare the sparsity of the largest blocks for a better one";
  }
  find_band(pattern.places, choice);
  const double dense = dense_time(size), band = band_time(size, choice.band);
  if (dense <= band && n <= 100) return "most of them are places";
  if (band <= dense && choice.band.total() <= 8) {
    choice.solver = LinearSolver::band;
    return "the band is narrow";
  }
  const Fill fill = predicted_fill(pattern.places, most_entries);
  const double sparse = sparse_time(size, fill);
  if (dense <= std::min(band, sparse)) return "most of them are places";
  if (band > sparse) {
    choice.solver = LinearSolver::sparse;
    return text("about ", std::round(fill.entries), " entries in its factors");
  }
  choice.solver = LinearSolver::band;
  if (std::isfinite(sparse)) return "the band is narrow enough";
  if (band <= 1e9) return "sparse factors would fill up";
  choice.solver = LinearSolver::gmres;
  return "factors would fill up";
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
