#include "framework/base/kept_array.hpp"

#include <array>
#include <bit>
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

struct Free {
  Free* next;
};
// A thread's free arrays by class. `ended`: the thread gives back to the system from then on.
thread_local bool ended = false;
struct FreeLists {
  std::array<Free*, parts * 64> first{};
  std::size_t bytes = 0;
  ~FreeLists() {
    ended = true;
    for (Free* list : first)
      while (list != nullptr) {
        Free* const next = list->next;
        ::operator delete(list, line);
        list = next;
      }
  }
};
FreeLists& lists() {
  thread_local FreeLists of_thread;
  return of_thread;
}

}  // namespace

void* KeptMemory::take(std::size_t bytes) {
  const SizeClass size = class_of(bytes);
  if (ended) return ::operator new(size.bytes, line);
  FreeLists& of = lists();
  Free*& first = of.first[static_cast<std::size_t>(size.number)];
  if (first == nullptr) return ::operator new(size.bytes, line);
  Free* const found = first;
  first = found->next;
  of.bytes -= size.bytes;
  return found;
}

void KeptMemory::give(void* memory, std::size_t bytes) noexcept {
  if (memory == nullptr) return;
  const SizeClass size = class_of(bytes);
  if (ended) return ::operator delete(memory, line);
  FreeLists& of = lists();
  Free*& first = of.first[static_cast<std::size_t>(size.number)];
  first = new (memory) Free{first};
  of.bytes += size.bytes;
}

std::size_t KeptMemory::kept() {
  return ended ? 0 : lists().bytes;
}

}  // namespace sluice
