// Blocks that calculate with their inputs.
#include "blocks.hpp"
#include "saltus/library/abs.hpp"
#include "saltus/library/adder.hpp"
#include "saltus/library/bus.hpp"
#include "saltus/library/cross_product.hpp"
#include "saltus/library/dead_zone.hpp"
#include "saltus/library/demultiplexer.hpp"
#include "saltus/library/dot_product.hpp"
#include "saltus/library/exponent.hpp"
#include "saltus/library/gain.hpp"
#include "saltus/library/logarithm.hpp"
#include "saltus/library/lookup_table_1d.hpp"
#include "saltus/library/lookup_table_2d.hpp"
#include "saltus/library/lookup_table_nd.hpp"
#include "saltus/library/matrix_concatenation.hpp"
#include "saltus/library/matrix_inversion.hpp"
#include "saltus/library/matrix_multiplication.hpp"
#include "saltus/library/matrix_transposition.hpp"
#include "saltus/library/min_max.hpp"
#include "saltus/library/multiplexer.hpp"
#include "saltus/library/offset.hpp"
#include "saltus/library/power.hpp"
#include "saltus/library/product.hpp"
#include "saltus/library/product_of_elements.hpp"
#include "saltus/library/quantizer.hpp"
#include "saltus/library/reciprocal.hpp"
#include "saltus/library/reshape.hpp"
#include "saltus/library/saturate.hpp"
#include "saltus/library/scalar_broadcast.hpp"
#include "saltus/library/sign.hpp"
#include "saltus/library/slice.hpp"
#include "saltus/library/square_root.hpp"
#include "saltus/library/sum_of_elements.hpp"
#include "saltus/library/trigonometric.hpp"

