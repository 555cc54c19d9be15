// The passes that make a checked deck out of a file.
#include "framework/deck/load_deck.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <tuple>

#include "framework/base/error.hpp"
#include "framework/deck/data_file.hpp"
#include "framework/deck/faults.hpp"
#include "framework/deck/schema_check.hpp"
#include "framework/deck/spelling.hpp"

namespace sluice {
namespace {

// Document order, file by file, so that the first fault shown is the first in the deck.
void sort_by_place(std::vector<Fault>& faults) {
  std::map<std::string, std::size_t> file_order;
  for (const Fault& fault : faults) file_order.try_emplace(fault.where.file, file_order.size());
  const auto place = [&](const Fault& fault) {
    return std::tuple(file_order.at(fault.where.file), fault.where.line, fault.where.column);
  };
  std::stable_sort(faults.begin(), faults.end(),
                   [&](const Fault& a, const Fault& b) { return place(a) < place(b); });
}

// One warning a kind: a deck of fifty objects says an old word fifty times.
void tell_once(std::vector<Fault>& faults) {
  std::map<std::pair<std::string, std::string>, std::pair<std::size_t, int>> kinds;
  std::vector<Fault> told;
  for (Fault& fault : faults) {
    if (fault.severity != Severity::error) {
      const auto [first, fresh] =
          kinds.try_emplace({fault.message, fault.suggestion}, told.size(), 0);
      ++first->second.second;
      if (!fresh) continue;
    }
    told.push_back(std::move(fault));
  }
  for (const auto& [kind, place] : kinds)
    if (const auto [at, count] = place; count > 1)
      told[at].message +=
          fmt::format(", here and at {} other place{}", count - 1, count > 2 ? "s" : "");
  faults = std::move(told);
}

// A value that a rule cannot read has been told where values are checked; the other faults of the
// deck must not be lost with it.
void apply(const DeckRule& rule, Deck& deck) {
  try {
    rule(*deck.root, deck.faults);
  } catch (const InputError& e) {
    if (deck.good()) add_error(deck.faults, deck.root->where, e.what());
  }
}

// Tags of other spellings and of earlier formats get the names of the schema.
void bring_up_to_date(Deck& deck, const Schema& schema) {
  settle_spelling(*deck.root, schema, deck.faults);
  drop_obsolete(*deck.root, deck.faults);
  for (const DeckRewrite& rewrite : schema.rewrites) rewrite(*deck.root, deck.faults);
  drop_obsolete(*deck.root, deck.faults);  // in what has been moved
  settle_spelling(*deck.root, schema, deck.faults);
  normalise_names(*deck.root, schema);
}

}  // namespace

std::unique_ptr<DeckNode> copy_of(const DeckNode& node) {
  auto copy = std::make_unique<DeckNode>();
  copy->name = node.name;
  copy->text = node.text;
  copy->where = node.where;
  copy->defaulted = node.defaulted;
  copy->attributes = node.attributes;
  for (const auto& child : node.children) copy->children.push_back(copy_of(*child));
  return copy;
}

Deck check_deck(Deck deck, const std::vector<std::string>& overrides, const Schema& schema) {
  if (deck.root == nullptr) return deck;
  const bool whole = deck.good();
  bring_up_to_date(deck, schema);
  for (const std::string& text : overrides) {
    apply_override(*deck.root, text, schema, deck.faults);
  }
  if (std::any_of(overrides.begin(), overrides.end(), is_addition)) bring_up_to_date(deck, schema);
  for (const DeckRewrite& complete : schema.completions) complete(*deck.root, deck.faults);
  check_structure(*deck.root, schema, deck.faults);
  // What is missing may stand where the reading failed, behind an include that leads nowhere.
  if (!whole) std::erase_if(deck.faults, [](const Fault& fault) { return fault.absent; });
  locate_files(*deck.root, schema, deck.faults);
  for (const DeckRule& rule : schema.rules) apply(rule, deck);
  sort_by_place(deck.faults);
  tell_once(deck.faults);
  return deck;
}

Deck load_deck(const std::string& file, const std::vector<std::string>& overrides,
               const Schema& schema) {
  return check_deck(read_deck(file), overrides, schema);
}

Deck load_deck_text(std::string_view xml, const std::string& shown_name,
                    const std::vector<std::string>& overrides, const Schema& schema) {
  return check_deck(read_deck_text(xml, shown_name), overrides, schema);
}

}  // namespace sluice
