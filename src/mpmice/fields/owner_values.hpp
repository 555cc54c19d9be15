// Numbers of cells that one rank knows, made known to all: bit by bit, so that none is rounded.
#pragma once
#include <bit>

#include "mpmice/geometry/cell_sums.hpp"

namespace sluice::mpmice {

template <int D>
class OwnerValues {
 public:
  void begin(const CellBlocks<D>& cells, int lanes) { sums_.begin(cells, lanes); }
  // By the one rank that knows it.
  void put(int lane, std::size_t cell, double value) {
    sums_.lane(lane)[cell] = std::bit_cast<std::uint64_t>(value);
  }
  void share(Communicator& ranks) { sums_.sum_over_ranks(ranks); }
  CellSums<D>& sums() { return sums_; }  // to be shared with others
  std::size_t size() const { return sums_.cells().size(); }
  double value(int lane, std::size_t cell) const {
    return std::bit_cast<double>(sums_.lane(lane)[cell]);
  }
  void take(int lane, KeptArray<double>& to) const {
    to.resize(size());
    for (std::size_t i = 0; i < to.size(); ++i) to[i] = value(lane, i);
  }

 private:
  CellSums<D> sums_;
};

}  // namespace sluice::mpmice
