// The functions of a Python block, as the engine calls them.
#include <numeric>

#include "python_leaf.hpp"

#include "interpreter.hpp"

namespace saltus::python {

namespace {

/// The plain function of a method of `self`; any other callable is returned unchanged.
bool unbind(py::object& callable, py::handle self) {
  if (!PyMethod_Check(callable.ptr()) || PyMethod_GET_SELF(callable.ptr()) != self.ptr())
    return false;
  callable = py::reinterpret_borrow<py::object>(PyMethod_GET_FUNCTION(callable.ptr()));
  return true;
}

void* as_pointer(py::handle address) {
  return reinterpret_cast<void*>(address.cast<std::uintptr_t>());
}

}  // namespace

int PythonLeaf::add(py::handle self, py::object callable, Function function) {
  require_unused();  // a run that is under way refers to the functions
  self_ = self.ptr();
  if (py::isinstance(callable, py::module_::import("saltus.compiled").attr("Compiled"))) {
    function.compiled = reinterpret_cast<CompiledPointer>(as_pointer(callable.attr("address")));
    function.user_data = as_pointer(callable.attr("user_data"));
  } else if (PyCallable_Check(callable.ptr()) == 0) {
    throw ModelError(
        text(whose(function), ": expected a function, found ", std::string(py::repr(callable))));
  } else {
    function.in_place =
        ask(py::module_::import("saltus._in_place").attr("fills_out"), callable).cast<bool>();
    function.method = unbind(callable, self);
  }
  function.callable = std::move(callable);
  functions_.push_back(std::move(function));
  return static_cast<int>(functions_.size()) - 1;
}

void PythonLeaf::add_parameter(const std::string& parameter, const py::array& value) {
  declare_dynamic_parameter(parameter, as_vector(value));
  parameter_dimensions_.push_back(dimensions_of(value));
  keywords_ = py::tuple(keywords_ + py::make_tuple(py::str(parameter)));
  forget_frames();
}

bool PythonLeaf::has_parameter(std::string_view parameter) const {
  return std::ranges::any_of(declarations().parameters,
                             [&](const auto& declared) { return declared.name == parameter; });
}

int PythonLeaf::add_input(std::string port, std::optional<Shape> shape) {
  const int input = declare_input_port({.name = std::move(port), .shape = shape});
  forget_frames();
  return input;
}

VectorFunction PythonLeaf::vector_function(int k) const {
  if (function(k).compiled) {
    return [this, k](const At& at, VectorRef out) { run_compiled(function(k), at, out.data()); };
  }
  return [this, k](const At& at, VectorRef out) { locked([&] { fill(k, at, out); }); };
}

DerivativesFunction PythonLeaf::derivatives_function(int k) const {
  return [this, k, columns = vector_function(k)](const At& at, Derivatives& out) {
    std::vector<MatrixRef> blocks{out.by_continuous_state(), out.by_discrete_state(),
                                  out.by_parameters()};
    // A control signal of a part is none of the inputs that the block declared.
    std::vector<int> every(declarations().inputs.size());
    std::iota(every.begin(), every.end(), 0);
    for (const int i : function(k).inputs.value_or(every)) blocks.push_back(out.by_input(i));
    blocks.emplace_back(out.by_time().data(), out.rows(), 1);
    Index size = 0;
    for (const MatrixRef& block : blocks) size += block.size();
    Eigen::VectorXd values(size);
    columns(*this, at, VectorRef(values.data(), size));
    const double* from = values.data();
    for (MatrixRef& block : blocks)
      std::copy_n(from, block.size(), block.data()), from += block.size();
  };
}

/// Python and C store a matrix row by row.
MatrixFunction PythonLeaf::matrix_function(int k) const {
  return [this, k, rows = vector_function(k)](const At& at, MatrixRef out) {
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> values(out.rows(),
                                                                                  out.cols());
    rows(*this, at, VectorRef(values.data(), values.size()));
    out = values;
  };
}

ResetMap PythonLeaf::reset_map(int k) const {
  if (function(k).compiled) {
    return [this, k](const At& at, Next& next) { reset_compiled(function(k), at, next); };
  }
  return [this, k](const At& at, Next& next) { locked([&] { write(k, call(k, at, 0), next); }); };
}

DeliveryMap PythonLeaf::delivery_map(int k) const {
  return [this, map = reset_map(k)](const At& at, Delivery& next) { map(*this, at, next); };
}

namespace {

/// The numbers that a reset map or an update returned in place of a state.
Eigen::VectorXd numbers_of_state(py::handle result, const std::string& whose) {
  try {
    return to_vector(result, whose);
  } catch (const ModelError&) {
    throw ModelError(text(whose, " returned ", std::string(py::repr(result)),
                          ", expected a state: `return state.with_continuous_state(...)`, or the "
                          "numbers of one"));
  }
}

}  // namespace

/// The state that numbers alone mean. In an update of a block with both states they are the
/// discrete state; a reset map of such a block has to return a state.
bool PythonLeaf::means_discrete(const Function& function, bool has_x, bool has_z) const {
  if (has_x != has_z) return has_z;
  if (has_x && function.role == Role::update) return true;
  throw ModelError(
      text(whose(function), " returned numbers, expected a state: the block has ",
           has_x ? "a continuous and a discrete state; say which: " : "neither; write ",
           has_x ? "`return state.with_continuous_state(...)`" : "`return state.with_mode(...)`"));
}

/// Writes the result of a reset map or an update: a state, or the numbers of the one state that the
/// block has.
void PythonLeaf::write(int k, py::handle result, Next& next) const {
  if (py::isinstance<State>(result)) return result.cast<const State&>().write_to(next);
  const Function& of = function(k);
  if (result.is_none()) {
    throw ModelError(text(whose(of),
                          " returned None, expected a state: `return "
                          "state.with_continuous_state(...)`; is a `return` missing?"));
  }
  const Eigen::VectorXd values = numbers_of_state(result, whose(of));
  const Index x = declarations().continuous.initial.size(), z = declarations().discrete.size();
  const bool discrete = means_discrete(of, x > 0, z > 0);
  const Index size = discrete ? z : x;
  if (values.size() != size) {
    throw ModelError(text(whose(of), " returned ", values.size(), " numbers, expected ", size,
                          " for the ", discrete ? "discrete" : "continuous", " state"));
  }
  require_matrix(result, discrete ? z_dimensions_ : x_dimensions_, text(whose(of), " returned"));
  discrete ? next.set_discrete_state(values) : next.set_continuous_state(values);
}

int PythonLeaf::traverse(visitproc visit, void* arg) const {
  for (const Function& function : functions_) Py_VISIT(function.callable.ptr());
  return 0;
}

}  // namespace saltus::python
