// The keys of a case: in a list of cases, or in the small file NAME.json beside a deck NAME.ups.
#pragma once
#include <string>
#include <vector>

#include "app/regress/regress_case.hpp"

namespace sluice {

class Json;

enum class KeyPlace { list = 1, beside_deck = 2 };

struct RegressKey {
  const char *name, *text;
  int places;  // KeyPlace, added up
};
const std::vector<RegressKey>& regress_keys();
// For `sluice regress --help`: a line a key.
std::string regress_keys_help();

// Everything but the deck itself. InputError names what is unknown, of another kind, out of range.
void read_regress_keys(const Json& json, KeyPlace place, RegressCase& c);

}  // namespace sluice
