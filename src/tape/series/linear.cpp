// Sums, differences and multiples.
#include "kernel.hpp"

namespace saltus::tape::series {

namespace {

#define SALTUS_SERIES_AT                                                                       \
  static double at([[maybe_unused]] const Instruction& i, [[maybe_unused]] const double* rows, \
                   [[maybe_unused]] const double* own, [[maybe_unused]] const double* values,  \
                   [[maybe_unused]] Index k)

struct Sum : Plain<Sum> {
  SALTUS_SERIES_AT { return rows[i.a + k] + rows[i.b + k]; }
};
struct Difference : Plain<Difference> {
  SALTUS_SERIES_AT { return rows[i.a + k] - rows[i.b + k]; }
};
struct Multiple : Plain<Multiple> {
  SALTUS_SERIES_AT { return rows[i.a + k] * values[i.of_b]; }
};
struct Combination : Plain<Combination> {
  SALTUS_SERIES_AT {
    double sum = 0.0;
    for (const Term& term : std::span(i.term, static_cast<std::size_t>(i.terms))) {
      sum += values[term.factor] * rows[term.row + k];
    }
    return sum;
  }
};

}  // namespace

const Kernel plus = kernel<Sum>();
const Kernel minus = kernel<Difference>();
const Kernel multiple = kernel<Multiple>();
const Kernel combination = kernel<Combination>();

}  // namespace saltus::tape::series
