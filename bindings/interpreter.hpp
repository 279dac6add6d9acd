// The interpreter lock during a run: released for the run, acquired for each call of Python.
#pragma once

#include <optional>
#include <utility>

#include "bindings.hpp"

namespace saltus::python {

/// The thread's state in the interpreter while a run has released the lock; null otherwise.
inline thread_local PyThreadState* resting = nullptr;

/// Releases the lock as long as it lives. A run inside a callback of another run releases it again.
class Unlocked {
 public:
  Unlocked() : outer_(std::exchange(resting, nullptr)) { resting = PyEval_SaveThread(); }
  ~Unlocked() { PyEval_RestoreThread(std::exchange(resting, outer_)); }
  Unlocked(const Unlocked&) = delete;
  Unlocked& operator=(const Unlocked&) = delete;

 private:
  PyThreadState* outer_;
};

/// Acquires the lock as long as it lives. In a run the thread's own state is stored, which is
/// faster than a look-up. Another thread that waits for the lock gets it between calls.
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
