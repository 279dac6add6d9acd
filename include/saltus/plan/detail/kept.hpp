// Kept: a value that is computed from a plan when somebody first asks for it, and kept with the
// plan.
#pragma once

#include <memory>
#include <mutex>

namespace saltus {

/// One value of a plan. Threads may ask for it at the same time.
template <class T>
class Kept {
 public:
  /// The value; `make()` makes it, if there is none yet.
  template <class Make>
  std::shared_ptr<const T> get(const Make& make) {
    const std::scoped_lock lock(one_at_a_time_);
    if (made_ == nullptr) made_ = std::make_shared<const T>(make());
    return made_;
  }
  /// Drops the value, because the functions of the plan have changed.
  void forget() {
    const std::scoped_lock lock(one_at_a_time_);
    made_ = nullptr;
  }

 private:
  std::mutex one_at_a_time_;
  std::shared_ptr<const T> made_;
};

}  // namespace saltus
