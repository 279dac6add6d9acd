// y = f(u_0, u_1, ...): any C++ callable over all inputs.
// f takes std::span<const double>, for scalar inputs (at most 32), or const Inputs&, for any
// widths. It returns a double, a bool or an Eigen vector. A bool makes an opaque boolean: if it
// reaches a derivative or a reset, it is located by bisection. A Comparator has a smooth guard and
// is faster. A Formula in place of f is fused with its neighbours.
#pragma once

#include "saltus/library/detail/callable.hpp"

namespace saltus {

struct ReduceBlockOptions {
  Shape shape = Shape::scalar();  ///< of the output; needed if f returns a vector: Shape::of(n)
};

class ReduceBlock final : public LeafSystem {
 public:
  using Options = ReduceBlockOptions;

  /// `function` must not change anything: the engine calls it any number of times, in several
  /// threads.
  template <class Function>
    requires(detail::OverScalars<Function> || detail::OverInputs<Function>)
  ReduceBlock(std::string name, int n_inputs, Function function, const Options& options = {})
      : LeafSystem(std::move(name)) {
    using Result = typename detail::ResultOf<Function>::type;
    constexpr bool scalars = detail::OverScalars<Function>;
    detail::require_count(this->name(), "input", n_inputs, 1);
    detail::insist(!scalars || n_inputs <= detail::most_scalars, this->name(),
                   "a function over scalars takes at most ", detail::most_scalars,
                   " inputs, found ", n_inputs, "; write it over `const Inputs&`");
    detail::insist(!detail::Number<Result> || options.shape.size == 1, this->name(),
                   "the function returns one number, ", "Options::shape says ", options.shape.size,
                   "; return an Eigen::VectorXd or leave the shape out");
    for (int k = 0; k < n_inputs; ++k) {
      declare_input_port({.shape = scalars ? std::optional(Shape::scalar()) : std::nullopt});
    }
    declare_output_port({.name = "out",
                         .calc = detail::calculation(this->name(), std::move(function)),
                         .shape = options.shape,
                         .reads = Reads::inputs,
                         .boolean = detail::Truth<Result>});
  }

  /// `formula` computes the `options.shape.size` entries of the output.
  ReduceBlock(std::string name, int n_inputs, Formula formula, const Options& options = {});
};

}  // namespace saltus
