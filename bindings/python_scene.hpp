// A scene that Python describes: its system and context, and functions for its known answer.
#pragma once

#include <memory>
#include <string>
#include <utility>

#include "interpreter.hpp"
#include "numbers.hpp"
#include "saltus/report/scene.hpp"

namespace saltus::python {

/// A Python function held by C++. The owner that drops the last reference first acquires the
/// interpreter lock.
class HeldFunction {
 public:
  explicit HeldFunction(py::object function)
      : function_(new py::object(std::move(function)), [](py::object* held) {
          const Locked lock;
          delete held;
        }) {}
  const py::object& operator*() const { return *function_; }

 private:
  std::shared_ptr<py::object> function_;
};

/// f(t, row) -> number, with `row` as a NumPy vector.
inline std::function<double(double, const Eigen::VectorXd&)> row_function(py::object function,
                                                                          std::string what) {
  return [held = HeldFunction(std::move(function)), what = std::move(what)](
             double t, const Eigen::VectorXd& row) {
    return locked([&] {
      const Eigen::VectorXd value =
          to_vector((*held)(t, read_only_array({row.size()}, row.data())), what);
      if (value.size() != 1)
        throw ModelError(text(what, ": expected one number, found ", value.size()));
      return value[0];
    });
  };
}

}  // namespace saltus::python
