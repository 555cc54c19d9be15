#include "peridynamics/bonds/bond_memory.hpp"

#include <sys/mman.h>

#include <new>

namespace sluice::peridynamics {
namespace {

constexpr std::size_t line = 64, page = std::size_t{2} << 20;  // bytes
constexpr std::size_t largest_block = 16 * page;

}  // namespace

void BondMemory::Free::operator()(std::byte* memory) const {
  ::operator delete(memory, std::align_val_t{page});
}

// Blocks grow from one page on, so that small bodies take little.
void* BondMemory::take(std::size_t bytes) {
  bytes = (bytes + line - 1) / line * line;
  if (bytes > static_cast<std::size_t>(end_ - next_)) {
    const std::size_t grown = std::min(largest_block, std::max(page, bytes_ / page * page));
    const std::size_t size = std::max(grown, (bytes + page - 1) / page * page);
    next_ = static_cast<std::byte*>(::operator new(size, std::align_val_t{page}));
    end_ = next_ + size;
    blocks_.emplace_back(next_);
    madvise(next_, size, MADV_HUGEPAGE);  // advice: without it all works, slower
  }
  bytes_ += bytes;
  void* const found = next_;
  next_ += bytes;
  return found;
}

}  // namespace sluice::peridynamics
