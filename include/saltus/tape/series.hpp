// Series: the Taylor coefficients of the solution of an ODE, from the expressions of its rates.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "saltus/base/view.hpp"
#include "saltus/tape/graph.hpp"

namespace saltus::tape {

namespace series {
struct Program;
}  // namespace series

/// A series to one order, for `compile` of machine_code.hpp. It is cheap to copy.
struct SeriesOrder {
  std::shared_ptr<const series::Program> program;
  int order = 0;

  /// Whether an expansion of the states to this order runs as machine code.
  bool is_machine_code() const noexcept;
  /// The instructions that an expansion of the states interprets, over all orders.
  double instruction_count() const noexcept;
};

/// The Taylor coefficients of the solution of xdot = f(t, x), and of other functions of t and x
/// along it.
///
/// The coefficient of order k of a function u(t) is u^(k)(t) / k!. Each operation has a recurrence
/// for the coefficient of order k of its result, from those of lower orders and those of its
/// operands (A. Jorba, M. Zou, A software package for the numerical integration of ODEs by means of
/// high-order Taylor methods, Exp. Math. 14 (2005) 99; A. Griewank, A. Walther, Evaluating
/// Derivatives, 2nd ed., SIAM 2008, section 13.2). Values, which are the coefficients of order 0,
/// have the bits that a tape computes.
///
/// At a kink the branch is that of the time just after the point: abs, minimum, maximum, and a
/// select by a comparison whose two values are equal there, decide by the first coefficients that
/// differ. Apart from that, steps (floor, sign, comparisons and the like) are constants, and
/// select, copysign, mod and fmod have the branch of the value. Where an operation has no Taylor
/// series (sqrt at 0, hypot at the origin, pow(0, 1.5), a division by 0) coefficients are infinite
/// or NaN.
///
/// A Series owns scratch memory, so one thread uses it at a time. A copy shares the list of
/// instructions, which never changes, and has its own memory.
class Series {
 public:
  static constexpr int highest_order = 30;

  /// `rates[i]` is xdot_i, an expression of `graph`; state i is graph.continuous_state(i).
  /// `outputs` are further expressions, such as guards. ModelError if an expression reads a state
  /// that has no rate.
  Series(const Graph& graph, std::span<const Node> rates, std::span<const Node> outputs);

  /// Writes the coefficients of orders 0 ... `order` of every state at (at.time, at.x): row k of
  /// `x` is x[k * states()] ..., so `x` has (order + 1) * states() numbers and must not overlap the
  /// arrays of `at`. Inputs, parameters, discrete states, mode and entry are constant in time.
  /// State i has the rate 0 if held[i] is not 0; a null pointer holds none. ModelError unless
  /// `order` is from 0 to `highest_order`. Nothing is allocated.
  void expand(const At& at, int order, const char* held, double* x);

  /// After `expand`: the coefficients of outputs first ... first + count - 1, to the order of that
  /// expansion: row m of `g` is g[m * (order + 1)] .... Outputs that nobody asks for cost nothing,
  /// and a value that several outputs need is computed once for each expansion. ModelError if there
  /// are not so many outputs.
  void expand_outputs(int first, int count, double* g);

  int states() const noexcept;
  int outputs() const noexcept;
  /// The number of instructions for each order of the states. Four alike instructions count as one
  /// if they are computed together.
  int instruction_count() const noexcept;
  SeriesOrder at_order(int order) const { return {program_, order}; }

 private:
  void load(const At& at);
  bool run_code(const char* held, double* x);
  bool run_outputs_code();
  void interpret_outputs(int first, int count);
  void copy_states(const double* x);
  void compute_values(int first, int last);
  void expand_narrow(const char* held, double* x);
  void expand_wide(const char* held, double* x);
  void hold(const char* held, int k, double* x);
  void require(int output);
  void run(const std::vector<int>& instructions, int k);

  std::shared_ptr<const series::Program> program_;
  std::vector<double> values_, rows_, sums_;   ///< of expressions, rows, instructions
  std::vector<std::int64_t> computed_, done_;  ///< last expansion of each value, instruction
  std::vector<int> late_, open_;               ///< instructions without the last order; without any
  std::int64_t expansion_ = 0;                 ///< the number of the last expansion
  int order_ = 0;                              ///< of the last expansion
  std::int64_t all_outputs_ = 0;  ///< the last expansion of which machine code computed the outputs
};

/// The operations in `nodes` and their operands that have no Taylor series where a state may pass:
/// kinks (abs, minimum, maximum, select, mod, fmod, copysign) and steps (floor, ceil, trunc, rint,
/// sign, floor_divide, comparisons, logical operations). An operation counts only if an operand
/// depends on time or on a continuous state, a select only if its condition does. Each is listed
/// once, in the order of `Op`. The list is empty if all is smooth.
std::vector<Op> kinks(const Graph& graph, std::span<const Node> nodes);

/// Whether `nodes` may be zero within the rounding at a point, with all derivatives, and large
/// elsewhere: a pulse such as exp(-100 (t - 13)^2) at t = 0. Neither their values nor their series
/// show that the pulse will come. A list of operations cannot prove the absence of such a pulse, so
/// the answer "no" is not certain: sqrt((t - 0.3)^2) has a kink that no series at 0 shows.
bool may_hide(const Graph& graph, std::span<const Node> nodes);

}  // namespace saltus::tape
