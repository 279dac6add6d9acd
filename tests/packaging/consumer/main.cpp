// A user's program in two files: the height of a falling ball, simulated and exact.
#include <cmath>
#include <cstdio>

#include <saltus/analysis.hpp>
#include <saltus/saltus.hpp>

double simulated_height(
    double time);  // other.cpp includes saltus too: nothing may be defined twice
double found_weight();

int main() {
  const double expected = 10.0 - 0.5 * 9.81;
  const double height = simulated_height(1.0);
  std::printf("height after 1 s: %.12f m, expected %.12f m\n", height, expected);
  const double weight = found_weight();
  std::printf("a body of 2 kg weighs %.12f N, expected %.12f N\n", weight, 2.0 * 9.81);
  return std::abs(height - expected) < 1e-8 && std::abs(weight - 2.0 * 9.81) < 1e-8 ? 0 : 1;
}
