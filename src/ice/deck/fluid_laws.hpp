// The equations of state that decks name, each with its tags: one table for description, checks
// and reading.
#pragma once
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "eos/eos.hpp"
#include "framework/deck/schema.hpp"

namespace sluice::ice {

// One number of a law.
struct LawTag {
  std::string name;
  std::string meaning;  // with its unit
  Range range;
  bool optional = false;  // absent: the value of LawEntry::start
  std::function<void(eos::EquationOfState&, double)> set;
};

struct LawEntry {
  std::string type;            // attribute of <EOS>
  eos::EquationOfState start;  // values of what may be left out
  std::vector<LawTag> tags;
  std::vector<TagSpec> reads;    // the same for help and reference
  bool gamma_above_one = false;  // <gamma> of the material is part of the law
};

const std::vector<LawEntry>& law_table();
// nullptr for a name that is not in the table.
const LawEntry* find_law(std::string_view type);

bool has_tag(const LawEntry& law, std::string_view name);
bool tag_of_any_law(std::string_view name);

// "ideal_gas, StiffenedGas and ...": those of which <gamma> of the material is a number.
std::string laws_with_gamma();

// <EOS> with the tags of all laws; which of them belong together is for read_fluid().
TagSpec equation_of_state_tag();

}  // namespace sluice::ice
