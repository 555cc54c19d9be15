// Flags of the cells of one level, a bit each: which of them ask for a finer level.
//
// Rows along x are padded to whole words, so that widening and searching work on 64 cells at a
// time. Two fields of the same domain are joined by the bitwise or of their words.
#pragma once
#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <vector>

#include "framework/grid/index_box.hpp"

namespace sluice {

class FlagField {
 public:
  explicit FlagField(const IndexBox& domain = {});
  const IndexBox& domain() const { return domain_; }

  void set(IntVec3 cell) {
    const IntVec3 c = cell - domain_.lower;
    row(c.y, c.z)[c.x / 64] |= std::uint64_t{1} << (c.x % 64);
  }
  void fill(const IndexBox& cells);  // its part inside the domain
  bool get(IntVec3 cell) const {
    const IntVec3 c = cell - domain_.lower;
    return (row(c.y, c.z)[c.x / 64] >> (c.x % 64) & 1u) != 0;
  }
  bool any() const;
  bool any(const IndexBox& cells) const;
  std::int64_t count() const;
  // Every cell within `reach` of a flag (a box filter), around periodic directions too.
  FlagField dilated(IntVec3 reach, const std::array<bool, 3>& periodic) const;

  std::vector<std::uint64_t>& words() { return words_; }
  const std::vector<std::uint64_t>& words() const { return words_; }
  // Row (y, z), counted from the domain's low corner; bit x stands for its x-th cell.
  std::size_t words_a_row() const { return row_words_; }
  const std::uint64_t* row(int y, int z) const { return words_.data() + row_start(y, z); }
  std::uint64_t* row(int y, int z) { return words_.data() + row_start(y, z); }

  FlagField& operator|=(const FlagField& other);
  FlagField& operator&=(const FlagField& other);
  // Whether every flag of this field is one of the other.
  bool within(const FlagField& other) const;
  friend bool operator==(const FlagField&, const FlagField&) = default;

 private:
  std::size_t row_start(int y, int z) const {
    return row_words_ * (y + static_cast<std::size_t>(size_.y) * z);
  }
  IndexBox domain_;
  IntVec3 size_{};
  std::size_t row_words_ = 0;
  std::vector<std::uint64_t> words_;
};

// Position of the first bit at or after `from` that differs from those of `other` (all zero or all
// one), or `end` when there is none below it.
inline int next_other(const std::uint64_t* row, int from, int end, std::uint64_t other) {
  while (from < end) {
    const std::uint64_t rest = (row[from / 64] ^ other) >> (from % 64);
    if (rest != 0) return std::min(end, from + std::countr_zero(rest));
    from = (from / 64 + 1) * 64;
  }
  return end;
}
inline int next_flag(const std::uint64_t* row, int from, int end) {
  return next_other(row, from, end, 0);
}
inline int next_gap(const std::uint64_t* row, int from, int end) {
  return next_other(row, from, end, ~std::uint64_t{0});
}

}  // namespace sluice
