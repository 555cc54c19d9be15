// Memory for the bonds of tiles: large blocks, in huge pages where the system has them, from which
// tiles take one after the other. Filling it with small pages costs more than finding the bonds.
#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace sluice::peridynamics {

class BondMemory {
 public:
  // A copy that begins on a cache line and stays where it is while this lives.
  template <class T>
  std::span<T> keep(const std::vector<T>& values) {
    T* to = static_cast<T*>(take(values.size() * sizeof(T)));
    std::copy(values.begin(), values.end(), to);
    return {to, values.size()};
  }
  std::size_t bytes() const { return bytes_; }

 private:
  struct Free {
    void operator()(std::byte* memory) const;
  };
  void* take(std::size_t bytes);

  std::vector<std::unique_ptr<std::byte, Free>> blocks_;
  std::byte *next_ = nullptr, *end_ = nullptr;
  std::size_t bytes_ = 0;
};

}  // namespace sluice::peridynamics
