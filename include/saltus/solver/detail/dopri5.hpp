// The coefficients of DOPRI5: order 5, error estimate of order 4, free dense output of order 4.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

namespace saltus {

/// J. R. Dormand and P. J. Prince, "A family of embedded Runge-Kutta formulae", J. Comput. Appl.
/// Math. 6 (1980), p. 23, table 2; as RK5(4)7M in E. Hairer, S. P. Norsett, G. Wanner, "Solving
/// Ordinary Differential Equations I", 2nd ed., p. 178, table 5.2. Dense output: same book, p. 192,
/// (6.12), in the form of the authors' code DOPRI5.
struct Dopri5 {
  static constexpr const char* name = "dopri5";
  static constexpr std::size_t stages = 7;
  static constexpr std::size_t rows = stages;  ///< the dense output is free
  static constexpr double error_order = 5.0;
  static constexpr double stability = 3.25;  ///< Hairer, Wanner II, p. 22: detection threshold
  /// |R(iy)| > 1 from y = 1.0 on; the error estimate of exp(iy) is 1 / 1200 there.
  static constexpr double imaginary = 1.0, amplitude = 1200.0;
  static constexpr double beta = 0.04, shortest = 0.2, longest = 10.0;  ///< of the code DOPRI5

  static constexpr std::array<double, stages> c{0.0, 1.0 / 5, 3.0 / 10, 4.0 / 5, 8.0 / 9, 1.0, 1.0};
  static constexpr std::array<std::array<double, stages>, stages> a{{
      {},
      {1.0 / 5},
      {3.0 / 40, 9.0 / 40},
      {44.0 / 45, -56.0 / 15, 32.0 / 9},
      {19372.0 / 6561, -25360.0 / 2187, 64448.0 / 6561, -212.0 / 729},
      {9017.0 / 3168, -355.0 / 33, 46732.0 / 5247, 49.0 / 176, -5103.0 / 18656},
      {35.0 / 384, 0.0, 500.0 / 1113, 125.0 / 192, -2187.0 / 6784, 11.0 / 84},
  }};
  static constexpr std::array<std::array<double, stages>, 1> e{{
      {71.0 / 57600, 0.0, -71.0 / 16695, 71.0 / 1920, -17253.0 / 339200, 22.0 / 525, -1.0 / 40},
  }};
  static constexpr std::array<std::array<double, stages>, 1> d{
      {{-12715105075.0 / 11282082432.0, 0.0, 87487479700.0 / 32700410799.0,
        -10690763975.0 / 1880347072.0, 701980252875.0 / 199316789632.0, -1453857185.0 / 822651844.0,
        69997945.0 / 29380423.0}}};

  static double error(const std::array<double, 1>& squares) { return std::sqrt(squares[0]); }
};

}  // namespace saltus
