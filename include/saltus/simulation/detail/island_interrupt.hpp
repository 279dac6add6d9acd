// IslandInterrupt: the question to the user whether a run by islands has to stop.
#pragma once

#include <atomic>
#include <chrono>
#include <exception>
#include <functional>
#include <thread>
#include <utility>

namespace saltus {

/// An island asks at most every 20 ms of its own run, and many islands are shorter, so this looks at
/// the clock again. Only the thread that called the run asks the user; the islands on other threads
/// look at the answer.
class IslandInterrupt {
 public:
  using Clock = std::chrono::steady_clock;

  /// `ask` is the user's function, which may be empty. `note` is called before it, so that the user sees
  /// how far the run has come.
  IslandInterrupt(std::function<bool()> ask, std::function<void()> note)
      : ask_(std::move(ask)), note_(std::move(note)) {}

  /// A run begins.
  void begin() { raised_ = nullptr; }
  /// The calling thread goes on with the run.
  void begin_piece() { asked_ = Clock::now(), caller_ = std::this_thread::get_id(), stop_ = false; }
  /// Islands run again, and cannot be interrupted: they have run so far before.
  void run_again(bool again) { again_ = again; }

  bool is_on_caller() const { return std::this_thread::get_id() == caller_; }
  /// Whether the user stopped the run.
  bool stops() const noexcept { return stop_; }

  /// Whether the run has to stop. Passes an exception of the user's function on.
  bool asks();
  /// The same between two islands, where no run takes an exception of the user's function: it is kept.
  bool asks_between();
  /// What the user's function has raised, if it did.
  const std::exception_ptr& raised() const noexcept { return raised_; }
  void keep(std::exception_ptr raised) { raised_ = std::move(raised); }

 private:
  bool ask_user();

  std::function<bool()> ask_;
  std::function<void()> note_;
  bool again_ = false;
  std::exception_ptr raised_;
  std::thread::id caller_{};
  std::atomic<bool> stop_{false};  // the islands on other threads have to stop
  Clock::time_point asked_{};
};

}  // namespace saltus
