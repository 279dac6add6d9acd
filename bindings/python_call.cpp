// Calls a Python function, with objects that are made once and reused.
#include <bit>

#include "interpreter.hpp"
#include "python_leaf.hpp"
#include "saltus/base/list.hpp"
#include "saltus/model/detail/shape_guess.hpp"

namespace saltus::python {

namespace {

/// A kept object must not change. If somebody else holds a reference too, the object is left to
/// them.
bool ours(const py::object& object) { return object && Py_REFCNT(object.ptr()) == 1; }

void set_number(py::object& to, double value) {
  if (ours(to)) {
    reinterpret_cast<PyFloatObject*>(to.ptr())->ob_fval = value;
  } else {
    to = py::float_(value);
  }
}

template <class Array>
void set_array(Array& to, const Dimensions& dimensions, const VectorView& values) {
  if (!ours(to)) to = read_only_array(dimensions, nullptr);
  std::copy_n(values.data(), values.size(), numbers_of(to));
}

/// Whether an array is a vector of this size, or a matrix of this size and these columns.
bool has_dimensions(const py::object& array, Index size, Index columns) {
  const auto* proxy = py::detail::array_proxy(array.ptr());
  if (columns == 0) return proxy->nd == 1 && proxy->dimensions[0] == size;
  return proxy->nd == 2 && proxy->dimensions[1] == columns &&
         proxy->dimensions[0] * columns == size;
}

}  // namespace

/// The truths of the relations that Python has declared; tracing may have added others after them.
py::tuple PythonLeaf::truths(const At& at) const {
  const auto& relations = declarations().relations;
  py::tuple all(relations.size());
  for (std::size_t r = 0; r < relations.size(); ++r) {
    const double* values = at.relation_values({static_cast<int>(r)});
    const Index size = *relations[r].size;
    all[r] = size == 1 ? py::object(py::bool_(*values != 0.0)) : read_only_array({size}, values);
  }
  return all;
}

void PythonLeaf::set_state(Frame& frame, const At& at) const {
  if (!ours(frame.state)) frame.state = py::cast(State(name(), x_dimensions_, z_dimensions_));
  State& state = state_in(frame.state);
  set_array(state.x, x_dimensions_, at.x);
  set_array(state.z, z_dimensions_, at.z);
  if (!declarations().relations.empty()) state.relations = truths(at);
  state.mode = at.mode;
  state.entry = at.entry;
}

/// The same objects while the values are the same, that is for a whole run.
void PythonLeaf::set_parameters(Frame& frame, const At& at, std::size_t place) const {
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
  for (const py::object& parameter : frame.parameters) frame.arguments[place++] = parameter.ptr();
}

void PythonLeaf::set_input(py::object& to, const At& at, int i) const {
  const VectorView u = at.u[i];
  const Index columns = at.u.columns(i);
  const bool number = number_input(i, u.size(), columns);
  if (to && number != PyFloat_CheckExact(to.ptr())) to = {};  // another plan, another shape
  if (number) return set_number(to, u[0]);
  if (to && !has_dimensions(to, u.size(), columns)) to = {};
  set_array(to, dimensions_of(Shape{u.size(), true, columns}), u);
}

/// Inserts the inputs of the function from `place` on; returns the place after them.
std::size_t PythonLeaf::set_inputs(Frame& frame, const Function& function, const At& at,
                                   std::size_t place) const {
  const bool tuple = function.convention == Convention::inputs;
  if (tuple) frame.inputs_tuple = py::tuple(frame.inputs.size());
  for (std::size_t i = 0; i < frame.inputs.size(); ++i) {
    set_input(frame.inputs[i], at, input_of(function, i, at));
    if (tuple) {
      PyTuple_SET_ITEM(frame.inputs_tuple.ptr(), static_cast<py::ssize_t>(i),
                       frame.inputs[i].inc_ref().ptr());
    } else {
      frame.arguments[place++] = frame.inputs[i].ptr();
    }
  }
  if (tuple) frame.arguments[place++] = frame.inputs_tuple.ptr();
  return place;
}

/// The array that an in-place function fills: the last argument, passed by keyword.
void PythonLeaf::set_out(Frame& frame, const Function& function, Index size) const {
  if (!ours(frame.out) || size_of(frame.out) != size) {
    const Index n = declarations().continuous.initial.size();
    const bool as_state = function.role == Role::ode && !x_dimensions_.empty();
    frame.out = Array(as_state ? x_dimensions_
                      : function.role == Role::jacobian
                          ? Dimensions{n, n}
                          : dimensions_of(Shape{size, true, function.columns}));
  }
  std::fill_n(numbers_of(frame.out), size, std::bit_cast<double>(unwritten));
  frame.arguments.back() = frame.out.ptr();
}

/// Room for all arguments; the constant ones are already in their places.
std::unique_ptr<Frame> PythonLeaf::new_frame(const Function& function) const {
  auto frame = std::make_unique<Frame>();
  const bool by_state = function.convention == Convention::state;
  const std::size_t inputs =
      (function.inputs ? function.inputs->size() : declarations().inputs.size()) +
      (gets_weight(function.role) ? 1 : 0);
  frame->inputs.resize(inputs);
  frame->positional = (function.method ? 1U : 0U) + (by_state ? 2U : 0U) +
                      (function.convention == Convention::inputs ? 1U : inputs);
  py::tuple keywords = by_state ? keywords_ : py::tuple();
  if (in_place(function)) keywords = py::tuple(keywords + py::make_tuple("out"));
  frame->arguments.assign(1 + frame->positional + keywords.size(), nullptr);
  if (function.method) frame->arguments[1] = self_;
  if (!keywords.empty()) frame->keywords = std::move(keywords);
  return frame;
}

Frame& PythonLeaf::prepare(std::unique_ptr<Frame>& spare, const Function& function, const At& at,
                           Index out_size) const {
  if (!spare) spare = new_frame(function);
  Frame& frame = *spare;
  std::size_t place = function.method ? 2 : 1;
  if (function.convention != Convention::state) {
    set_inputs(frame, function, at, place);
  } else {
    set_number(frame.time, at.time);
    set_state(frame, at);
    frame.arguments[place++] = frame.time.ptr();
    frame.arguments[place++] = frame.state.ptr();
    set_parameters(frame, at, set_inputs(frame, function, at, place));
  }
  if (in_place(function)) set_out(frame, function, out_size);
  return frame;
}

namespace {

/// Makes a call with its own frame, because another thread, or the function itself, may enter while
/// this call is in Python.
class Borrowed {
 public:
  explicit Borrowed(std::unique_ptr<Frame>& home) : home_(home), frame(std::move(home)) {}
  ~Borrowed() { home_ = std::move(frame); }

