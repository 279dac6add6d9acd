// y = value.
#include "saltus/library/constant.hpp"

namespace saltus {

Constant::Constant(std::string name, const Value& value) : LeafSystem(std::move(name)) {
  detail::insist(value.values.size() > 0, this->name(),
                 "value is an empty vector; give at least one number");
  const ParameterIndex k = declare_dynamic_parameter("value", value.values);
  declare_output_port({.name = "out",
                       .shape = value.shape(),
                       .reads = Reads::parameters,
                       .view = Place{Space::p, k.offset, k.size}});
}

}  // namespace saltus
