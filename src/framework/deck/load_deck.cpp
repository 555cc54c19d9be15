// The passes that make a checked deck out of a file.
#include "framework/deck/load_deck.hpp"

#include "framework/deck/schema_check.hpp"

namespace sluice {
namespace {

Deck finish(Deck deck, const std::vector<std::string>& overrides, const Schema& schema) {
  if (deck.root == nullptr) return deck;
  drop_obsolete(*deck.root, deck.faults);
  for (const DeckRewrite& rewrite : schema.rewrites) rewrite(*deck.root, deck.faults);
  normalise_names(*deck.root, schema);
  for (const std::string& text : overrides) {
    apply_override(*deck.root, text, schema, deck.faults);
  }
  resolve_piece_labels(*deck.root, deck.faults);
  check_structure(*deck.root, schema, deck.faults);
  for (const DeckRule& rule : schema.rules) rule(*deck.root, deck.faults);
  return deck;
}

}  // namespace

Deck load_deck(const std::string& file, const std::vector<std::string>& overrides,
               const Schema& schema) {
  return finish(read_deck(file), overrides, schema);
}

Deck load_deck_text(std::string_view xml, const std::string& shown_name,
                    const std::vector<std::string>& overrides, const Schema& schema) {
  return finish(read_deck_text(xml, shown_name), overrides, schema);
}

}  // namespace sluice
