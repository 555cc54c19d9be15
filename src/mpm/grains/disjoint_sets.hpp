// Which things belong together, by pairs that are told one after the other.
#pragma once
#include <cstddef>
#include <numeric>
#include <vector>

namespace sluice::mpm {

class DisjointSets {
 public:
  explicit DisjointSets(std::size_t count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), std::size_t{0});
  }

  std::size_t count() const { return parent_.size(); }
  // One of the set of n, the same for all of them until sets are united.
  std::size_t find(std::size_t n) {
    while (parent_[n] != n) n = parent_[n] = parent_[parent_[n]];  // ways get half as long
    return n;
  }
  // The smaller root stays: no set needs more than its own ways.
  void unite(std::size_t a, std::size_t b) {
    a = find(a);
    b = find(b);
    if (a < b)
      parent_[b] = a;
    else
      parent_[a] = b;
  }

 private:
  std::vector<std::size_t> parent_;
};

}  // namespace sluice::mpm
