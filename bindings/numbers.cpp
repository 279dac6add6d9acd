#include "numbers.hpp"

#include <functional>
#include <numeric>

namespace saltus::python {

namespace {

std::string type_name(py::handle object) {
  return object.is_none() ? "None" : Py_TYPE(object.ptr())->tp_name;
}

[[noreturn]] void throw_no_numbers(py::handle found, const std::string& what) {
  PyErr_Clear();
  throw ModelError(text(what, ": expected numbers, found ", type_name(found)));
}

}  // namespace

double* numbers_of(py::handle array) {
  return reinterpret_cast<double*>(py::detail::array_proxy(array.ptr())->data);
}

Index size_of(py::handle array) {
  const auto* proxy = py::detail::array_proxy(array.ptr());
  return std::accumulate(proxy->dimensions, proxy->dimensions + proxy->nd, Index{1},
                         std::multiplies<>());
}

Dimensions dimensions_of(const py::array& array) {
  return {array.shape(), array.shape() + array.ndim()};
}

py::array read_only_array(const Dimensions& dimensions, const double* values) {
  Array array(dimensions);
  if (values != nullptr) std::copy_n(values, array.size(), array.mutable_data());
  py::detail::array_proxy(array.ptr())->flags &= ~py::detail::npy_api::NPY_ARRAY_WRITEABLE_;
  return array;
}

Array to_array(py::handle numbers, const std::string& what) {
  if (numbers.is_none()) throw_no_numbers(numbers, what);  // numpy would make it NaN
  Array array = Array::ensure(numbers);                    // refuses complex numbers and texts
  if (!array) throw_no_numbers(numbers, what);
  return array;
}

Eigen::VectorXd to_vector(py::handle numbers, const std::string& what) {
  return as_vector(to_array(numbers, what));
}

Value to_value(py::handle numbers, const std::string& what) {
  const Array array = to_array(numbers, what);
  if (array.ndim() == 0) return *array.data();
  if (array.ndim() == 1) return as_vector(array);
  throw ModelError(text(what, ": expected a number or a vector, found an array of ", array.ndim(),
                        " dimensions"));
}

std::optional<Value> to_optional_value(py::handle numbers, const std::string& what) {
  return numbers.is_none() ? std::nullopt : std::optional(to_value(numbers, what));
}

namespace {

bool read_array(py::handle array, VectorRef out) {
  static const PyObject* const doubles = py::dtype::of<double>().release().ptr();  // never freed
  constexpr int plain =
      py::detail::npy_api::NPY_ARRAY_C_CONTIGUOUS_ | py::detail::npy_api::NPY_ARRAY_ALIGNED_;
  const auto* proxy = py::detail::array_proxy(array.ptr());
  if (proxy->descr != doubles || (proxy->flags & plain) != plain || size_of(array) != out.size())
    return false;
  std::copy_n(numbers_of(array), out.size(), out.data());
  return true;
}

bool read_items(PyObject** items, py::ssize_t count, VectorRef out) {
  if (count != out.size()) return false;
  for (Index i = 0; i < out.size(); ++i) {
    if (!PyFloat_Check(items[i])) return false;
    out[i] = PyFloat_AS_DOUBLE(items[i]);
  }
  return true;
}

}  // namespace

bool read_plain_numbers(py::handle result, VectorRef out) {
  PyObject* const object = result.ptr();
  if (PyFloat_Check(object)) {
    if (out.size() == 1) out[0] = PyFloat_AS_DOUBLE(object);
    return out.size() == 1;
  }
  if (py::isinstance<py::array>(result)) return read_array(result, out);
  if (PyList_CheckExact(object) || PyTuple_CheckExact(object)) {
    return read_items(PySequence_Fast_ITEMS(object), PySequence_Fast_GET_SIZE(object), out);
  }
  return false;
}

void read_any_numbers(py::handle result, VectorRef out, const std::string& what) {
  if (result.is_none())
    throw ModelError(
        text(what, " returned None, expected ", out.size(), " numbers; is a `return` missing?"));
  const Array array = Array::ensure(result);
  if (!array) {
    PyErr_Clear();
    throw ModelError(
        text(what, " returned a ", type_name(result), ", expected ", out.size(), " numbers"));
  }
  if (array.size() != out.size()) {
    throw ModelError(text(what, " returned ", array.size(), " numbers, expected ", out.size()));
  }
  out = as_vector(array);
}

}  // namespace saltus::python
