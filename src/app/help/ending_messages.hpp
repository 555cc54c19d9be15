// Messages that end a run: what each means, and what to change.
#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace sluice {

struct EndingMessage {
  std::string_view phrase;  // words of the message that never vary
  int status;               // of the run
  std::string_view meaning;
  std::string_view change;  // what to do
};

std::span<const EndingMessage> ending_messages();

// Those of which the text contains the phrase, or whose phrase contains the text; empty: none.
std::string help_on_message(std::string_view text);

// The page "When it stops" of the documentation.
std::string page_of_messages();

}  // namespace sluice
