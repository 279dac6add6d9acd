// Blocks that calculate with their inputs.
#include "blocks.hpp"
#include "saltus/library/abs.hpp"
#include "saltus/library/adder.hpp"
#include "saltus/library/demultiplexer.hpp"
#include "saltus/library/gain.hpp"
#include "saltus/library/multiplexer.hpp"
#include "saltus/library/offset.hpp"
#include "saltus/library/product.hpp"
#include "saltus/library/saturate.hpp"

namespace saltus::python {

void bind_arithmetic(py::module_& module) {
  using Handle = const py::object&;
  py::class_<Abs, System>(module, "Abs").def(py::init<std::string>());
  py::class_<Adder, System>(module, "Adder").def(py::init<std::string, std::string_view>());
  py::class_<Demultiplexer, System>(module, "Demultiplexer").def(py::init<std::string, int>());
  py::class_<Gain, System>(module, "Gain").def(py::init([](const std::string& name, Handle gain) {
    return std::make_unique<Gain>(name, Arguments(name).value(gain, "gain"));
  }));
  py::class_<Multiplexer, System>(module, "Multiplexer").def(py::init<std::string, int>());
  py::class_<Offset, System>(module, "Offset")
      .def(py::init([](const std::string& name, Handle offset) {
        return std::make_unique<Offset>(name, Arguments(name).value(offset, "offset"));
      }));
  py::class_<Product, System>(module, "Product").def(py::init<std::string, std::string_view>());
  py::class_<Saturate, System>(module, "Saturate")
      .def(py::init([](const std::string& name, Handle lower_limit, Handle upper_limit) {
        const Arguments of(name);
        return std::make_unique<Saturate>(name,
                                          SaturateOptions{of.optional(lower_limit, "lower_limit"),
                                                          of.optional(upper_limit, "upper_limit")});
      }));
}

}  // namespace saltus::python
