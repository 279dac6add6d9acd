// dx/dt = A x + B u, y = C x + D u: a linear system with constant coefficients.
#include "saltus/library/lti_system.hpp"

namespace saltus {

namespace {

/// Entry i of M v, where `v(j)` is entry j of a vector of `columns` numbers.
template <class At, class Entry>
auto entry_of_product(const At& at, ParameterIndex matrix, Index columns, Index i, Entry v) {
  auto sum = at.p(matrix, i * columns) * v(0);
  for (Index j = 1; j < columns; ++j) sum += at.p(matrix, i * columns + j) * v(j);
  return sum;
}

}  // namespace

LTISystem::LTISystem(std::string name, const Matrices& matrices, const Options& options)
    : LeafSystem(std::move(name)) {
  detail::require_sizes(this->name(), matrices, options);
  const detail::LTIParameters k(matrices,
                                [this](const char* parameter, const Eigen::VectorXd& values) {
                                  return declare_dynamic_parameter(parameter, values);
                                });
  const Index n = matrices.A.rows(), inputs = matrices.B.cols(), outputs = matrices.C.rows();
  const auto signal = [](Index size) { return size == 1 ? Shape::scalar() : Shape::of(size); };
  declare_input_port({.name = "in", .shape = signal(inputs)});
  declare_continuous_state(
      {.initial = options.initial_state.value_or(Eigen::VectorXd::Zero(n)),
       .reads = Reads::continuous_state | Reads::inputs,
       .formula = [=](const auto& at, Index i) {
         return entry_of_product(at, k.a, n, i, [&](Index j) { return at.x(j); }) +
                entry_of_product(at, k.b, inputs, i, [&](Index j) { return at.u(0, j); });
       }});
  declare_output_port(
      {.name = "out",
       .shape = signal(outputs),
       .reads = k.d ? Reads::continuous_state | Reads::inputs : Reads::continuous_state,
       .inputs = k.d ? std::vector{0} : std::vector<int>{},
       .formula = [=](const auto& at, Index i) {
         auto y = entry_of_product(at, k.c, n, i, [&](Index j) { return at.x(j); });
         if (k.d) y += entry_of_product(at, *k.d, inputs, i, [&](Index j) { return at.u(0, j); });
         return y;
       }});
}

namespace detail {

void require_sizes(const std::string& block, const LTISystemMatrices& m,
                   const LTISystemOptions& options) {
  const Index n = m.A.rows();
  const auto sized = [&](const char* what, const Eigen::MatrixXd& found, Index rows,
                         Index columns) {
    insist(found.rows() == rows && found.cols() == columns, block, what, " is ", found.rows(),
           " x ", found.cols(), "; expected ", rows, " x ", columns, ", as A, B and C say");
  };
  insist(n > 0 && m.B.cols() > 0 && m.C.rows() > 0, block,
         "A, B or C is empty; expected a state, an input and an output or more");
  sized("A", m.A, n, n);
  sized("B", m.B, n, m.B.cols());
  sized("C", m.C, m.C.rows(), n);
  if (m.D) sized("D", *m.D, m.C.rows(), m.B.cols());
  const Index found = options.initial_state ? options.initial_state->size() : n;
  insist(found == n, block, "initial_state has ", found, " values; expected ", n,
         ", one for each row of A");
}

Eigen::VectorXd by_rows(const Eigen::MatrixXd& matrix) {
  const Eigen::MatrixXd transposed = matrix.transpose();
  return transposed.reshaped();
}

}  // namespace detail

}  // namespace saltus
