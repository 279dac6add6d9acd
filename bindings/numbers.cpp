#include "numbers.hpp"
#include "interpreter.hpp"

#include <algorithm>
#include <functional>
#include <numeric>
#include <optional>
#include <span>
#include <string_view>

namespace saltus::python {

namespace {

/// Whether the entries of an array are real numbers. A cast of NumPy would drop an imaginary part,
/// read a text as a number, and count the days of a date.
bool is_real(const py::array& array) {
  constexpr std::string_view real = "biufO";  // objects, such as Fraction, convert themselves
  return real.find(array.dtype().kind()) != std::string_view::npos;
}

/// Whether an object is an ndarray itself, and of no class derived from it.
bool is_plain_array(py::handle object) {
  static const PyObject* const plain = py::type::of(py::array()).release().ptr();  // never freed
  return reinterpret_cast<const PyObject*>(Py_TYPE(object.ptr())) == plain;
}

/// Whether a masked array has an entry that its mask hides: that entry is no number.
bool has_masked_entries(py::handle object) {
  if (!py::isinstance<py::array>(object) || is_plain_array(object)) return false;
  return ask(py::module_::import("numpy").attr("ma").attr("is_masked"), object).cast<bool>();
}

/// The array of doubles that NumPy makes of an object; none, and no Python error, of what is not
/// real, is masked, or cannot be converted.
Array real_array(py::handle object) {
  const py::array array = py::array::ensure(object);
  Array numbers = py::reinterpret_steal<Array>(nullptr);
  if (array && is_real(array) && !has_masked_entries(object)) {
    numbers = Array::ensure(array);
    if (!numbers) PyErr_Clear(), numbers = Array::ensure(object);  // its objects convert themselves
  }
  if (!numbers) PyErr_Clear();
  return numbers;
}

/// "'fast' (str)", "an array of complex128", "None".
std::string described(py::handle object) {
  if (object.is_none()) return "None";
  if (has_masked_entries(object)) return "an array with masked entries";
  if (py::isinstance<py::array>(object))
    return text("an array of ", std::string(py::str(object.attr("dtype"))));
  const auto shown = ask(py::module_::import("reprlib").attr("repr"), object);
  return text(std::string(py::str(shown)), " (", Py_TYPE(object.ptr())->tp_name, ")");
}

/// Objects that numpy would convert to a number although nobody means a number.
bool is_text_or_none(py::handle object) {
  PyObject* const of = object.ptr();
  return object.is_none() || PyUnicode_Check(of) || PyBytes_Check(of) || PyByteArray_Check(of);
}

bool is_no_number(py::handle object) { return is_text_or_none(object) || !real_array(object); }

struct Entry {
  py::handle object;
  std::string place;  // "[0][2]" in lists of lists; empty for the object itself
};

/// The first object, or entry of a list, for which `is_wrong` is true.
template <class Wrong>
std::optional<Entry> entry_that(const Wrong& is_wrong, py::handle object, int depth = 0) {
  constexpr int deepest = 32;  // numpy has no more dimensions, and a list may hold itself
  PyObject* const of = object.ptr();
  if (!(PyList_Check(of) || PyTuple_Check(of)) || depth > deepest)
    return is_wrong(object) ? std::optional(Entry{object, ""}) : std::nullopt;
  for (py::ssize_t i = 0; i < PySequence_Fast_GET_SIZE(of); ++i) {
    auto found = entry_that(is_wrong, PySequence_Fast_GET_ITEM(of, i), depth + 1);
    if (found) return Entry{found->object, text("[", i, "]", found->place)};
  }
  return std::nullopt;
}

/// The reason why an object is not an array of numbers.
std::string not_numbers(py::handle object) {
  const auto found = entry_that(is_no_number, object);
  const std::string type = Py_TYPE(object.ptr())->tp_name;
  if (!found) return text("a ", type, " of entries of different lengths");
  if (found->place.empty()) return described(object);
  return text("a ", type, " whose entry ", found->place, " is ", described(found->object));
}

/// An array of doubles, or no array and no Python error.
Array numbers_in(py::handle object) {
  if (entry_that(is_text_or_none, object)) return py::reinterpret_steal<Array>(nullptr);
  const Array array = real_array(object);
  if (array || !py::hasattr(object, "toarray")) return array;
  return real_array(ask(object.attr("toarray")));  // a sparse matrix of SciPy
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

void require_matrix(py::handle result, const Dimensions& expected, const std::string& who) {
  if (expected.size() != 2 || !py::isinstance<py::array>(result)) return;
  const Dimensions found = dimensions_of(py::reinterpret_borrow<py::array>(result));
  if (found.size() < 2 || found == expected) return;
  throw ModelError(text(who, " an array of shape ", std::string(py::str(result.attr("shape"))),
                        ", expected (", expected[0], ", ", expected[1], ")"));
}

Dimensions dimensions_of(const Shape& shape, Dimensions before) {
  if (shape.is_matrix()) before.push_back(shape.rows());
  if (shape.vector) before.push_back(shape.is_matrix() ? shape.columns : shape.size);
  return before;
}

Shape shape_of(const Dimensions& dimensions, const std::string& what) {
  if (dimensions.empty()) return Shape::scalar();
  if (dimensions.size() == 1) return Shape::of(dimensions[0]);
  if (dimensions.size() > 2)
    throw ModelError(text(what, ": expected a number, a vector or a matrix, found an array of ",
                          dimensions.size(), " dimensions"));
  if (dimensions[0] == 0 || dimensions[1] == 0)
    throw ModelError(text(what, ": expected a matrix of at least one row and one column, found ",
                          dimensions[0], " x ", dimensions[1]));
  return Shape::matrix(dimensions[0], dimensions[1]);
}

py::array read_only_array(const Dimensions& dimensions, const double* values) {
  Array array(dimensions);
  if (values != nullptr) std::copy_n(values, array.size(), array.mutable_data());
  py::detail::array_proxy(array.ptr())->flags &= ~py::detail::npy_api::NPY_ARRAY_WRITEABLE_;
  return array;
}

Array to_array(py::handle numbers, const std::string& what) {
  Array array = numbers_in(numbers);
  if (!array) throw ModelError(text(what, ": expected numbers, found ", not_numbers(numbers)));
  return array;
}

Eigen::VectorXd to_vector(py::handle numbers, const std::string& what) {
  return as_vector(to_array(numbers, what));
}

namespace {

MatrixView as_matrix(const Array& array, const Shape& shape) {
  return {array.data(), shape.rows(), shape.columns};
}

}  // namespace

Value to_value(py::handle numbers, const std::string& what) {
  const Array array = to_array(numbers, what);
  if (array.ndim() == 0) return *array.data();
  if (array.ndim() == 1) return as_vector(array);
  return as_matrix(array, shape_of(dimensions_of(array), what));
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

/// The two truths of NumPy, each of which is one object; never freed.
py::handle numpy_true, numpy_false;

/// A single truth, of Python or of NumPy; nothing for any other object.
std::optional<bool> truth_of(py::handle result) {
  if (result.ptr() == Py_True || result.is(numpy_true)) return true;
  if (result.ptr() == Py_False || result.is(numpy_false)) return false;
  return std::nullopt;
}

/// Reads an int that a double can hold.
bool read_integer(PyObject* object, VectorRef out) {
  if (out.size() != 1) return false;
  out[0] = PyLong_AsDouble(object);
  const bool held = PyErr_Occurred() == nullptr;
  if (!held) PyErr_Clear();
  return held;
}

}  // namespace

bool read_plain_numbers(py::handle result, VectorRef out) {
  PyObject* const object = result.ptr();
  if (PyFloat_Check(object)) {
    if (out.size() == 1) out[0] = PyFloat_AS_DOUBLE(object);
    return out.size() == 1;
  }
  if (is_plain_array(result)) return read_array(result, out);
  if (PyLong_CheckExact(object)) return read_integer(object, out);  // no bool
  if (PyList_CheckExact(object) || PyTuple_CheckExact(object)) {
    return read_items(PySequence_Fast_ITEMS(object), PySequence_Fast_GET_SIZE(object), out);
  }
  return false;
}

void read_any_numbers(py::handle result, VectorRef out, const std::string& what) {
  if (result.is_none())
    throw ModelError(
        text(what, " returned None, expected ", out.size(), " numbers; is a `return` missing?"));
  if (const auto truth = truth_of(result); truth && out.size() == 1) {
    out[0] = *truth ? 1.0 : 0.0;
    return;
  }
  const Array array = numbers_in(result);
  if (!array) {
    throw ModelError(
        text(what, " returned ", not_numbers(result), ", expected ", out.size(), " numbers"));
  }
  if (array.size() != out.size()) {
    throw ModelError(text(what, " returned ", array.size(), " numbers, expected ", out.size()));
  }
  out = as_vector(array);
}

bool read_truths(py::handle result, VectorRef out) {
  if (const auto truth = truth_of(result); truth && out.size() == 1) {
    out[0] = *truth ? 1.0 : -1.0;
    return true;
  }
  const py::array array = py::array::ensure(result);
  if (!array) PyErr_Clear();
  if (!array || array.dtype().kind() != 'b' || array.size() != out.size()) return false;
  out = (2.0 * as_vector(Array(array)).array() - 1.0).matrix();
  return true;
}

bool has_integer(py::handle result) {
  if (PyFloat_Check(result.ptr())) return false;
  if (PyLong_CheckExact(result.ptr())) return true;
  if (PyList_CheckExact(result.ptr()) || PyTuple_CheckExact(result.ptr()))
    return std::ranges::any_of(
        std::span(PySequence_Fast_ITEMS(result.ptr()),
                  static_cast<std::size_t>(PySequence_Fast_GET_SIZE(result.ptr()))),
        [](PyObject* item) { return PyLong_CheckExact(item) != 0; });
  const py::array array = py::array::ensure(result);
  if (!array) return PyErr_Clear(), false;
  return array.dtype().kind() == 'i' || array.dtype().kind() == 'u';
}

void bind_numbers(py::module_& module) {
  const auto numpy = py::module_::import("numpy");
  numpy_true = py::object(numpy.attr("True_")).release();
  numpy_false = py::object(numpy.attr("False_")).release();
  module.def(
      "numbers", &to_array, py::arg("numbers"), py::arg("what"),
      "Numbers as an array of doubles. ModelError that begins with `what` for what is none.");
}

}  // namespace saltus::python
