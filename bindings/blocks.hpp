// Helpers shared by the bindings of blocks.
#pragma once

#include <pybind11/stl.h>

#include "numbers.hpp"

namespace saltus::python {

/// Converts the arguments of one block to numbers; messages name the block and the argument.
class Arguments {
 public:
  explicit Arguments(std::string block) : block_(std::move(block)) {}
  Value value(py::handle numbers, std::string_view name) const {
    return to_value(numbers, what(name));
  }
  std::optional<Value> optional(py::handle numbers, std::string_view name) const {
    return to_optional_value(numbers, what(name));
  }

 private:
  std::string what(std::string_view name) const { return text("block '", block_, "': ", name); }
  std::string block_;
};

}  // namespace saltus::python
