// Labels that raw archives hold under another name than those of Sluice, for comparisons.
#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace sluice {

struct LabelName {
  std::string raw;  // in a raw archive, of Uintah or of Vaango
  std::string own;  // of Sluice, of the same quantity
};

// The table that `sluice compare --help` prints. A label with a + behind its name (as before
// particles moved to other patches) is that without.
std::span<const LabelName> label_names();

// All names that a label may have in an archive of the other format, the most likely first: its
// own, that of `more` (a user's), that of the table.
std::vector<std::string> names_elsewhere(const std::string& label,
                                         const std::vector<LabelName>& more);

// What the option --same of the commands that compare says of itself, with the table.
std::string label_names_help();
// "a=b". InputError for other text.
LabelName parse_label_name(const std::string& text);

}  // namespace sluice
