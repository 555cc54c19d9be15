// For the tests of this room: a tree of deck nodes from a few lines of XML, and its faults.
#pragma once
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <string_view>
#include <vector>

#include "framework/deck/deck.hpp"

namespace sluice {

// The element inside a root tag of its own.
class DeckText {
 public:
  explicit DeckText(const std::string& xml)
      : deck_(read_deck_text("<Uintah_specification>\n" + xml + "</Uintah_specification>\n",
                             "deck.ups")) {
    for (const Fault& f : deck_.faults) ADD_FAILURE() << to_string(f);
  }
  const DeckNode& root() const { return *deck_.root; }
  const DeckNode& first() const { return *deck_.root->children.front(); }

 private:
  Deck deck_;
};

inline std::string all_faults(const std::vector<Fault>& faults) {
  std::string text;
  for (const Fault& f : faults) text += to_string(f) + '\n';
  return text;
}

}  // namespace sluice
