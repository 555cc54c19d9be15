// Commands and their options in words: what completion of shells and man pages are written from.
#pragma once
#include <string>
#include <vector>

namespace sluice {

struct OptionText {
  std::string names;               // "-o,--output", or DECK of a positional argument
  std::vector<std::string> flags;  // "-o", "--output"; empty for a positional argument
  bool takes_value = false;
  std::vector<std::string> words;  // the values that it may have; empty: any
  std::string text;
};

struct CommandText {
  std::string name, summary, closing;
  std::vector<OptionText> options;
};

// For bash: commands, options, their words, and files.
std::string bash_completion(const std::vector<CommandText>& commands);
// For zsh: that of bash, through its bashcompinit.
std::string zsh_completion(const std::vector<CommandText>& commands);
// Lines of fish, one for each command and option.
std::string fish_completion(const std::vector<CommandText>& commands);
// troff of sluice(1), with all commands; `version` stands at its foot.
std::string man_page(const std::vector<CommandText>& commands, const std::string& version);

}  // namespace sluice
