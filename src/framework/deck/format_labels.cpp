// The table of the format's variables, parsed once.
#include "framework/deck/format_labels.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <sstream>

#include "framework/deck/value_text.hpp"

namespace sluice {
namespace {

constexpr const char* format_labels =
#include "framework/deck/format_labels.inc"
    ;

struct LabelTable {
  std::set<std::string, std::less<>> names;
  std::vector<std::string> beginnings, ends;
};

LabelTable parse_labels() {
  LabelTable table;
  std::istringstream words(format_labels);
  for (std::string word; words >> word;)
    if (word.front() == '*')
      table.ends.push_back(word.substr(1));
    else if (word.back() == '*')
      table.beginnings.push_back(word.substr(0, word.size() - 1));
    else
      table.names.insert(word);
  return table;
}

const LabelTable& label_table() {
  static const LabelTable parsed = parse_labels();
  return parsed;
}

const std::vector<ForeignLabel>& foreign_labels() {
  static const std::vector<ForeignLabel> list = [] {
    std::vector<ForeignLabel> rows = {
        {"temp_CC_Xchange", "heat exchange between materials is at the very end of a step",
         "save temp_CC, the temperature after it"},
        {"grad_dp_", "the pressure changes in one operation, without corrections",
         "save grad_P_XFC, grad_P_YFC or grad_P_ZFC"},
        {"eq_press_iters",
         "the common pressure is found by closed forms and bracketed searches, which are not "
         "counted",
         "remove the line"},
        {"maxMach_", "LODI faces use the Mach number of each cell, not the largest of the face",
         "save mach"}};
    for (const char* face : {"sp_volX_FC", "sp_volY_FC", "sp_volZ_FC"})
      rows.push_back({face, "the scheme uses no specific volume on faces",
                      "save sp_vol_CC of the cells on both sides"});
    return rows;
  }();
  return list;
}

}  // namespace

bool format_has_label(std::string_view label) {
  const auto begins = [&](const std::string& part) { return label.starts_with(part); };
  const auto ends = [&](const std::string& part) { return label.ends_with(part); };
  return label_table().names.contains(label) ||
         std::any_of(label_table().beginnings.begin(), label_table().beginnings.end(), begins) ||
         std::any_of(label_table().ends.begin(), label_table().ends.end(), ends);
}

const ForeignLabel* find_foreign_label(std::string_view label) {
  const auto fits = [&](const ForeignLabel& f) {
    const std::string_view name = f.name;
    return name.front() == '*' ? label.ends_with(name.substr(1)) : label.starts_with(name);
  };
  const auto& rows = foreign_labels();
  const auto found = std::find_if(rows.begin(), rows.end(), fits);
  return found == rows.end() ? nullptr : &*found;
}

std::string refusal_of(const ForeignLabel& foreign, std::string_view label) {
  return fmt::format("variable {} does not exist here: {}", in_quotes(std::string(label)),
                     foreign.reason);
}

}  // namespace sluice
