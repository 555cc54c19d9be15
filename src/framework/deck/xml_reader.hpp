// One XML file as a tree of DeckNodes, with the line and column of every element.
//
// Nothing outside the file is ever read: no network, no external entity, no DTD. Entity
// declarations are refused, so nothing can be expanded. Size, depth and the number of elements
// are bounded.
#pragma once
#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "framework/deck/deck.hpp"

namespace sluice {

// What a deck with all its includes may cost; the largest known deck has 0.8 MB and 20,000
// elements.
struct ReadBudget {
  std::size_t bytes = 64u << 20;
  std::size_t elements = 200'000;
  std::size_t includes = 1000;
  std::size_t include_depth = 32;
};
constexpr std::size_t largest_deck_file = 16u << 20;
constexpr int deepest_element = 100;

struct XmlTree {
  std::unique_ptr<DeckNode> root;  // nullptr when the XML cannot be read
  std::vector<Fault> faults;
};

// `shown_name` is the file's name in messages.
XmlTree read_xml_file(const std::string& path, const std::string& shown_name, ReadBudget& budget);
XmlTree read_xml_text(std::string_view xml, const std::string& shown_name, ReadBudget& budget);

// Includes replaced by what they name; see include.cpp.
void resolve_includes(DeckNode& root, ReadBudget& budget, std::vector<Fault>& faults);

}  // namespace sluice
