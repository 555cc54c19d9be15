// The subcommands of `sluice`: one table, from which main and with it `--help` read.
//
// A command is one file NAME_command.cpp, which declares its arguments and what it does, and one
// row of the table. Its action returns the exit status; it may throw InputError, PhysicsError or
// SystemError, whose message main prints before it ends with the error's own status.
#pragma once
#include <span>
#include <vector>

#include "app/command/command_text.hpp"

namespace sluice {

class Command;
class CommandLine;

struct CommandKind {
  const char* name;
  const char* summary;        // one line
  void (*declare)(Command&);  // arguments and action
};

std::span<const CommandKind> command_kinds();
void add_commands(CommandLine& line);
// All commands with their options in words.
std::vector<CommandText> command_texts();

}  // namespace sluice
