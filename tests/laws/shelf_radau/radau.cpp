#include "radau.hpp"

namespace {

Quad legendre(int n, Quad x) {
  Quad before = 1, now = x;
  for (int k = 2; k <= n; ++k) {
    const Quad next = ((2 * k - 1) * x * now - (k - 1) * before) / k;
    before = now, now = next;
  }
  return n == 0 ? before : now;
}

Quad bisect(const std::function<Quad(Quad)>& g, Quad low, Quad high) {
  const bool below = g(low) < 0;
  for (int i = 0; i < 115; ++i) {
    const Quad middle = (low + high) / 2;
    ((g(middle) < 0) == below ? low : high) = middle;
  }
  return (low + high) / 2;
}

/// The value at x of the polynomial that is 1 in node k and 0 in the others.
Quad lagrange(const Vector& nodes, std::size_t k, Quad x) {
  Quad product = 1;
  for (std::size_t j = 0; j < nodes.size(); ++j)
    if (j != k) product *= (x - nodes[j]) / (nodes[k] - nodes[j]);
  return product;
}

/// Its integral from 0 to x, by its coefficients: the product is expanded one factor at a time.
Quad lagrange_integral(const Vector& nodes, std::size_t k, Quad x) {
  Vector monomials{1};
  for (std::size_t j = 0; j < nodes.size(); ++j) {
    if (j == k) continue;
    const Quad scale = 1 / (nodes[k] - nodes[j]);
    monomials.push_back(0);
    for (std::size_t i = monomials.size(); i-- > 0;)
      monomials[i] = scale * ((i > 0 ? monomials[i - 1] : 0) - nodes[j] * monomials[i]);
  }
  Quad sum = 0, power = x;
  for (std::size_t i = 0; i < monomials.size(); ++i, power *= x)
    sum += monomials[i] * power / static_cast<int>(i + 1);
  return sum;
}

Vector with_zero(const Vector& c) {
  Vector nodes{0};
  nodes.insert(nodes.end(), c.begin(), c.end());
  return nodes;
}

}  // namespace

Tableau::Tableau(int s) : s(s) {
  const auto g = [s](Quad x) { return legendre(s, 2 * x - 1) - legendre(s - 1, 2 * x - 1); };
  const int parts = 4000;
  for (int i = 0; i < parts - 1; ++i) {
    const Quad low = Quad(i) / parts, high = Quad(i + 1) / parts;
    if ((g(low) < 0) != (g(high) < 0)) c.push_back(bisect(g, low, high));
  }
  c.push_back(1);
  if (c.size() != static_cast<std::size_t>(s)) throw std::logic_error("Radau: nodes not found");
  for (const Quad node : c) {
    a.emplace_back();
    for (std::size_t k = 0; k < c.size(); ++k) a.back().push_back(lagrange_integral(c, k, node));
  }
  const Vector nodes = with_zero(c);
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    Quad product = 1;
    for (std::size_t j = 0; j < nodes.size(); ++j)
      if (j != k) product *= nodes[k] - nodes[j];
    leading.push_back(1 / product);
  }
}

Radau::Radau(const Problem& problem, int stages, double tolerance, bool tangents)
    : problem_(problem),
      tableau_(stages),
      differences_(problem),
      newton_(tableau_),
      tolerance_(tolerance),
      tangents_(tangents),
      h_(problem.first_step),
      y_(problem.start),
      states_{problem.start},
      roots_(problem.guards.size()) {}

/// d(state after the step) / d(state before it), by the Jacobian of each stage.
Matrix Radau::propagator(Quad h, const Stages& stages) const {
  const Eigen::Index n = static_cast<Eigen::Index>(y_.size()), s = tableau_.s;
  std::vector<Eigen::Triplet<double>> entries;
  for (Eigen::Index i = 0; i < s * n; ++i) entries.emplace_back(i, i, 1.0);
  for (Eigen::Index b = 0; b < s; ++b) {
    const Sparse jacobian = differences_(t_ + tableau_.c[b] * h, stages[b]);
    for (Eigen::Index j = 0; j < n; ++j)
      for (Sparse::InnerIterator e(jacobian, j); e; ++e)
        for (Eigen::Index a = 0; a < s; ++a)
          entries.emplace_back(
              a * n + e.row(), b * n + j,
              -static_cast<double>(h * tableau_.a[a][b]) * static_cast<double>(e.value()));
  }
  Eigen::SparseMatrix<double> all(s * n, s * n);
  all.setFromTriplets(entries.begin(), entries.end());
  Eigen::SparseLU<Eigen::SparseMatrix<double>> lu(all);
  const Eigen::MatrixXd start = Eigen::MatrixXd::Identity(n, n).replicate(s, 1);
  return Eigen::MatrixXd(lu.solve(start)).bottomRows(n).cast<long double>();
}

/// The polynomial of the step before, continued.
Radau::Stages Radau::predict(Quad h) const {
  Stages stages(tableau_.s, y_);
  if (last_.empty()) return stages;
  const Vector nodes = with_zero(tableau_.c);
  for (int i = 0; i < tableau_.s; ++i) {
    const Quad x = 1 + tableau_.c[i] * h / last_h_;
    if (x > 4) continue;
    std::fill(stages[i].begin(), stages[i].end(), Quad(0));
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      const Quad weight = lagrange(nodes, k, x);
      const Vector& from = k == 0 ? last_y_ : last_[k - 1];
      for (std::size_t j = 0; j < y_.size(); ++j) stages[i][j] += weight * from[j];
    }
  }
  return stages;
}

