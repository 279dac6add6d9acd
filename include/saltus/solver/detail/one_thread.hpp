// Whether a solver may start threads.
#pragma once

#include <utility>

namespace saltus {

/// While it lives, the solvers that this thread calls start no other threads: an ensemble has put
/// its runs on all cores.
class OneThread {
 public:
  OneThread() : before_(std::exchange(asked_, true)) {}
  ~OneThread() { asked_ = before_; }
  OneThread(const OneThread&) = delete;
  OneThread& operator=(const OneThread&) = delete;

  /// Whether the calling thread asked for it.
  static bool asked() { return asked_; }

 private:
  static inline thread_local bool asked_ = false;
  bool before_;
};

}  // namespace saltus
