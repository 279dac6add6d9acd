#include "newton.hpp"

Differences::Differences(const Problem& problem) : problem_(problem) {
  find_rows();
  find_groups();
}

/// The rows that a change of each column reaches, about a state without zeros or equal entries.
void Differences::find_rows() {
  const std::size_t n = problem_.start.size();
  Vector y = problem_.start, f(n), moved_f(n);
  for (std::size_t j = 0; j < n; ++j) {
    const Quad shift = (1 + sinq(Quad(7 * j + 1))) / 3;
    y[j] += shift * (fabsq(y[j]) + problem_.first_step);
  }
  const Quad t = problem_.first_step;
  problem_.f(t, y, f);
  rows_.resize(n);
  for (std::size_t j = 0; j < n; ++j) {
    const Quad kept = y[j];
    y[j] += kept / 16 + problem_.atol;
    problem_.f(t, y, moved_f);
    for (std::size_t i = 0; i < n; ++i)
      if (i == j || moved_f[i] != f[i]) rows_[j].push_back(static_cast<Eigen::Index>(i));
    y[j] = kept;
  }
}

void Differences::find_groups() {
  std::vector<std::vector<bool>> taken;
  for (std::size_t j = 0; j < rows_.size(); ++j) {
    std::size_t g = 0;
    const auto meets = [&](const std::vector<bool>& rows) {
      for (const Eigen::Index i : rows_[j])
        if (rows[static_cast<std::size_t>(i)]) return true;
      return false;
    };
    while (g < taken.size() && meets(taken[g])) ++g;
    if (g == taken.size()) {
      taken.emplace_back(rows_.size(), false);
      groups_.emplace_back();
    }
    for (const Eigen::Index i : rows_[j]) taken[g][static_cast<std::size_t>(i)] = true;
    groups_[g].push_back(static_cast<Eigen::Index>(j));
  }
}

Sparse Differences::operator()(Quad t, const Vector& y) const {
  const std::size_t n = y.size();
  Vector f(n), moved_f(n), moved = y;
  problem_.f(t, y, f);
  std::vector<Eigen::Triplet<long double>> entries;
  for (const auto& group : groups_) {
    for (const Eigen::Index k : group) {
      const auto j = static_cast<std::size_t>(k);
      moved[j] += Quad(1e-17) * (fabsq(y[j]) + problem_.atol);
    }
    problem_.f(t, moved, moved_f);
    for (const Eigen::Index k : group) {
      const auto j = static_cast<std::size_t>(k);
      for (const Eigen::Index row : rows_[j]) {
        const auto i = static_cast<std::size_t>(row);
        const Quad slope = (moved_f[i] - f[i]) / (moved[j] - y[j]);
        entries.emplace_back(row, k, static_cast<long double>(slope));
      }
      moved[j] = y[j];
    }
  }
  Sparse out(static_cast<Eigen::Index>(n), static_cast<Eigen::Index>(n));
  out.setFromTriplets(entries.begin(), entries.end());
  return out;
}

Newton::Newton(const Tableau& tableau) {
  const Eigen::Index s = tableau.s;
  Matrix a(s, s);
  for (Eigen::Index i = 0; i < s; ++i)
    for (Eigen::Index j = 0; j < s; ++j) a(i, j) = static_cast<long double>(tableau.a[i][j]);
  const Eigen::EigenSolver<Matrix> eigen(a);
  values_ = eigen.eigenvalues(), vectors_ = eigen.eigenvectors(), inverse_ = vectors_.inverse();
  for (Eigen::Index k = 0; k < s; ++k)
    if (values_[k].imag() >= 0) kept_.push_back(k);
  for (std::size_t k = 0; k < kept_.size(); ++k)
    lu_.push_back(std::make_unique<Eigen::SparseLU<ComplexSparse>>());
}

void Newton::factorise(Quad h, const Sparse& jacobian) {
  ComplexSparse identity(jacobian.rows(), jacobian.cols());
  identity.setIdentity();
  for (std::size_t k = 0; k < kept_.size(); ++k) {
    const Complex scale = values_[kept_[k]] * static_cast<long double>(h);
    ComplexSparse matrix = identity - ComplexSparse(jacobian.cast<Complex>() * scale);
    matrix.makeCompressed();
    lu_[k]->compute(matrix);
  }
}

Matrix Newton::solve(const Matrix& residual) const {
  Matrix out = Matrix::Zero(residual.rows(), residual.cols());
  for (std::size_t k = 0; k < kept_.size(); ++k) {
    const Eigen::Index e = kept_[k];
    const ComplexMatrix right = residual.cast<Complex>() * inverse_.row(e).transpose();
    const ComplexMatrix found = lu_[k]->solve(right);
    const long double pair = values_[e].imag() > 0 ? 2 : 1;
    out += pair * (found * vectors_.col(e).transpose()).real();
  }
  return out;
}
