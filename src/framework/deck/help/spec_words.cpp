#include "framework/deck/help/spec_words.hpp"

#include <fmt/format.h>

namespace sluice {

std::string need_text(Need need) {
  switch (need) {
    case Need::once:
      return "required";
    case Need::optional:
      return "optional";
    case Need::multiple:
      return "any number";
    case Need::at_least_once:
      return "at least one";
  }
  return "";
}

std::string value_text(const ValueSpec& value) {
  if (value.type == TagType::none) return "";
  if (value.type == TagType::word) {
    std::vector<std::string> words = value.words;
    for (std::string& word : words) {
      if (word.empty()) word = "nothing";
    }
    return fmt::format("one of {}", fmt::join(words, ", "));
  }
  std::string text = to_string(value.type);
  if (value.range.limited()) text += ", " + value.range.text();
  return text;
}

}  // namespace sluice
