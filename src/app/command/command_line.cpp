// The command line, parsed by CLI11.
#include "app/command/command_line.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <CLI/CLI.hpp>
#include <sstream>

#include "app/command/misuse.hpp"
#include "framework/base/error.hpp"
#include "framework/deck/nearest_name.hpp"

namespace sluice {
namespace {

constexpr const char* optional_file = "[FILE.json]";

const CLI::App* find_command(const CLI::App& root, const std::string& name) {
  for (const CLI::App* command : root.get_subcommands({}))
    if (command->get_name() == name) return command;
  return nullptr;
}

OptionText text_of(const CLI::Option& option) {
  OptionText text;
  text.names = option.get_name(option.get_positional(), true);
  for (const std::string& name : option.get_snames()) text.flags.push_back('-' + name);
  for (const std::string& name : option.get_lnames()) text.flags.push_back("--" + name);
  text.takes_value = option.get_type_size() != 0;
  text.text = option.get_description();
  // "TEXT:{auto,plain,none}" where the value is one of a list.
  const std::string type = option.get_type_name();
  const auto open = type.find('{'), close = type.find('}');
  if (open == std::string::npos || close == std::string::npos) return text;
  std::istringstream words(type.substr(open + 1, close - open - 1));
  for (std::string word; std::getline(words, word, ',');) text.words.push_back(word);
  return text;
}

bool is_file_of_json(const std::string& word) {
  return word == "-" || word.ends_with(".json");
}

}  // namespace

CommandOption& CommandOption::required() {
  option_->required();
  return *this;
}
CommandOption& CommandOption::at_least_zero() {
  option_->check(CLI::Validator(
      [](const std::string& text) {
        double value = 0;
        const bool good = CLI::detail::lexical_cast(text, value) && value >= 0;
        return good ? std::string() : fmt::format("'{}' is not a number of at least 0", text);
      },
      "NUMBER>=0"));
  return *this;
}
CommandOption& CommandOption::between(int lowest, int highest) {
  option_->check(CLI::Range(lowest, highest));
  return *this;
}
CommandOption& CommandOption::one_of(const std::vector<std::string>& words) {
  option_->check(CLI::IsMember(words));
  return *this;
}
CommandOption& CommandOption::once() {
  option_->expected(1);
  return *this;
}
// Else CLI11 takes all words that follow for more values.
CommandOption& CommandOption::repeatable() {
  option_->take_all()->allow_extra_args(false);
  return *this;
}
CommandOption& CommandOption::quietly_repeatable() {
  option_->expected(1)->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  return *this;
}
void CommandOption::together_with(CommandOption& other) {
  option_->needs(other.option_);
  other.option_->needs(option_);
}

template <class T>
CommandOption Command::add(const char* names, T& value, const char* text) {
  return CommandOption(app_->add_option(names, value, text));
}
CommandOption Command::option(const char* names, std::string& value, const char* text) {
  return add(names, value, text);
}
CommandOption Command::option(const char* names, std::vector<std::string>& value,
                              const char* text) {
  return add(names, value, text);
}
CommandOption Command::option(const char* names, int& value, const char* text) {
  return add(names, value, text);
}
CommandOption Command::option(const char* names, double& value, const char* text) {
  return add(names, value, text);
}
CommandOption Command::option(const char* names, std::optional<int>& value, const char* text) {
  return add(names, value, text);
}
CommandOption Command::option(const char* names, std::optional<double>& value, const char* text) {
  return add(names, value, text);
}
// A callback that is triggered while words are read keeps their order among several options.
CommandOption Command::each(const char* names, std::function<void(const std::string&)> take,
                            const char* text) {
  return CommandOption(app_->add_option_function<std::string>(names, std::move(take), text)
                           ->trigger_on_parse()
                           ->take_all()
                           ->allow_extra_args(false));
}
void Command::json(std::string& target, const char* text) {
  app_->add_option("--json", target, text)->type_name(optional_file);
}
void Command::flag(const char* names, bool& value, const char* text) {
  app_->add_flag(names, value, text);
}
void Command::closing_text(const std::string& text) {
  app_->footer(text + "\n" + exit_statuses);
}
void Command::action(std::function<int()> run) {
  app_->callback([run = std::move(run), &status = exit_status_] { status = run(); });
}

CommandLine::CommandLine(const char* text, const std::string& version)
    : app_(std::make_unique<CLI::App>(text, "sluice")) {
  app_->set_version_flag("--version", version);
  app_->require_subcommand(1);
  app_->footer(exit_statuses);
}
CommandLine::~CommandLine() = default;

Command CommandLine::add(const char* name, const char* text) {
  return Command(app_->add_subcommand(name, text), exit_status_);
}

// A first word that is no command gets the nearest one as an answer.
void CommandLine::refuse_unknown_command(const std::string& word) const {
  std::vector<std::string> names;
  for (const CLI::App* command : app_->get_subcommands({})) names.push_back(command->get_name());
  if (std::find(names.begin(), names.end(), word) != names.end()) return;
  throw InputError(fmt::format("there is no subcommand '{}' ({}; see sluice --help)", word,
                               suggest_name(word, names)));
}

std::vector<CommandText> CommandLine::texts() const {
  std::vector<CommandText> all;
  for (const CLI::App* command : app_->get_subcommands({})) {
    std::string closing = command->get_footer();
    if (const auto at = closing.rfind(std::string("\n") + exit_statuses); at != std::string::npos)
      closing.resize(at);
    all.push_back({command->get_name(), command->get_description(), closing, {}});
    for (const CLI::Option* option : command->get_options()) {
      if (option->get_lnames() == std::vector<std::string>{"help"}) continue;
      all.back().options.push_back(text_of(*option));
    }
  }
  return all;
}

// An option with an optional file gets standard output where no file follows it.
std::vector<std::string> CommandLine::with_targets(const std::vector<std::string>& words) const {
  if (words.empty()) return words;
  const CLI::App* command = find_command(*app_, words[0]);
  const CLI::Option* json = command == nullptr ? nullptr : command->get_option_no_throw("--json");
  if (json == nullptr || json->get_type_name() != optional_file) return words;
  std::vector<std::string> full;
  for (std::size_t w = 0; w < words.size(); ++w) {
    full.push_back(words[w]);
    const bool followed = w + 1 < words.size() && is_file_of_json(words[w + 1]);
    if (words[w] == "--json" && !followed) full.emplace_back("-");
  }
  return full;
}

// Help and version leave with 0, every misuse with the status of bad input.
int CommandLine::run(const std::vector<std::string>& words) {
  if (!words.empty() && words[0][0] != '-') refuse_unknown_command(words[0]);
  if (words.size() == 2 && words[0] == "help" && find_command(*app_, words[1]) != nullptr)
    return run({words[1], "--help"});
  try {
    const std::vector<std::string> full = with_targets(words);
    app_->parse(std::vector<std::string>(full.rbegin(), full.rend()));  // the last word first
    return exit_status_;
  } catch (const CLI::ParseError& problem) {
    if (problem.get_exit_code() == 0) return app_->exit(problem);  // prints the help
    throw InputError(text_of_misuse(problem, *app_));
  }
}

}  // namespace sluice