namespace saltus::python {

void bind_arithmetic(py::module_& module) {
  using Handle = const py::object&;
  py::class_<Abs, System>(module, "Abs").def(py::init<std::string>());
  py::class_<Adder, System>(module, "Adder").def(py::init<std::string, std::string_view>());
  using Signals = std::vector<std::pair<std::string, std::optional<Index>>>;
  const auto layout_of = [](const Signals& signals) {
    BusLayout layout;
    for (const auto& [signal, width] : signals)
      layout.push_back({signal, width ? Shape::of(*width) : Shape::scalar()});
    return layout;
  };
  py::class_<BusCreator, System>(module, "BusCreator")
      .def(py::init([layout_of](const std::string& name, const Signals& signals) {
        return std::make_unique<BusCreator>(name, layout_of(signals));
      }));
  py::class_<BusSelector, System>(module, "BusSelector")
      .def(py::init([layout_of](const std::string& name, const Signals& signals,
                                const std::vector<std::string>& names) {
        return std::make_unique<BusSelector>(name, layout_of(signals), names);
      }));
  py::class_<CrossProduct, System>(module, "CrossProduct").def(py::init<std::string>());
  py::class_<DeadZone, System>(module, "DeadZone")
      .def(py::init([](const std::string& name, Handle half_range, bool shifted) {
        return std::make_unique<DeadZone>(
            name, DeadZoneOptions{Arguments(name).value(half_range, "half_range"), shifted});
      }));
  py::class_<Demultiplexer, System>(module, "Demultiplexer").def(py::init<std::string, int>());
  py::class_<DotProduct, System>(module, "DotProduct").def(py::init<std::string>());
  py::class_<Exponent, System>(module, "Exponent").def(py::init<std::string, std::string_view>());
  py::class_<Gain, System>(module, "Gain").def(py::init([](const std::string& name, Handle gain) {
    return std::make_unique<Gain>(name, Arguments(name).value(gain, "gain"));
  }));
  py::class_<Logarithm, System>(module, "Logarithm").def(py::init<std::string, std::string_view>());
  py::class_<LookupTable1d, System>(module, "LookupTable1d")
      .def(py::init([](const std::string& name, Handle input_array, Handle output_array,
                       std::string_view interpolation, std::string_view extrapolation) {
        const Arguments of(name);
        return std::make_unique<LookupTable1d>(name, of.vector(input_array, "input_array"),
                                               of.vector(output_array, "output_array"),
                                               LookupTable1dOptions{interpolation, extrapolation});
      }));
  py::class_<LookupTable2d, System>(module, "LookupTable2d")
      .def(py::init([](const std::string& name, Handle input_x, Handle input_y, Handle table,
                       std::string_view extrapolation) {
        const Arguments of(name);
        return std::make_unique<LookupTable2d>(
            name, of.vector(input_x, "input_x"), of.vector(input_y, "input_y"),
            of.matrix(table, "output_table"), LookupTable2dOptions{extrapolation});
      }));
  py::class_<LookupTableNd, System>(module, "LookupTableNd")
      .def(py::init([](const std::string& name, const std::vector<py::object>& axes, Handle table,
                       std::string_view extrapolation) {
        const Arguments of(name);
        std::vector<Eigen::VectorXd> points;
        for (const py::object& axis : axes) points.push_back(of.vector(axis, "input_axes"));
        return std::make_unique<LookupTableNd>(name, points, of.vector(table, "output_table"),
                                               LookupTableNdOptions{extrapolation});
      }));
  using Rectangle = std::pair<Index, Index>;
  const auto rectangle = [](const Rectangle& of) { return MatrixShape{of.first, of.second}; };
  py::class_<MatrixConcatenation, System>(module, "MatrixConcatenation")
      .def(py::init<std::string, int, int>());
  py::class_<MatrixInversion, System>(module, "MatrixInversion")
      .def(py::init<std::string>())
      .def(py::init<std::string, Index>());
  py::class_<MatrixMultiplication, System>(module, "MatrixMultiplication")
      .def(py::init<std::string>())
      .def(py::init([rectangle](const std::string& name, Rectangle left, Rectangle right) {
        return std::make_unique<MatrixMultiplication>(name, rectangle(left), rectangle(right));
      }));
  py::class_<MatrixTransposition, System>(module, "MatrixTransposition")
      .def(py::init<std::string>())
      .def(py::init([rectangle](const std::string& name, Rectangle shape) {
        return std::make_unique<MatrixTransposition>(name, rectangle(shape));
      }));
  py::class_<MinMax, System>(module, "MinMax").def(py::init<std::string, std::string_view, int>());
  py::class_<Multiplexer, System>(module, "Multiplexer").def(py::init<std::string, int>());
  py::class_<Offset, System>(module, "Offset")
      .def(py::init([](const std::string& name, Handle offset) {
        return std::make_unique<Offset>(name, Arguments(name).value(offset, "offset"));
      }));
  py::class_<Power, System>(module, "Power")
      .def(py::init([](const std::string& name, Handle exponent) {
        return std::make_unique<Power>(name, Arguments(name).value(exponent, "exponent"));
      }));
  py::class_<Product, System>(module, "Product").def(py::init<std::string, std::string_view>());
  py::class_<ProductOfElements, System>(module, "ProductOfElements").def(py::init<std::string>());
  py::class_<Quantizer, System>(module, "Quantizer")
      .def(py::init([](const std::string& name, Handle interval, double hysteresis) {
        return std::make_unique<Quantizer>(name, Arguments(name).value(interval, "interval"),
                                           QuantizerOptions{hysteresis});
      }));
  py::class_<Reciprocal, System>(module, "Reciprocal").def(py::init<std::string>());
  py::class_<Reshape, System>(module, "Reshape")
      .def(py::init([](const std::string& name, const Dimensions& shape) {
        return std::make_unique<Reshape>(name, shape_of(shape, text("block '", name, "': shape")));
      }));
  py::class_<Saturate, System>(module, "Saturate")
      .def(py::init([](const std::string& name, Handle lower_limit, Handle upper_limit) {
        const Arguments of(name);
        return std::make_unique<Saturate>(name,
                                          SaturateOptions{of.optional(lower_limit, "lower_limit"),
                                                          of.optional(upper_limit, "upper_limit")});
      }));
  py::class_<ScalarBroadcast, System>(module, "ScalarBroadcast").def(py::init<std::string, int>());
  py::class_<Sign, System>(module, "Sign").def(py::init<std::string>());
  py::class_<Slice, System>(module, "Slice")
      .def(py::init<std::string, Index>())
      .def(py::init<std::string, std::vector<Index>>())
      .def(py::init(
          [](std::string name, std::optional<Index> start, std::optional<Index> stop, Index step) {
            return std::make_unique<Slice>(std::move(name), SliceRange{start, stop, step});
          }));
  py::class_<SquareRoot, System>(module, "SquareRoot").def(py::init<std::string>());
  py::class_<SumOfElements, System>(module, "SumOfElements").def(py::init<std::string>());
  py::class_<Trigonometric, System>(module, "Trigonometric")
      .def(py::init<std::string, std::string_view>());
}

}  // namespace saltus::python
