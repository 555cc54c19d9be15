// The words of the library that parses, put in the form of our own.
#include "app/command/misuse.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <vector>

#include "framework/deck/nearest_name.hpp"

namespace sluice {
namespace {

// The command that the words name; the root where they name none.
const CLI::App& command_of(const CLI::App& root) {
  const auto chosen = root.get_subcommands();
  return chosen.empty() ? root : *chosen.front();
}

std::vector<std::string> options_of(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options())
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  return names;
}

std::string after(const std::string& text, const std::string& mark) {
  const auto at = text.find(mark);
  return at == std::string::npos ? "" : text.substr(at + mark.size());
}

std::string text_of_extra(const std::string& said, const CLI::App& command) {
  std::string word = after(said, "not expected: ");
  word = word.substr(0, word.find(' '));
  if (word.empty() || word[0] != '-') return fmt::format("'{}' was not expected", word);
  const std::string hint = suggest_name(word, options_of(command));
  return fmt::format("there is no option '{}'{}", word, hint.empty() ? "" : " (" + hint + ")");
}

std::string text_of_conversion(const std::string& said) {
  const std::string pair = after(said, "Could not convert: ");
  const auto equals = pair.find(" = ");
  if (equals == std::string::npos) return said;
  return fmt::format("{}: '{}' is not a number", pair.substr(0, equals), pair.substr(equals + 3));
}

}  // namespace

std::string text_of_misuse(const CLI::ParseError& problem, const CLI::App& root) {
  const CLI::App& command = command_of(root);
  const std::string name =
      &command == &root ? root.get_name() : root.get_name() + ' ' + command.get_name();
  std::string said = problem.what();
  if (dynamic_cast<const CLI::ExtrasError*>(&problem) != nullptr)
    said = text_of_extra(said, command);
  else if (dynamic_cast<const CLI::ConversionError*>(&problem) != nullptr)
    said = text_of_conversion(said);
  return fmt::format("{}: {}; see {} --help", name, said, name);
}

}  // namespace sluice
