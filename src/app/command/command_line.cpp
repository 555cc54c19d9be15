// The command line, parsed by CLI11.
#include "app/command/command_line.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <CLI/CLI.hpp>

#include "framework/base/error.hpp"
#include "framework/deck/nearest_name.hpp"

namespace sluice {

CommandOption& CommandOption::required() {
  option_->required();
  return *this;
}
CommandOption& CommandOption::at_least_zero() {
  option_->check(CLI::NonNegativeNumber);
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

// Help and version leave with 0, every misuse with the status of bad input.
int CommandLine::run(const std::vector<std::string>& words) {
  if (!words.empty() && words[0][0] != '-') refuse_unknown_command(words[0]);
  try {
    app_->parse(std::vector<std::string>(words.rbegin(), words.rend()));  // the last word first
    return exit_status_;
  } catch (const CLI::ParseError& problem) {
    return app_->exit(problem) == 0 ? 0 : static_cast<int>(ExitStatus::bad_input);
  }
}

}  // namespace sluice
