// Finds the shape of a Python output, and whether it is a boolean, by calling it once.
#include <array>
#include <numeric>

#include "interpreter.hpp"
#include "python_leaf.hpp"
#include "saltus/model/detail/shape_guess.hpp"

namespace saltus::python {

int PythonLeaf::add_output(std::string port, int function, std::optional<Shape> shape,
                           std::optional<bool> boolean, Reads reads,
                           std::shared_ptr<const LeafSystem> sampler,
                           DerivativesFunction derivatives) {
  const InputList& inputs = this->function(function).inputs;
  require_shape(function, shape);
  if (shape) functions_[function].columns = shape->columns;
  const int output =
      declare_output_port({.name = std::move(port),
                           .calc = vector_function(function),
                           .shape = shape,
                           .shape_rule =
                               [this, function, shape](std::span<const Shape> shapes) {
                                 return shape ? *shape : shape_of(function, shapes);
                               },
                           .reads = reads,
                           .inputs = inputs,
                           .boolean = boolean.value_or(false),
                           .derivatives = std::move(derivatives),
                           .sampler = std::move(sampler)});
  const bool callable = !this->function(function).compiled && !this->function(function).in_place;
  if (callable && (!shape || !boolean))
    unfinished_.push_back({output, function, shape.has_value(), boolean.has_value()});
  return output;
}

/// A function that fills memory cannot be called to find its size.
void PythonLeaf::require_shape(int k, const std::optional<Shape>& shape) const {
  if (shape || !(function(k).compiled || function(k).in_place)) return;
  throw ModelError(text(whose(function(k)), ": it fills ",
                        function(k).compiled ? "memory" : "an array `out`",
                        ", so say how much: shape=() for one number, shape=n for a vector, "
                        "shape=(m, n) for a matrix"));
}

namespace {

/// The values of all inputs for a look at the shape of a result.
enum class Probe { zeros, ones, identities };

/// Identities: square matrices, where many functions need a regular one; ones elsewhere.
Eigen::VectorXd values_of(const std::vector<Shape>& shapes, Probe probe) {
  Index width = 0;
  for (const Shape& shape : shapes) width += shape.size;
  Eigen::VectorXd u = Eigen::VectorXd::Constant(std::max<Index>(width, 1), probe != Probe::zeros);
  Index first = 0;
  for (const Shape& shape : shapes) {
    const bool square = shape.is_matrix() && shape.rows() == shape.columns;
    if (square && probe == Probe::identities)
      Eigen::Map<Eigen::MatrixXd>(u.data() + first, shape.columns, shape.columns).setIdentity();
    first += shape.size;
  }
  return u;
}

}  // namespace

/// Calls function k with the initial values of the block and the values `u` of all inputs.
py::object PythonLeaf::call_with(int k, const std::vector<Shape>& shapes,
                                 const Eigen::VectorXd& u) const {
  const Declarations& d = declarations();
  const Function& function = this->function(k);
  for (const int i : function.inputs.value_or(std::vector<int>{})) {
    if (i >= 0 && i < static_cast<int>(shapes.size())) continue;
    throw ModelError(text(whose(function), ": requires_inputs names input ", i, ", the block has ",
                          shapes.size()));
  }
  std::vector<Place> places;
  Index width = 0;
  for (const Shape& shape : shapes) {
    places.push_back({Space::y, width, shape.size, shape.columns});
    width += shape.size;
  }
  const Bases bases{d.continuous.initial.data(), d.discrete.data(), d.parameter_values.data(),
                    u.data()};
  const auto view = [](const Eigen::VectorXd& values) {
    return VectorView(values.data(), values.size());
  };
  std::vector<std::vector<double>> truths;  // all false: no guard has been read
  for (const Relation& relation : d.relations) truths.emplace_back(*relation.size, 0.0);
  std::vector<const double*> relations;
  for (const auto& values : truths) relations.push_back(values.data());
  return call(
      k,
      At(0.0, view(d.continuous.initial), view(d.discrete), view(d.parameter_values), d.mode,
         Inputs(places.data(), static_cast<int>(places.size()), &bases), relations.data()),
      0);
}

namespace {

/// The shapes that are tried: an input of unknown shape has `width` entries, or is one number.
std::vector<Shape> with_width(std::vector<Shape> shapes, Index width) {
  for (Shape& shape : shapes)
    if (shape.size == 0) shape = width == 0 ? Shape::scalar() : Shape::of(width);
  return shapes;
}

/// Calls a function with the warnings of NumPy off, by numpy.errstate.
template <class Call>
py::object quietly(const py::object& errstate, const Call& call) {
  py::dict ignored;
  ignored["all"] = "ignore";
  const py::object quiet = ask_with(errstate, py::tuple(), ignored);  // it is entered once only
  ask(quiet.attr("__enter__"));
  py::object result;
  try {
    result = call();
  } catch (...) {
    ask(quiet.attr("__exit__"), py::none(), py::none(), py::none());
    throw;
  }
  ask(quiet.attr("__exit__"), py::none(), py::none(), py::none());
  return result;
}

}  // namespace

/// The result of the first call that succeeds: a zero may be a divisor, a matrix may be inverted, and
/// an input of unknown width may be indexed.
std::optional<py::array> PythonLeaf::sample(int k, std::vector<Shape> shapes,
                                            std::span<const Index> widths) const {
  std::exception_ptr first;  // what the first call raised
  const py::object errstate = py::module_::import("numpy").attr("errstate");
  for (const Index width : widths) {
    const std::vector<Shape> tried = with_width(shapes, width);
    for (const Probe probe : {Probe::zeros, Probe::ones, Probe::identities}) {
      try {
        const py::object result =
            quietly(errstate, [&] { return call_with(k, tried, values_of(tried, probe)); });
        if (py::array array = py::array::ensure(result); array && !result.is_none()) return array;
        PyErr_Clear();
      } catch (py::error_already_set& error) {
        if (!error.matches(PyExc_Exception)) throw;  // Ctrl-C
        if (!first) first = std::current_exception();
      }
    }
  }
  if (first && detail::RefuseGuesses::active()) throw_guess(function(k), first);
  return std::nullopt;
}

/// Says that the function was called for its shape, and what it raised.
void PythonLeaf::throw_guess(const Function& function, const std::exception_ptr& raised) const {
  std::string what;
  try {
    std::rethrow_exception(raised);
  } catch (const py::error_already_set& error) {
    what = text(std::string(py::str(error.type().attr("__name__"))), ": ",
                std::string(py::str(error.value())));
  }
  throw detail::ShapeGuess(
      text(whose(function),
           " was called with zeros and with ones in place of its inputs, to find its "
           "shape, and raised each time, at first ",
           what,
           "; so it counts as one number. Let it return its shape there too, or declare it with "
           "shape="),
      raised);
}

Shape PythonLeaf::shape_of(int k, std::span<const Shape> inputs) const {
  if (ShapesAsDeclared::active()) return {0, false};  // not known yet
  return locked([&] {
    constexpr std::array<Index, 1> known{0};
    const auto found = sample(k, {inputs.begin(), inputs.end()}, known);
    return shape_of_result(k, found);
  });
}

/// A scalar if no call has succeeded: the run shows why.
Shape PythonLeaf::shape_of_result(int k, const std::optional<py::array>& found) const {
  return found ? saltus::python::shape_of(dimensions_of(*found), whose(function(k)))
               : Shape::scalar();
}

/// Whether an output reads an input of its block.
static bool reads_inputs(const OutputDeclaration& output, const Declarations& declared) {
  const bool reads_none = output.inputs && output.inputs->empty();
  return has(output.reads, Reads::inputs) && !reads_none && !declared.inputs.empty();
}

/// Runs once, before anyone reads the declarations of this block: outputs get their final shapes.
void PythonLeaf::finish_outputs() {
  const Locked lock;
  const auto in_use = declarations().use;  // the functions called here must not declare
  const std::vector<Unfinished> now = std::exchange(unfinished_, {});
  // The declarations are this object's own; only the interface for the engine is const.
  auto& declared = const_cast<Declarations&>(declarations());
  for (const Unfinished& entry : now) finish(declared.outputs[entry.output], entry, declared);
}

void PythonLeaf::finish(OutputDeclaration& output, const Unfinished& entry,
                        const Declarations& declared) {
  constexpr std::array<Index, 7> guesses{0, 1, 2, 3, 4, 6, 12};
  std::vector<Shape> shapes;
  for (const InputDeclaration& port : declared.inputs)
    shapes.push_back(port.shape.value_or(Shape{0, false}));
  const bool reads = reads_inputs(output, declared);
  const auto found = sample(entry.function, shapes, std::span(guesses).first(reads ? 7 : 1));
  if (!entry.boolean) output.boolean = found && found->dtype().kind() == 'b';
  if (!entry.shape && !reads) output.shape = shape_of_result(entry.function, found);
}

void PythonLeaf::collect(Structure& out, const std::string& path) const {
  if (!unfinished_.empty()) const_cast<PythonLeaf*>(this)->finish_outputs();
  LeafSystem::collect(out, path);
}

std::string PythonLeaf::kind() const {
  const py::object self = py::cast(this, py::return_value_policy::reference);
  return py::str(py::type::of(self).attr("__name__"));
}

}  // namespace saltus::python
