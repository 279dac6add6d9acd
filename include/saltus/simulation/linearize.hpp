// linearize: the linear system that a hybrid system is close to one of its states.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "saltus/plan/refinement.hpp"

namespace saltus {

/// An input of a linearisation: an open input of the system by the name of its port, "u", or a
/// dynamic parameter by the name that `sensitivity` takes, "throttle.value". A vector is an input
/// for each entry.
struct LinearInput {
  LinearInput(const char* of) : name(of) {}             // NOLINT(google-explicit-constructor)
  LinearInput(std::string of) : name(std::move(of)) {}  // NOLINT(google-explicit-constructor)
  LinearInput(std::string of, double at)
      : name(std::move(of)), value(Eigen::VectorXd::Constant(1, at)) {}
  LinearInput(std::string of, Eigen::VectorXd at)
      : name(std::move(of)), value(std::move(at)), shape(Shape::of(value->size())) {}
  LinearInput(std::string of, const MatrixByRows& at)
      : name(std::move(of)),
        value(at.reshaped<Eigen::RowMajor>()),
        shape(Shape::matrix(at.rows(), at.cols())) {}

  std::string name;
  /// The value at which the system is linearised. Empty: that of the context, or the value to which
  /// the open input was fixed.
  std::optional<Eigen::VectorXd> value = {};
  Shape shape = {};  ///< of the value: a vector of one entry is no scalar
};

struct LinearizeOptions {
  std::vector<LinearInput> inputs = {};
  /// The outputs by name; empty: all outputs of the system.
  std::optional<RecordedSignals> outputs = {};
  /// At a kink: true takes the derivatives of the present side, false refuses.
  bool one_sided = false;
  /// May give leaves other functions while the plan is made.
  std::shared_ptr<Refinement> refinement = {};
};

/// A value that a linearisation takes as constant, although a run may change it: an entry of a
/// discrete state, a mode, or the truth of a relation (0 or 1).
struct FrozenValue {
  std::string name;  ///< "hold.z[0]", "thermostat.mode", "limiter.above"
  double value = 0.0;
};

/// The value of a guard that can fire in the present mode: its effect sets in when the value crosses
/// zero in its direction. A guard that only watches for an edge is none.
struct GuardValue {
  std::string name;  ///< "thermostat.hot", or "wall.hit[1]" of a vector
  double value = 0.0;
  Direction direction = Direction::crosses_zero;
};

/// dx/dt = f(x, u), y = h(x, u) close to the state x0 with the inputs u0, at a fixed time:
///
///     d(x - x0)/dt = f(x0, u0) + A (x - x0) + B (u - u0)
///     y - y0 = C (x - x0) + D (u - u0)
///
/// with A = df/dx (n by n), B = df/du (n by m), C = dh/dx (k by n), D = dh/du (k by m). Everything
/// in `frozen` is constant.
struct Linearization {
  Eigen::MatrixXd A, B, C, D;
  std::vector<std::string> states, inputs, outputs;  ///< "integrator.x[0]", "u", "y[1]"
  std::vector<FrozenValue> frozen;
  std::vector<GuardValue> guards;
  /// The functions that were differentiated by central differences, because they are called:
  /// "the derivative of block 'plant'". Empty: all derivatives are exact.
  std::vector<std::string> differences;
  double time = 0.0;        ///< [s]
  Eigen::VectorXd x, u, y;  ///< x0, u0 and y0
  Eigen::VectorXd xdot;     ///< f(x0, u0); zero at an equilibrium

  /// The eigenvalues of A [1/s], by increasing real part.
  Eigen::VectorXcd poles() const;
  /// "exact", or the functions that were differentiated by differences.
  std::string method() const;
};

/// The linearisation of a system, block or diagram, at the values of a context. Where functions are
/// formulas or traced, derivatives are exact, by the chain rule over their expressions; a called
/// function has central differences, with an error of about 1e-10 of the derivative.
///
/// Throws ModelError for an unknown name, an open input without a value, a system that keeps a
/// history of a signal, and where no linearisation exists: a guard with an effect is at zero, a
/// relation is at its root and both of its sides differ, a block is at rest, or a derivative is not
/// finite.
Linearization linearize(const System& system, const Context& context,
                        const LinearizeOptions& options = {});

/// The same for many contexts of one system, which is compiled once. The system must outlive it.
class Linearizer {
 public:
  /// Throws ModelError as `linearize` does for the system and the names.
  explicit Linearizer(const System& system, LinearizeOptions options = {});
  ~Linearizer();
  Linearizer(Linearizer&&) noexcept;
  Linearizer& operator=(Linearizer&&) noexcept;

  /// At the values of a context. A parameter among the inputs that was given a value has that value.
  Linearization at(const Context& context);

 private:
  class Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace saltus
