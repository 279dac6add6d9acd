// Turn: the one caller that a run has at a time.
#pragma once

#include <atomic>
#include <string>
#include <string_view>
#include <thread>

#include "saltus/base/error.hpp"

namespace saltus {

/// The thread that uses a run now; none while the run is not used.
using Caller = std::atomic<std::thread::id>;

/// Claims a run as long as it lives. Throws Error, and changes nothing, while another call uses it:
/// a call of another thread, or a call that led here through a callback.
class Turn {
 public:
  Turn(Caller& caller, const double& t, std::string_view what) : caller_(&caller) {
    std::thread::id found{};
    const std::thread::id mine = std::this_thread::get_id();
    if (caller.compare_exchange_strong(found, mine)) return;
    // Only the thread of the run may read its time.
    const std::string when = found == mine ? text("t = ", t, " s: ") : "";
    throw Error(text(when, what, " was called ",
                     found == mine ? "by a callback of the run itself"
                                   : "while another thread uses the simulator",
                     "; expected one call at a time: use a simulator of its own for each caller"));
  }
  ~Turn() { *caller_ = std::thread::id(); }
  Turn(const Turn&) = delete;
  Turn& operator=(const Turn&) = delete;

 private:
  Caller* caller_;
};

}  // namespace saltus
