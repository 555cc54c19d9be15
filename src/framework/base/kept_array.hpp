// A std::vector whose memory, once given back, is kept for the next of about its size: what a step
// makes and drops costs the system nothing in the next.
#pragma once
#include <cstddef>
#include <vector>

namespace sluice {

// Bytes of arrays on cache lines, by classes of size: four to each power of two. Each thread keeps
// what it gives back of small arrays until it ends; large ones are kept for all threads, so that
// what one makes and another drops does not grow.
class KeptMemory {
 public:
  // At least so many bytes. Throws std::bad_alloc.
  static void* take(std::size_t bytes);
  // Of as many as were asked for.
  static void give(void* memory, std::size_t bytes) noexcept;
  // What this thread keeps and what is kept for all, bytes.
  static std::size_t kept();
};

template <class T>
struct KeepingAllocator {
  using value_type = T;

  KeepingAllocator() = default;
  template <class U>
  KeepingAllocator(const KeepingAllocator<U>&) {}
  T* allocate(std::size_t n) { return static_cast<T*>(KeptMemory::take(n * sizeof(T))); }
  void deallocate(T* p, std::size_t n) { KeptMemory::give(p, n * sizeof(T)); }
  template <class U>
  bool operator==(const KeepingAllocator<U>&) const {
    return true;
  }
};

template <class T>
using KeptArray = std::vector<T, KeepingAllocator<T>>;

}  // namespace sluice
