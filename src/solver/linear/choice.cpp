// The choice of a linear solver, by the estimated time of one factorisation.
#include "choice.hpp"

#include <cmath>

#include "fill.hpp"

#include "saltus/solver/detail/linear_thresholds.hpp"

namespace saltus {

namespace {

using namespace thresholds;

// Times of one factorisation and its solves in nanoseconds.
double dense_time(double n) { return dense_cube * n * n * n + dense_square * n * n; }
double band_time(double n, const Bandwidth& band) {
  const auto lower = static_cast<double>(band.lower), upper = static_cast<double>(band.upper);
  return n * (band_row + band_diagonal * (lower + upper) +
              band_product * (lower + 1.0) * (lower + upper + 1.0));
}
double sparse_time(double n, const Fill& fill) {
  return sparse_row * n + sparse_entry * fill.entries + sparse_operation * fill.operations;
}
double gmres_time(Index places) { return gmres_place * static_cast<double>(places); }

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
  if (choice.band.total() <= narrow_band) return;
  std::vector<int> position = reverse_cuthill_mckee(places);
  const Bandwidth other = bandwidth(places, position);
  if (static_cast<double>(other.total()) > band_pays * static_cast<double>(choice.band.total()))
    return;
  choice.band = other, choice.position = std::move(position);
}

std::string automatic(const Jacobian& jacobian, Index n, LinearChoice& choice) {
  const Sparsity& places = jacobian.pattern().places;
  choice.solver = LinearSolver::dense;
  const auto size = static_cast<double>(n);
  choice.time = dense_time(size);
  if (n <= few_states) return "few states";
  if (jacobian.pattern().overflow) {
    choice.solver = LinearSolver::gmres;
    return "without a preconditioner: declare the sparsity of the largest blocks for a better one";
  }
  find_band(places, choice);
  const double dense = choice.time, band = band_time(size, choice.band);
  if (band <= dense && choice.band.total() <= narrow_band) {
    choice.solver = LinearSolver::band, choice.time = band;
    return "the band is narrow";
  }
  const Fill fill = predicted_fill(places, most_factor_entries);
  const double sparse = sparse_time(size, fill), direct = std::min({dense, band, sparse});
  choice.time = direct;
  if (direct > gmres_time(places.size())) {
    choice.solver = LinearSolver::gmres;
    return "factors would fill up";
  }
  if (direct == dense) return "nothing gained by leaving out zeros";
  choice.solver = direct == band ? LinearSolver::band : LinearSolver::sparse;
  if (direct == band) return "the band is narrow enough";
  return text("about ", fill.entries, " entries in its factors");
}

void as_asked(const Jacobian& jacobian, Index n, LinearChoice& choice) {
  const Sparsity& places = jacobian.pattern().places;
  const auto size = static_cast<double>(n);
  if (choice.solver == LinearSolver::dense) choice.time = dense_time(size);
  if (jacobian.pattern().overflow) return;
  if (choice.solver == LinearSolver::band) {
    find_band(places, choice);
    choice.time = band_time(size, choice.band);
  }
  if (choice.solver == LinearSolver::sparse)
    choice.time = sparse_time(size, predicted_fill(places, most_factor_entries));
}

}  // namespace

LinearChoice choose_linear_solver(const Jacobian& jacobian, Index n, LinearSolver asked) {
  LinearChoice choice{.solver = asked};
  std::string why = "asked for";
  if (asked == LinearSolver::automatic)
    why = automatic(jacobian, n, choice);
  else
    as_asked(jacobian, n, choice);
  choice.why = text(facts(jacobian, n, choice), "; ", why);
  return choice;
}

}  // namespace saltus
