// Counts the requests for memory by new, by Eigen and by SUNDIALS. All of them call malloc.
#pragma once

namespace support {

/// The number of calls of malloc, calloc and realloc since the program began; -1 if they cannot be
/// counted (sanitizers, other C libraries than glibc).
long allocations();
/// The number of bytes that these calls requested in total; -1 as above.
long allocated_bytes();

/// The requests of `act`.
template <class Act>
long allocations_of(Act act) {
  const long before = allocations();
  act();
  return before < 0 ? -1 : allocations() - before;
}

}  // namespace support