bool Radau::solve(Quad h, Stages& stages) {
  const std::size_t n = y_.size(), s = static_cast<std::size_t>(tableau_.s);
  newton_.factorise(h, differences_(t_ + tableau_.c[0] * h, y_));  // behind a jump of the data
  stages = predict(h);
  Stages f(s, Vector(n));
  Matrix residual(n, s);
  Quad before = 1e30Q;
  for (int iteration = 0, slow = 0; iteration < 60; ++iteration) {
    for (std::size_t i = 0; i < s; ++i) problem_.f(t_ + tableau_.c[i] * h, stages[i], f[i]);
    for (std::size_t i = 0; i < s; ++i)
      for (std::size_t k = 0; k < n; ++k) {
        Quad r = y_[k] - stages[i][k];
        for (std::size_t j = 0; j < s; ++j) r += h * tableau_.a[i][j] * f[j][k];
        residual(k, i) = static_cast<long double>(r);
      }
    residual = newton_.solve(residual);
    Quad worst = 0;
    for (std::size_t i = 0; i < s; ++i)
      for (std::size_t k = 0; k < n; ++k) {
        const Quad change = residual(k, i);
        stages[i][k] += change;
        const Quad size = problem_.atol + fabsq(y_[k]) + fabsq(stages[i][k]);
        if (!(fabsq(change) / size <= worst)) worst = fabsq(change) / size;
      }
    if (!(worst < 1e10Q)) return false;
    if (worst < 1e-31Q) return true;
    if (worst > before * 0.8Q) {
      if (worst < 1e-27Q) return true;
      if (++slow > 3) return false;
    }
    before = worst;
  }
  return before < 1e-26Q;
}

Quad Radau::error(const Stages& stages) const {
  Quad worst = 0;
  const Quad monic =
      2 * powq(4, -tableau_.s);  // the size of a monic Chebyshev polynomial on [0, 1]
  for (std::size_t k = 0; k < y_.size(); ++k) {
    Quad difference = tableau_.leading[0] * y_[k];
    for (int i = 0; i < tableau_.s; ++i) difference += tableau_.leading[i + 1] * stages[i][k];
    const Quad size = problem_.atol + std::max(fabsq(y_[k]), fabsq(stages.back()[k]));
    worst = std::max(worst, fabsq(difference) * monic / size);
  }
  return worst;
}

/// The root of a guard within the step, by bisection: to ever better ends of steps of the method
/// itself, down to 1e-24 of the time.
void Radau::locate(std::size_t guard, Quad h) {
  const bool below = problem_.guards[guard](y_) < 0;
  Quad low = 0, high = h;
  while (high - low > 1e-24Q * (t_ + high)) {
    const Quad middle = (low + high) / 2;
    Stages stages;
    if (!solve(middle, stages)) throw std::runtime_error("Radau: a step to a root failed");
    ((problem_.guards[guard](stages.back()) < 0) == below ? low : high) = middle;
  }
  roots_[guard].push_back(t_ + (low + high) / 2);
}

void Radau::accept(Quad h, const Stages& stages) {
  if (tangents_) propagators_.push_back(propagator(h, stages));
  last_ = stages, last_y_ = y_, last_h_ = h;
  t_ += h, y_ = stages.back();
  states_.push_back(y_);
}

void Radau::advance_to(Quad end) {
  while (t_ < end) {
    const bool last = t_ + h_ * 1.0000001Q >= end;
    const Quad h = last ? end - t_ : h_;
    Stages stages;
    if (!solve(h, stages)) {
      if ((h_ = h / 4) < 1e-40Q) throw std::runtime_error("Radau: stuck at t = " + text(t_));
      continue;
    }
    const double ratio = static_cast<double>(error(stages) / tolerance_);
    const double factor = ratio > 0 ? std::min(3.0, 0.9 * std::pow(ratio, -1.0 / tableau_.s)) : 3.0;
    if (factor < 0.8) {
      h_ = h * std::max(0.2, factor);
      continue;
    }
    for (std::size_t g = 0; g < roots_.size(); ++g)
      if ((problem_.guards[g](y_) < 0) != (problem_.guards[g](stages.back()) < 0)) locate(g, h);
    accept(h, stages);
    if (last) t_ = end;
    h_ = last ? std::max(h_, h * factor) : h * factor;
  }
}

double Radau::growth(double ratio, const std::vector<std::size_t>& marks) const {
  long double worst = 1;
  const auto scales = [&](const Vector& y) {
    Eigen::Vector<long double, Eigen::Dynamic> w(y.size());
    for (std::size_t i = 0; i < y.size(); ++i) w[i] = ratio + fabsl(static_cast<long double>(y[i]));
    return w;
  };
  for (const std::size_t mark : marks) {
    Matrix product = Matrix::Identity(y_.size(), y_.size());
    for (std::size_t k = mark; k-- > 0;) {
      product = product * propagators_[k];
      worst = std::max(worst, (product.cwiseAbs() * scales(states_[k]))
                                  .cwiseQuotient(scales(states_[mark]))
                                  .maxCoeff());
    }
  }
  return static_cast<double>(worst);
}
