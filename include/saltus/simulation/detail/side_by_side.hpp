// Tasks side by side: the calling thread and helpers take them in turn, and the caller looks up from
// time to time.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

#include "saltus/base/detail/forced_unwind.hpp"
#include "saltus/solver/detail/one_thread.hpp"

namespace saltus {

/// Runs `task(i)` for i from 0 to `count` - 1 on `threads` threads, one of which is the caller's.
/// While the caller waits for the others it calls `look()` every 20 ms. Rethrows the first exception
/// of a task or of `look`, after all threads have ended; no further task begins then.
template <class Task, class Look>
void side_by_side(std::size_t count, std::size_t threads, const Task& task, const Look& look) {
  constexpr auto asks_every = std::chrono::milliseconds(20);  // as often as a run asks `interrupt`
  std::atomic<std::size_t> next{0};
  std::mutex mutex;
  std::condition_variable ended;
  std::size_t working = threads - 1;
  std::exception_ptr thrown;
  const auto guarded = [&](const auto& act) {
    try {
      act();
    } catch (...) {
      detail::pass_end_of_thread();
      const std::lock_guard lock(mutex);
      if (!thrown) thrown = std::current_exception();
      next = count;
    }
  };
  const auto work = [&] {
    const OneThread alone;
    guarded([&] {
      for (std::size_t i; (i = next.fetch_add(1)) < count;) task(i);
    });
  };
  std::vector<std::jthread> helpers;
  for (std::size_t i = 0; i + 1 < threads; ++i)
    helpers.emplace_back([&] {
      work();
      const std::lock_guard lock(mutex);
      --working;
      ended.notify_one();
    });
  work();
  std::unique_lock lock(mutex);
  while (!ended.wait_for(lock, asks_every, [&] { return working == 0; })) {
    lock.unlock();
    guarded(look);
    lock.lock();
  }
  lock.unlock();
  helpers.clear();  // they have ended, and nothing of this call may be destroyed before them
  if (thrown) std::rethrow_exception(thrown);
}

}  // namespace saltus
