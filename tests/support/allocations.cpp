// Counts the calls of malloc. glibc lets a program bring its own malloc and reach that of the
// library under another name.
#include "support/allocations.hpp"

#include <atomic>
#include <cstddef>
#include <cstdlib>

#if defined(__GLIBC__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)

namespace {
std::atomic<long> count{0}, sum{0};

void counted(std::size_t bytes) {
  count.fetch_add(1, std::memory_order_relaxed);
  sum.fetch_add(static_cast<long>(bytes), std::memory_order_relaxed);
}
}  // namespace

extern "C" {
void* __libc_malloc(std::size_t);  // NOLINT(bugprone-reserved-identifier): the names glibc has
void* __libc_calloc(std::size_t, std::size_t);
void* __libc_realloc(void*, std::size_t);

void* malloc(std::size_t size) {
  counted(size);
  return __libc_malloc(size);
}
void* calloc(std::size_t number, std::size_t size) {
  counted(number * size);
  return __libc_calloc(number, size);
}
void* realloc(void* old, std::size_t size) {
  counted(size);
  return __libc_realloc(old, size);
}
}

long support::allocations() { return count.load(std::memory_order_relaxed); }
long support::allocated_bytes() { return sum.load(std::memory_order_relaxed); }

#else

long support::allocations() { return -1; }
long support::allocated_bytes() { return -1; }

#endif
