// The arithmetic of a factorisation for real and complex numbers.
#pragma once

#include <cmath>
#include <complex>

namespace saltus {

// The operators of std::complex treat products that overflow apart, which costs a branch each.
// Pivots need a size, not the modulus (LAPACK's cabs1).

using Complex = std::complex<double>;

inline double size_of(double a) { return std::abs(a); }
inline double size_of(const Complex& a) { return std::abs(a.real()) + std::abs(a.imag()); }

inline double product(double a, double b) { return a * b; }
inline Complex product(const Complex& a, const Complex& b) {
  return {a.real() * b.real() - a.imag() * b.imag(), a.real() * b.imag() + a.imag() * b.real()};
}

inline double reciprocal(double a) { return 1.0 / a; }
inline Complex reciprocal(const Complex& a) { return 1.0 / a; }

}  // namespace saltus
