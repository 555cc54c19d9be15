// Decks of one solid with flags of <MPM>, or of two with a contact, and what reading them says.
#pragma once
#include <string>

#include "mpm/test_support/solid_deck.hpp"

namespace sluice::mpm {

inline SolidDeck with_flags(const std::string& flags) {
  SolidDeck deck;
  deck.flags = flags;
  return deck;
}

inline std::string flag_faults(const std::string& flags) {
  return read_solids(with_flags(flags)).text;
}

inline SolidDeck with_contact(const std::string& contact) {
  SolidDeck deck;
  deck.further = solid_material("other", deck.objects);
  deck.contacts = "<contact>" + contact + "</contact>\n";
  return deck;
}

}  // namespace sluice::mpm
