// What the deck format as a whole knows, built here or not: names of tags by parent.
#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace sluice {

// Whether the format has this child below the parent, a slash-separated path below the root
// ("CFD/ICE"; "" is the root itself).
bool known_to_format(std::string_view parent_path, std::string_view child);

// The parents below which the format has a tag of this name.
std::vector<std::string> parents_in_format(std::string_view name);

}  // namespace sluice
