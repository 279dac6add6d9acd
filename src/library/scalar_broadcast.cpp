// y = (u, u, ..., u): a scalar as a vector of n equal entries.
#include "saltus/library/scalar_broadcast.hpp"

#include "saltus/library/detail/arguments.hpp"

namespace saltus {

ScalarBroadcast::ScalarBroadcast(std::string name, int n) : LeafSystem(std::move(name)) {
  detail::require_count(this->name(), "entry", n, 1);
  declare_input_port({.name = "in", .shape = Shape::scalar()});
  declare_output_port(
      {.name = "out", .shape = Shape::of(n), .reads = Reads::inputs, .formula = [](const auto& at) {
         return at.u(0);
       }});
}

}  // namespace saltus
