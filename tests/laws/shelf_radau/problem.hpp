// What the references are computed of: numbers of 34 digits, an equation, where it starts, when its
// state is wanted, and the tableau of the method.
#pragma once

#include <quadmath.h>

#include <functional>
#include <string>
#include <vector>

#include <Eigen/Dense>
#include <Eigen/SparseLU>

using Quad = __float128;
using Vector = std::vector<Quad>;
using Matrix = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;
using Sparse = Eigen::SparseMatrix<long double>;
using Equation = std::function<void(Quad t, const Vector& y, Vector& dydt)>;
using Guard = std::function<Quad(const Vector& y)>;

inline Quad number(const std::string& text) { return strtoflt128(text.c_str(), nullptr); }
inline std::string text(Quad x, int digits = 20) {
  char out[96];
  quadmath_snprintf(out, sizeof out, ("%." + std::to_string(digits) + "Qg").c_str(), x);
  return out;
}

/// Nodes c, matrix A, and the weights of the divided difference over 0, c_1, ..., c_s.
struct Tableau {
  explicit Tableau(int s);
  int s;
  Vector c, leading;
  std::vector<Vector> a;
};

struct Problem {
  Equation f;
  Vector start;
  std::vector<Quad> times;
  Quad first_step;
  Quad atol;           ///< of the size that errors are measured against, atol + |y|
  double ratio = 1.0;  ///< atol / rtol of the scene, for the growth
  std::vector<Guard> guards = {};
};
