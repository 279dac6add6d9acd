// The lock of the interpreter during a run: given back for the run, taken for each call of Python.
#pragma once

#include <optional>
#include <utility>

#include "bindings.hpp"

namespace saltus::python {

/// The thread's state in the interpreter while a run has given back the lock; null otherwise.
inline thread_local PyThreadState* resting = nullptr;

/// Gives the lock back, for as long as it lives. A run in a callback of a run gives it back again.
class Unlocked {
 public:
  Unlocked() : outer_(std::exchange(resting, nullptr)) { resting = PyEval_SaveThread(); }
  ~Unlocked() { PyEval_RestoreThread(std::exchange(resting, outer_)); }
  Unlocked(const Unlocked&) = delete;
  Unlocked& operator=(const Unlocked&) = delete;

 private:
  PyThreadState* outer_;
};

/// Takes the lock, for as long as it lives. In a run the thread's own state is at hand, which is
/// quicker than to have it looked up; another thread waiting for the lock gets it between calls.
class Locked {
 public:
  Locked() {
    if (resting != nullptr && PyGILState_Check() == 0) {
      PyEval_RestoreThread(mine_ = std::exchange(resting, nullptr));
    } else {
      looked_up_.emplace();
    }
  }
  ~Locked() {
    if (mine_ != nullptr) resting = PyEval_SaveThread();
  }
  Locked(const Locked&) = delete;
  Locked& operator=(const Locked&) = delete;

 private:
  PyThreadState* mine_ = nullptr;
  std::optional<py::gil_scoped_acquire> looked_up_;
};

}  // namespace saltus::python
