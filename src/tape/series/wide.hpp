// Wide instructions: one for four alike ones that do not need each other, each in a lane of its own.
//
// A wide row holds the coefficients of four expressions: number 4 k + l is the coefficient of order
// k in lane l. All sums of a recurrence are then sums of whole registers, so there are no blocks of
// orders: with many alike expressions this takes half of the time.
#pragma once

#include "kernels.hpp"

namespace saltus::tape::series {

inline constexpr Index lanes = 4;
inline constexpr Index wide_row_size = lanes * row_size;

struct WideInstruction : Instruction {
  std::array<const Instruction*, lanes> narrow = {};  ///< they know the values and the factor
  std::array<Index, lanes> a_of_lane = {};  ///< places of an operand of which one number is read
};

/// The same kernels for four lanes: `begin` and one function for all orders. The terms of linear
/// ones stand lane by lane; their rows are places of a single lane.
struct WideKernel {
  const Kernel* narrow = nullptr;
  Handler begin = nullptr, order = nullptr;
  bool linear = false;
  bool reads_row_a = false;  ///< all numbers of a
  bool reads_b = false, has_second = false, has_da = false, has_dr = false;
};
/// The wide form of a kernel; null if there is none.
const WideKernel* wide_kernel(const Kernel* narrow);
/// Copies four rows into a wide one.
extern const Handler pack;

/// The program for the rates with wide instructions.
struct Wide {
  std::vector<WideInstruction> instructions;
  std::vector<Term> terms;
  Calls begin, order;
  std::vector<Rate> rates;  ///< their rows are places of a single lane
  Index rows = 0, time = -1;
  Index states = 0;  ///< the first of the rows of the states, four in each

  /// Writes numbers of all states to the places of one order.
  void store_states(const double* x, Index n, double* rows_of_order) const;
};

/// Null if narrow instructions are as quick, or if there is one without a wide kernel.
std::shared_ptr<const Wide> widen(const Program& program);

}  // namespace saltus::tape::series
