// The command line: commands with their positional arguments, options and flags.
//
// A thin face of the library that parses, which only command_line.cpp sees: it is long to compile.
#pragma once
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/command/command_text.hpp"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace sluice {

// For --help and `sluice help`.
inline constexpr const char* exit_statuses =
    "Exit status: 0 success; 1 a physical failure, or a comparison that found a difference; 2 "
    "invalid\ninput; 3 a failure of the system (disk, memory, MPI); 4 the run ended early, by a "
    "signal or its\ntime limit, with a checkpoint";

// An argument of a command and what is asked of its value.
class CommandOption {
 public:
  explicit CommandOption(CLI::Option* option) : option_(option) {}
  CommandOption& required();
  CommandOption& at_least_zero();
  CommandOption& between(int lowest, int highest);
  CommandOption& one_of(const std::vector<std::string>& words);
  CommandOption& once();                // of a list: at most one value
  CommandOption& repeatable();          // of a list: each mention adds one value
  CommandOption& quietly_repeatable();  // likewise; the help does not show it
  void together_with(CommandOption& other);

 private:
  CLI::Option* option_;
};

// A name without dashes is a positional argument. The values must live until the command runs; the
// text of an option says their units.
class Command {
 public:
  explicit Command(CLI::App* app, int& exit_status) : app_(app), exit_status_(exit_status) {}
  CommandOption option(const char* names, std::string& value, const char* text);
  CommandOption option(const char* names, std::vector<std::string>& value, const char* text);
  CommandOption option(const char* names, int& value, const char* text);
  CommandOption option(const char* names, double& value, const char* text);
  CommandOption option(const char* names, std::optional<int>& value, const char* text);
  CommandOption option(const char* names, std::optional<double>& value, const char* text);
  // `take` gets the value of each mention, in the order of the command line among all such options.
  CommandOption each(const char* names, std::function<void(const std::string&)> take,
                     const char* text);
  // --json [FILE.json]: the target gets the file, or - for standard output.
  void json(std::string& target, const char* text);
  void flag(const char* names, bool& value, const char* text);
  // What --help ends with, before the exit statuses.
  void closing_text(const std::string& text);
  // What the command does; it returns the exit status. Errors that it throws pass through.
  void action(std::function<int()> run);

 private:
  template <class T>
  CommandOption add(const char* names, T& value, const char* text);

  CLI::App* app_;
  int& exit_status_;
};

class CommandLine {
 public:
  CommandLine(const char* text, const std::string& version);
  ~CommandLine();
  Command add(const char* name, const char* text);
  // The exit status of the command that the words name; 0 for help. InputError when they misuse it.
  int run(const std::vector<std::string>& words);
  // All commands with their options.
  std::vector<CommandText> texts() const;

 private:
  void refuse_unknown_command(const std::string& word) const;
  std::vector<std::string> with_targets(const std::vector<std::string>& words) const;

  std::unique_ptr<CLI::App> app_;
  int exit_status_ = 0;
};

}  // namespace sluice
