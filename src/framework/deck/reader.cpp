// A deck as written: XML read, includes resolved; nothing is checked yet.
#include <fmt/format.h>

#include "framework/deck/deck.hpp"
#include "framework/deck/faults.hpp"
#include "framework/deck/value_text.hpp"
#include "framework/deck/xml_reader.hpp"

namespace sluice {
namespace {

Deck deck_from(XmlTree tree, const std::string& file, ReadBudget& budget) {
  Deck deck;
  deck.file = file;
  deck.faults = std::move(tree.faults);
  deck.root = std::move(tree.root);
  if (deck.root == nullptr) return deck;
  if (deck.root->name != "Uintah_specification") {
    add_error(deck.faults, deck.root->where,
              fmt::format("the root element is <{}>, not <Uintah_specification>", deck.root->name),
              deck.root->name == "Uintah_Include" ? "this file is made to be included by a deck"
                                                  : "is this a .ups deck?");
    deck.root.reset();
    return deck;
  }
  resolve_includes(*deck.root, budget, deck.faults);
  return deck;
}

}  // namespace

Deck read_deck(const std::string& file) {
  ReadBudget budget;
  return deck_from(read_xml_file(file, file, budget), file, budget);
}

Deck read_deck_text(std::string_view xml, const std::string& shown_name) {
  ReadBudget budget;
  return deck_from(read_xml_text(xml, shown_name, budget), shown_name, budget);
}

}  // namespace sluice