 private:
  std::unique_ptr<Frame>& home_;

 public:
  std::unique_ptr<Frame> frame;
};

/// An exception that Python raised to end the program. C++ must not treat it as a failure of the
/// function.
class ProgramEnd final : public py::error_already_set, public Interruption {};

}  // namespace

py::object PythonLeaf::vectorcall(const Function& function, const Frame& frame) const {
  PyObject* result = until_shutdown([&] {
    return PyObject_Vectorcall(
        function.callable.ptr(), const_cast<PyObject* const*>(frame.arguments.data()) + 1,
        frame.positional | PY_VECTORCALL_ARGUMENTS_OFFSET, frame.keywords.ptr());
  });
  if (result == nullptr) throw_raised(function, frame);
  return py::reinterpret_steal<py::object>(result);
}

/// The names of the positional arguments.
py::list PythonLeaf::positional(const Function& function) const {
  py::list names;
  if (function.method) names.append("self");
  if (function.convention == Convention::inputs) {
    names.append("inputs");
    return names;
  }
  if (function.convention == Convention::state) {
    names.append("time");
    names.append("state");
  }
  const List<std::string> ports = input_names();
  if (!function.inputs) {
    for (const std::string& port : ports) names.append(port);
  } else {
    for (const int i : *function.inputs) names.append(ports[i]);
  }
  if (gets_weight(function.role)) names.append("weight");
  return names;
}

/// Rethrows the exception of the function unchanged. But a TypeError that no line of Python raised
/// may mean that the function does not accept these arguments; then a ModelError names the
/// arguments. A ValueError may be NumPy's refusal of a write to the state; a ModelError says what
/// to do.
void PythonLeaf::throw_raised(const Function& function, const Frame& frame) const {
  if (PyErr_ExceptionMatches(PyExc_Exception) == 0) throw ProgramEnd();
  py::error_already_set error;
  if (error.matches(PyExc_TypeError) && !error.trace()) {
    const py::object keywords = frame.keywords ? frame.keywords : py::tuple();
    ask(py::module_::import("saltus.calling").attr("refuse_signature"), whose(function),
        function.callable, positional(function), keywords, error.value());
  }
  if (error.matches(PyExc_ValueError)) {
    ask(py::module_::import("saltus.calling").attr("refuse_writing"), whose(function),
        error.value(), error.trace());
  }
  throw error;
}

py::object PythonLeaf::call(int k, const At& at, Index out_size) const {
  Function& function = functions_[k];
  Borrowed borrowed(function.spare);
  return vectorcall(function, prepare(borrowed.frame, function, at, out_size));
}

/// Writes the result of the function to `out`.
void PythonLeaf::fill(int k, const At& at, VectorRef out) const {
  Function& function = functions_[k];
  Borrowed borrowed(function.spare);
  const Frame& frame = prepare(borrowed.frame, function, at, out.size());
  const py::object result = vectorcall(function, frame);
  if (in_place(function)) return take_out(function, frame, result, out);
  if (gives_matrix(function))
    require_matrix(result, expected_of(function, out.size()), text(whose(function), " returned"));
  read_result(k, at, result, out);
  if (function.role == Role::guard) refuse_integer_truth(function, result, out);
}

void PythonLeaf::read_result(int k, const At& at, py::handle result, VectorRef out) const {
  const Function& function = functions_[k];
  if (read_plain_numbers(result, out)) return;
  if (is_guard(function.role) && read_truths(result, out)) return;
  try {
    read_any_numbers(result, out, whose(function));
  } catch (ModelError& error) {
    if (function.role == Role::output) explain_result(k, at, error);
    throw;
  }
}

/// A guard that is the integer 0 is probably a truth, which 0 and 1 stand for. But a number that
/// leaves zero has not come to zero, so such a guard would not fire where it becomes 1.
void PythonLeaf::refuse_integer_truth(const Function& function, py::handle result,
                                      VectorRef out) const {
  if (!(out.array() == 0.0).any() || !has_integer(result)) return;
  const Direction direction = declarations().zero_crossings[function.index].direction;
  if (direction != Direction::negative_then_non_negative && direction != Direction::crosses_zero)
    return;
  throw ModelError(
      text(whose(function),
           " returned the integer 0, which is on neither side of zero: with the direction '",
           to_string(direction),
           "' it would not fire where it becomes 1. Return a truth, such as `return x > 0.3`, or a "
           "float "
           "if the event is where the number comes to zero"));
}

/// The result of an output does not fit: its shape may have been a guess.
void PythonLeaf::explain_result(int k, const At& at, ModelError& error) const {
  std::vector<Shape> shapes;
  for (int i = 0; i < count_of(declarations().inputs); ++i) {
    const Index size = at.u[i].size(), columns = at.u.columns(i);
    shapes.push_back(number_input(i, size, columns) ? Shape::scalar() : Shape{size, true, columns});
  }
  const OutputDeclaration& output = declarations().outputs[this->function(k).index];
  detail::explain_by_guess(error, [&] { output.shape_rule(shapes); });
}

bool PythonLeaf::gives_matrix(const Function& function) const {
  return function.role == Role::ode ? x_dimensions_.size() == 2 : function.columns > 0;
}

/// The shape that the result of a function has to have, if that is a matrix.
Dimensions PythonLeaf::expected_of(const Function& function, Index size) const {
  if (function.role == Role::ode) return x_dimensions_;
  return dimensions_of(Shape{size, true, function.columns});
}

void PythonLeaf::take_out(const Function& function, const Frame& frame, py::handle result,
                          VectorRef out) const {
  if (!result.is_none()) {
    throw ModelError(text(whose(function), " fills `out` and returned ",
                          std::string(py::repr(result)),
                          " as well; return nothing, or have no argument called out"));
  }
  const double* values = numbers_of(frame.out);
  for (Index i = 0; i < out.size(); ++i) {
    if (std::bit_cast<std::uint64_t>(values[i]) == unwritten) {
      throw ModelError(text(whose(function), " did not write entry ", i, " of ", out.size(),
                            " of `out`; set all of them: `out[:] = ...` (it begins as NaN: do not "
                            "add to it)"));
    }
    out[i] = values[i];
  }
}

}  // namespace saltus::python
