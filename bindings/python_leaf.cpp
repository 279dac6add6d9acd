// How the engine calls a Python function. The lock of the interpreter is taken here and nowhere
// else in a run.
#include "python_leaf.hpp"

namespace saltus::python {

int PythonLeaf::add(py::handle self, py::object function, InputList inputs, std::string what,
                    Convention convention) {
  self_ = self.ptr();
  if (PyCallable_Check(function.ptr()) == 0) {
    throw ModelError(text("block '", name(), "': ", what, ": expected a function, found ",
                          std::string(py::repr(function))));
  }
  const bool method =
      PyMethod_Check(function.ptr()) && PyMethod_GET_SELF(function.ptr()) == self.ptr();
  if (method) function = py::reinterpret_borrow<py::object>(PyMethod_GET_FUNCTION(function.ptr()));
  functions_.push_back(
      {std::move(function), method, convention, std::move(inputs), std::move(what)});
  return static_cast<int>(functions_.size()) - 1;
}

void PythonLeaf::add_parameter(const std::string& parameter, const py::array& value) {
  declare_dynamic_parameter(parameter, as_vector(value));
  parameter_dimensions_.push_back(dimensions_of(value));
  keywords_ = py::tuple(keywords_ + py::make_tuple(py::str(parameter)));
}

int PythonLeaf::add_input(std::string port, std::optional<Shape> shape) {
  vector_inputs_.push_back(shape && shape->vector);
  return declare_input_port({.name = std::move(port), .shape = shape});
}

VectorFunction PythonLeaf::vector_function(int k) const {
  return [this, k](const At& at, VectorRef out) {
    const py::gil_scoped_acquire lock;
    const Function& function = functions_[static_cast<std::size_t>(k)];
    read_numbers(call(k, at), out, whose(function));
  };
}

MatrixFunction PythonLeaf::matrix_function(int k) const {
  return [this, k](const At& at, MatrixRef out) {
    const py::gil_scoped_acquire lock;
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> rows(out.rows(),
                                                                                out.cols());
    read_numbers(call(k, at), VectorRef(rows.data(), rows.size()),
                 whose(functions_[static_cast<std::size_t>(k)]));
    out = rows;
  };
}

ResetMap PythonLeaf::reset_map(int k) const {
  return [this, k](const At& at, Next& next) {
    const py::gil_scoped_acquire lock;
    const py::object result = call(k, at);
    const Function& function = functions_[static_cast<std::size_t>(k)];
    if (!py::isinstance<State>(result)) {
      throw ModelError(text(whose(function), " returned ", std::string(py::repr(result)),
                            ", expected a state: `return state.with_continuous_state(...)`"));
    }
    result.cast<const State&>().write_to(next);
  };
}

ResetMap PythonLeaf::update(int k) const {
  return [this, k](const At& at, Next& next) {
    const py::gil_scoped_acquire lock;
    const py::object result = call(k, at);
    if (py::isinstance<State>(result)) {
      result.cast<const State&>().write_to(next);
    } else {
      const std::string what = whose(functions_[static_cast<std::size_t>(k)]);
      if (result.is_none())
        throw ModelError(text(what, " returned None, expected a state or the new discrete state"));
      next.set_discrete_state(to_vector(result, what));
    }
  };
}

/// A kept array must not change: one that somebody else holds too is left to them.
void PythonLeaf::fill_state(Frame& frame, const At& at) const {
  if (!frame.state || frame.state.ref_count() != 1)
    frame.state = py::cast(State(name(), x_dimensions_, z_dimensions_));
  auto& state = *frame.state.cast<State*>();
  if (state.x.ref_count() != 1) state.x = read_only_array(x_dimensions_, nullptr);
  if (state.z.ref_count() != 1) state.z = read_only_array(z_dimensions_, nullptr);
  std::copy_n(at.x.data(), at.x.size(), numbers_of(state.x));
  std::copy_n(at.z.data(), at.z.size(), numbers_of(state.z));
  state.mode = at.mode;
  state.entry = at.entry;
}

/// The same objects as long as the values are the same, which is for a whole run.
void PythonLeaf::fill_parameters(Frame& frame, const At& at) const {
  if (frame.parameters.size() == parameter_dimensions_.size() && frame.parameter_values == at.p)
    return;
  frame.parameters.clear();
  frame.parameter_values = at.p;
  const double* value = at.p.data();
  for (const auto& dimensions : parameter_dimensions_) {
    if (dimensions.empty()) {
      frame.parameters.push_back(py::float_(*value++));
      continue;
    }
    py::array array = read_only_array(dimensions, value);
    value += array.size();
    frame.parameters.push_back(std::move(array));
  }
}

py::object PythonLeaf::input(const At& at, int i) const {
  const VectorView u = at.u[i];
  if (u.size() == 1 && !vector_inputs_[static_cast<std::size_t>(i)]) return py::float_(u[0]);
  return read_only_array({u.size()}, u.data());
}

/// The inputs that the function gets, as Python objects that the frame owns.
void PythonLeaf::fetch_inputs(Frame& frame, const Function& function, const At& at) const {
  frame.owned.clear();
  const auto all = static_cast<std::size_t>(at.u.size());
  const std::size_t count = function.inputs ? function.inputs->size() : all;
  for (std::size_t i = 0; i < count; ++i) {
    frame.owned.push_back(input(at, function.inputs ? (*function.inputs)[i] : static_cast<int>(i)));
  }
}

/// Puts the arguments in order; returns how many are positional, those by keyword stand behind.
std::size_t PythonLeaf::arrange(Frame& frame, const Function& function, const At& at) const {
  fetch_inputs(frame, function, at);
  auto& [state, owned, parameters, values, arguments] = frame;
  arguments.assign(1, nullptr);  // room that vectorcall may use
  if (function.method) arguments.push_back(self_);
  if (function.convention == Convention::state) {
    fill_state(frame, at);
    fill_parameters(frame, at);
    const py::float_ time(at.time);
    arguments.insert(arguments.end(), {time.ptr(), state.ptr()});
    for (const py::object& input : owned) arguments.push_back(input.ptr());
    owned.push_back(time);
  } else if (function.convention == Convention::inputs) {
    py::tuple all(owned.size());
    for (std::size_t i = 0; i < owned.size(); ++i) all[i] = owned[i];
    arguments.push_back(all.ptr());
    owned.push_back(std::move(all));
  } else {
    arguments.push_back(owned.front().ptr());
  }
  const std::size_t positional = arguments.size() - 1;
  if (function.convention == Convention::state) {
    for (const py::object& parameter : parameters) arguments.push_back(parameter.ptr());
  }
  return positional;
}

py::object PythonLeaf::call(int k, const At& at) const {
  const Function& function = functions_[static_cast<std::size_t>(k)];
  // Taken out, not shared: another thread may come while this one is in Python.
  std::unique_ptr<Frame> frame = spare_ ? std::move(spare_) : std::make_unique<Frame>();
  const std::size_t positional = arrange(*frame, function, at);
  std::vector<PyObject*>& arguments = frame->arguments;
  PyObject* keywords = arguments.size() > positional + 1 ? keywords_.ptr() : nullptr;
  auto result = py::reinterpret_steal<py::object>(
      PyObject_Vectorcall(function.callable.ptr(), arguments.data() + 1,
                          positional | PY_VECTORCALL_ARGUMENTS_OFFSET, keywords));
  if (!result) throw py::error_already_set();
  spare_ = std::move(frame);
  return result;
}

int PythonLeaf::traverse(visitproc visit, void* arg) const {
  for (const Function& function : functions_) Py_VISIT(function.callable.ptr());
  return 0;
}

}  // namespace saltus::python
