// Choice, layout, and search for places that were missed.
#include "structure.hpp"

#include <utility>

#include "saltus/base/list.hpp"
#include "saltus/solver/detail/linear_thresholds.hpp"
#include "saltus/solver/detail/matrix_cost.hpp"
#include "scalar.hpp"

namespace saltus {

LinearStructure::LinearStructure(Machine& machine, const SolverOptions& options, double t,
                                 const double* x)
    : machine_(&machine), options_(options), probe_(machine) {
  if (options.find_sparsity) probe_.look(t, x);
  build();
}

void LinearStructure::build() {
  const bool distrusted = jacobian_ && jacobian_->distrusted();
  jacobian_.emplace(*machine_, probe_.found());
  if (distrusted) jacobian_->distrust();
  choice_ = choose_linear_solver(*jacobian_, machine_->plan().nx, options_.linear_solver);
  words_.clear();
  if (direct()) lay_out();
}

void LinearStructure::lay_out() {
  if (jacobian_->pattern().overflow) jacobian_->fill_up();
  const Sparsity& places = jacobian_->pattern().places;
  if (choice_.solver == LinearSolver::dense)
    layout_ = dense_layout(places);
  else if (choice_.solver == LinearSolver::band)
    layout_ = band_layout(places, choice_.band, choice_.position);
  else
    layout_ = sparse_layout(places);
  jacobian_->store_at(std::move(layout_.places));
}

template <class T>
std::unique_ptr<FactorisationOf<T>> LinearStructure::make_factorisation() const {
  const Index n = machine_->plan().nx;
  if (choice_.solver == LinearSolver::dense) return make_dense<T>(n);
  if (choice_.solver == LinearSolver::band) return make_band<T>(n, choice_.band, choice_.position);
  return make_sparse<T>(jacobian_->pattern().places);
}
template std::unique_ptr<FactorisationOf<double>> LinearStructure::make_factorisation() const;
template std::unique_ptr<FactorisationOf<Complex>> LinearStructure::make_factorisation() const;

Increments LinearStructure::increments(double h) const {
  return {.rtol = options_.rtol,
          .atol = options_.atol,
          .h = h,
          .rtols = options_.each_rtol(),
          .atols = options_.each_atol()};
}

bool LinearStructure::misses_places(double t, const double* x, const double* xdot,
                                    const Increments& by, const double* values) {
  if (probe_.found().empty() || --until_check_ > 0) return false;
  const bool explained = jacobian_->explains(t, x, xdot, by, values);
  news_ = !explained && probe_.look(t, x);
  if (!explained && !news_) wait_ *= 2;
  until_check_ = wait_;
  return news_;
}

bool LinearStructure::renew(bool did_not_converge) {
  const bool failed = did_not_converge && !probe_.found().empty();
  if (!std::exchange(news_, false) && !failed) return false;
  if (failed)
    probe_.give_up("Newton's iteration did not converge with what was found");
  else if (++renewals_ > thresholds::most_renewals)
    probe_.give_up(text("others were missing ", thresholds::most_renewals, " times"));
  build();
  return true;
}

const std::string& LinearStructure::describe() const {
  const int mended = jacobian_->mended();
  if (std::exchange(mended_in_words_, mended) != mended || words_.empty()) {
    words_ = text(nth(linear_solver_names, choice_.solver).first, ": ", choice_.why, probe_.words(),
                  jacobian_->words());
  }
  return words_;
}

MatrixCost matrix_cost(Machine& machine, const SolverOptions& options, double t,
                       const Eigen::VectorXd& x) {
  const LinearStructure structure(machine, options, t, x.data());
  return {structure.direct(), structure.choice().time};
}

}  // namespace saltus
