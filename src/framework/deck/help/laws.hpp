// Laws of the format: the words of an attribute that chooses among several, and what each reads.
#pragma once
#include <string>
#include <vector>

#include "framework/deck/schema.hpp"

namespace sluice {

struct Law {
  std::string attribute, word;       // <EOS type="TST">: type, TST
  std::vector<const TagSpec*> tags;  // that this law reads and not all others; they live as long
                                     // as the schema
};

// Those among which an attribute of the tag chooses; none where no tag belongs to one of its words.
std::vector<Law> laws_of(const Schema& schema, const TagSpec& spec);

// Whether all laws of the parent read the child.
bool read_by_all(const TagSpec& parent, const TagSpec& child);

// A tag with its path, "CFD/ICE/advection".
struct TagPlace {
  std::string path;
  const TagSpec* spec;
};

// All tags in order, a group's members once, below the first tag that has the group.
std::vector<TagPlace> all_places(const Schema& schema);

}  // namespace sluice
