// Run::guarded: an exception ends a run, and leaves the last accepted state.
#pragma once

#include "saltus/base/detail/forced_unwind.hpp"
#include "saltus/simulation/detail/run.hpp"

namespace saltus {

/// Sets the status that `act` returns. An exception is a failure of the run, or events without end.
template <class Act>
void Run::guarded(const Act& act) {
  try {
    results_.status = act();
  } catch (const ChatteringError& error) {
    take_accepted();
    end({Status::chattering, error.block(), error.what()});
  } catch (const SimulationError& error) {
    fail(error.what());
    results_.block = error.block();
  } catch (const std::exception& error) {
    fail(error.what());
  } catch (...) {
    detail::pass_end_of_thread();
    fail("a function of the model threw");
  }
}

}  // namespace saltus
