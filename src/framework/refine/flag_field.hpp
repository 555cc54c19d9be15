// Flags of the cells of one level, a bit each: which of them ask for a finer level.
//
// Rows along x are padded to whole words, so that widening and searching work on 64 cells at a
// time. Two fields of the same domain are joined by the bitwise or of their words.
#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "framework/grid/index_box.hpp"

namespace sluice {

class FlagField {
 public:
  explicit FlagField(const IndexBox& domain = {});
  const IndexBox& domain() const { return domain_; }

  void set(IntVec3 cell);
  void fill(const IndexBox& cells);  // its part inside the domain
  bool get(IntVec3 cell) const;
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
    return row_words_ * (static_cast<std::size_t>(y) +
                         static_cast<std::size_t>(size_.y) * static_cast<std::size_t>(z));
  }
  IndexBox domain_;
  IntVec3 size_{};
  std::size_t row_words_ = 0;
  std::vector<std::uint64_t> words_;
};

// Position of the first set bit at or after `from`, or `end` when there is none below it.
int next_flag(const std::uint64_t* row, int from, int end);
// The same for the first bit that is not set.
int next_gap(const std::uint64_t* row, int from, int end);

}  // namespace sluice
