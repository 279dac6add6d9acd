// Elimination for few states, unrolled. This file is compiled without vectors: a pair would be
// loaded before the two stores of its numbers are done, and four states would take twice the time
// (bench/factorisations).
#include <utility>

#include "elimination.hpp"
#include "saltus/solver/detail/linear_thresholds.hpp"

namespace saltus {

template <class T>
std::unique_ptr<FactorisationOf<T>> make_unrolled(int n) {
  std::unique_ptr<FactorisationOf<T>> result;
  [n, &result]<int... i>(std::integer_sequence<int, i...>) {
    (void)((n == i + 1 && (result = std::make_unique<Elimination<i + 1, T>>(n), true)) || ...);
  }(std::make_integer_sequence<int, thresholds::unrolled_dense>());
  return result;
}
template std::unique_ptr<FactorisationOf<double>> make_unrolled(int);
template std::unique_ptr<FactorisationOf<Complex>> make_unrolled(int);

}  // namespace saltus
