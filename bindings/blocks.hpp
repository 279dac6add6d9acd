// Helpers shared by the bindings of blocks.
#pragma once

#include <pybind11/stl.h>

#include "numbers.hpp"
#include "saltus/library/detail/words.hpp"

namespace saltus::python {

/// Converts the arguments of one block to numbers; messages name the block and the argument.
class Arguments {
 public:
  explicit Arguments(std::string block) : block_(std::move(block)) {}
  Value value(py::handle numbers, std::string_view name) const {
    return to_value(numbers, what(name));
  }
  /// A number counts as a vector of one entry.
  Eigen::VectorXd vector(py::handle numbers, std::string_view name) const {
    Value value = this->value(numbers, name);
    if (value.shape().is_matrix())
      throw ModelError(text(what(name), ": expected a number or a vector, found a matrix of shape ",
                            to_string(value.shape())));
    return std::move(value.values);
  }
  std::optional<Value> optional(py::handle numbers, std::string_view name) const {
    return to_optional_value(numbers, what(name));
  }
  /// A vector of numbers, if there is one.
  std::optional<Eigen::VectorXd> optional_vector(py::handle numbers, std::string_view name) const {
    return numbers.is_none() ? std::nullopt : std::optional(vector(numbers, name));
  }

  /// A matrix; a vector counts as its only column.
  Eigen::MatrixXd columns(py::handle numbers, std::string_view name) const {
    const Array array = to_array(numbers, what(name));
    if (array.ndim() == 1) return as_vector(array);
    return matrix(numbers, name);
  }

  /// A matrix; a number counts as one of a single entry.
  Eigen::MatrixXd matrix(py::handle numbers, std::string_view name) const {
    const Array array = to_array(numbers, what(name));
    if (array.ndim() == 0) return Eigen::MatrixXd::Constant(1, 1, *array.data());
    if (array.ndim() != 2)
      throw ModelError(
          text(what(name), ": expected a matrix, found an array of ", array.ndim(), " dimensions"));
    using ByRows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    return Eigen::Map<const ByRows>(array.data(), array.shape(0), array.shape(1));
  }

 private:
  std::string what(std::string_view name) const { return text("block '", block_, "': ", name); }
  std::string block_;
};

void bind_discrete_linear(py::module_& module);
void bind_mechanics(py::module_& module);
void bind_signals(py::module_& module);
void bind_subsystems(py::module_& module);

/// The edge with this name; a ModelError with the nearest name if there is none.
inline Edge edge_from(const std::string& block, std::string_view edge) {
  constexpr std::pair<std::string_view, Edge> edges[] = {
      {"rising", Edge::rising}, {"falling", Edge::falling}, {"either", Edge::either}};
  return detail::meaning(block, "edge", edge, edges);
}

/// The execution of a controlled part; a ModelError with the nearest name for an unknown word.
inline Execution execution_from(const std::string& block, std::string_view kind, bool resets,
                                std::string_view edge) {
  using Kind = Execution::Kind;
  constexpr std::pair<std::string_view, Kind> kinds[] = {{"enabled", Kind::enabled},
                                                         {"triggered", Kind::triggered}};
  return {.kind = detail::meaning(block, "kind", kind, kinds),
          .resets = resets,
          .edge = edge_from(block, edge)};
}

}  // namespace saltus::python
