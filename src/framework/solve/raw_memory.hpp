// Memory whose numbers have no value until one is written: pages that nobody touches take no room,
// and those that came back from the heap are not cleared.
#pragma once
#include <memory>
#include <utility>
#include <vector>

namespace sluice::solve {

template <class T>
struct RawMemory : std::allocator<T> {
  template <class U>
  struct rebind {
    using other = RawMemory<U>;
  };
  // Elements without a value given have none.
  template <class U>
  void construct(U*) {}
  template <class U, class V>
  void construct(U* at, V&& value) {
    std::construct_at(at, std::forward<V>(value));
  }
};

template <class T>
using RawVector = std::vector<T, RawMemory<T>>;

}  // namespace sluice::solve
