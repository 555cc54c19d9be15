#include "framework/base/kept_array.hpp"

#include <array>
#include <bit>
#include <mutex>
#include <new>

namespace sluice {
namespace {

constexpr std::align_val_t line{64};
constexpr int parts = 4;  // classes to a power of two

// The class of a size, and the size of its arrays: (4 + k) 2^e for class 4 e + k.
struct SizeClass {
  int number;
  std::size_t bytes;
};
SizeClass class_of(std::size_t bytes) {
  constexpr std::size_t least = 64;
  const std::size_t wanted = bytes < least ? least : bytes;
  const int exponent =
      static_cast<int>(std::bit_width(wanted - 1)) - 3;  // 4 2^e <= wanted - 1 < 8 2^e
  const std::size_t unit = std::size_t{1} << exponent, count = (wanted + unit - 1) / unit;
  return {parts * exponent + static_cast<int>(count) - parts, count * unit};
}

constexpr std::size_t large = 4096;  // bytes, from which on arrays are kept for all threads

struct Free {
  Free* next;
};

// Free arrays by class of size.
struct FreeLists {
  std::array<Free*, parts * 64> first{};
  std::size_t bytes = 0;

  // Null: there is none.
  void* take(const SizeClass& size) {
    Free*& list = first[static_cast<std::size_t>(size.number)];
    if (list == nullptr) return nullptr;
    Free* const found = list;
    list = found->next;
    bytes -= size.bytes;
    return found;
  }
  void give(void* memory, const SizeClass& size) {
    Free*& list = first[static_cast<std::size_t>(size.number)];
    list = new (memory) Free{list};
    bytes += size.bytes;
  }
};

// `ended`: the thread gives back to the system from then on.
thread_local bool ended = false;
struct ListsOfThread : FreeLists {
  ~ListsOfThread() {
    ended = true;
    for (Free* list : first)
      while (list != nullptr) {
        Free* const next = list->next;
        ::operator delete(list, line);
        list = next;
      }
  }
};
FreeLists& own() {
  thread_local ListsOfThread of_thread;
  return of_thread;
}

// For all threads. It is never destroyed: arrays may be dropped while the program ends.
struct SharedLists {
  std::mutex mutex;
  FreeLists lists;
};
SharedLists& shared() {
  static SharedLists* const of_all = new SharedLists;
  return *of_all;
}

}  // namespace

void* KeptMemory::take(std::size_t bytes) {
  const SizeClass size = class_of(bytes);
  void* found = nullptr;
  if (size.bytes >= large) {
    SharedLists& of = shared();
    const std::lock_guard lock(of.mutex);
    found = of.lists.take(size);
  } else if (!ended) {
    found = own().take(size);
  }
  return found != nullptr ? found : ::operator new(size.bytes, line);
}

void KeptMemory::give(void* memory, std::size_t bytes) noexcept {
  if (memory == nullptr) return;
  const SizeClass size = class_of(bytes);
  if (size.bytes >= large) {
    SharedLists& of = shared();
    const std::lock_guard lock(of.mutex);
    return of.lists.give(memory, size);
  }
  if (ended) return ::operator delete(memory, line);
  own().give(memory, size);
}

std::size_t KeptMemory::kept() {
  SharedLists& of = shared();
  const std::lock_guard lock(of.mutex);
  return (ended ? 0 : own().bytes) + of.lists.bytes;
}

}  // namespace sluice
