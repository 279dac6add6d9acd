// C++ Results as a Python object.
#pragma once

#include <memory>
#include <utility>

#include "bindings.hpp"
#include "saltus/simulation/results.hpp"

namespace saltus::python {

/// Results that Python has.
struct Record : Results {
  explicit Record(Results results, bool continued = false)
      : Results(std::move(results)), goes_on(continued) {}
  /// A simulator may take the rows back, so arrays are copies, which a user may write to.
  bool goes_on;
};

/// The Python exception that ended a run, unchanged if Python code raised it. None if nothing was
/// thrown.
py::object cause_of(const Results& results);

}  // namespace saltus::python
