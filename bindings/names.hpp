// Methods and linear solvers are strings in Python. An unknown name is at once a ModelError with
// the nearest known name.
#pragma once

#include <pybind11/pybind11.h>

#include "saltus/solver/linear_solver.hpp"
#include "saltus/solver/method.hpp"

namespace saltus::python {

/// A caster for an enum with a table of names.
template <class Choice, Choice (*from)(std::string_view)>
struct NamedChoice {
  PYBIND11_TYPE_CASTER(Choice, pybind11::detail::const_name("str"));

  bool load(pybind11::handle given, bool) {
    if (!pybind11::isinstance<pybind11::str>(given)) return false;
    value = from(pybind11::cast<std::string>(given));
    return true;
  }
  static pybind11::handle cast(Choice choice, pybind11::return_value_policy, pybind11::handle) {
    return pybind11::str(std::string(to_string(choice))).release();
  }
};

}  // namespace saltus::python

template <>
struct pybind11::detail::type_caster<saltus::Method>
    : saltus::python::NamedChoice<saltus::Method, &saltus::method_from> {};

template <>
struct pybind11::detail::type_caster<saltus::LinearSolver>
    : saltus::python::NamedChoice<saltus::LinearSolver, &saltus::linear_solver_from> {};
