// Index sets of decks: "0, 2-4, -1"; empty means everything.
#pragma once
#include <string_view>
#include <utility>
#include <vector>

#include "framework/deck/deck.hpp"
#include "framework/deck/value_text.hpp"

namespace sluice {

class IndexSet {
 public:
  IndexSet() = default;  // everything
  explicit IndexSet(std::vector<IndexInterval> intervals) : intervals_(std::move(intervals)) {}

  bool all() const { return intervals_.empty(); }
  // Negative members count from the end: -1 is the last of `count`.
  bool contains(int index, int count) const;

 private:
  std::vector<IndexInterval> intervals_;
};

// InputError that shows the text and what is wrong with it.
IndexSet read_index_set(std::string_view text);

}  // namespace sluice
