// Index sets of decks: "0, 2-4, -1"; empty means everything.
#pragma once
#include <string_view>
#include <vector>

#include "framework/deck/deck.hpp"

namespace sluice {

class IndexSet {
 public:
  IndexSet() = default;  // everything
  explicit IndexSet(std::vector<int> members) : all_(false), members_(std::move(members)) {}

  bool all() const { return all_; }
  // Negative members count from the end: -1 is the last of `count`.
  bool contains(int index, int count) const;
  const std::vector<int>& members() const { return members_; }

 private:
  bool all_ = true;
  std::vector<int> members_;
};

// InputError that shows the text and the place of the fault.
IndexSet parse_index_set(std::string_view text);

}  // namespace sluice
