// How often memory was asked for: by new, by Eigen, by SUNDIALS. All of them come to malloc.
#pragma once

namespace support {

/// Calls of malloc, calloc and realloc since the program began; -1 where they cannot be counted
/// (sanitizers, other C libraries than glibc).
long allocations();
/// How many bytes these asked for, all in all; -1 as above.
long allocated_bytes();

/// What `act` asked for.
template <class Act>
long allocations_of(Act act) {
  const long before = allocations();
  act();
  return before < 0 ? -1 : allocations() - before;
}

}  // namespace support
