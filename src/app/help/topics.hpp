// What `sluice help NAME` tells: tags, laws, labels and messages of one name.
#pragma once
#include <string>
#include <vector>

namespace sluice {

// Everything that has the name. InputError with the nearest name where nothing has; `commands` are
// names that may be meant too.
std::string help_on(const std::string& name, const std::vector<std::string>& commands);

}  // namespace sluice
