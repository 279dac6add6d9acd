// The interpreter lock during a run: released for the run, acquired for each call of Python.
#pragma once

#include <cxxabi.h>
#include <chrono>
#include <optional>
#include <thread>
#include <utility>

#include "bindings.hpp"

namespace saltus::python {

/// The thread's state in the interpreter while a run has released the lock; null otherwise.
inline thread_local PyThreadState* resting = nullptr;

/// Runs code of Python or waits for its lock. When the interpreter shuts down, it ends every other
/// thread that does either, by pthread_exit in that thread. C++ cannot let this unwinding pass,
/// because a destructor on the way would need the lock again. So the thread waits for the end of
/// the process, as it does in Python 3.14.
template <class Work>
decltype(auto) until_shutdown(Work work) {
#ifdef __GLIBCXX__
  try {
    return work();
  } catch (const abi::__forced_unwind&) {
    for (;;) std::this_thread::sleep_for(std::chrono::hours(1));
  }
#else
  return work();
#endif
}

/// Calls a function of Python, which may run any code and wait for the lock. The unwinding of a thread that
/// the interpreter ends (see until_shutdown) meets no destructor of a Python object here. In a call by
/// pybind11, `function(...)`, it meets that of the arguments.
inline py::object ask_with(py::handle function, const py::tuple& arguments,
                           const py::dict& keywords) {
  PyObject* const result = until_shutdown(
      [&] { return PyObject_Call(function.ptr(), arguments.ptr(), keywords.ptr()); });
  if (result == nullptr) throw py::error_already_set();
  return py::reinterpret_steal<py::object>(result);
}
template <class... Arguments>
py::object ask(py::handle function, Arguments&&... arguments) {
  return ask_with(function, py::make_tuple(std::forward<Arguments>(arguments)...), py::dict());
}

/// Releases the lock as long as it lives. A run inside a callback of another run releases it again.
class Unlocked {
 public:
  Unlocked() : outer_(std::exchange(resting, nullptr)) { resting = PyEval_SaveThread(); }
  ~Unlocked() {
    until_shutdown([this] { PyEval_RestoreThread(std::exchange(resting, outer_)); });
  }
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
      until_shutdown([this] { PyEval_RestoreThread(mine_ = std::exchange(resting, nullptr)); });
    } else {
      until_shutdown([this] { looked_up_.emplace(); });
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

/// Calls `work`, which uses Python, under the lock. Every thread of a run uses Python in this way.
template <class Work>
decltype(auto) locked(Work work) {
  const Locked lock;
  return until_shutdown(work);
}

}  // namespace saltus::python
