// The subcommands of `sluice`: one table, from which main and with it `--help` read.
//
// A command is one file NAME_command.cpp, which declares its arguments and what it does, and one
// row of the table. Its action returns the exit status; it may throw InputError, PhysicsError or
// SystemError, whose message main prints before it ends with the error's own status.
#pragma once
#include <span>

namespace sluice {

class Command;

struct CommandKind {
  const char* name;
  const char* summary;        // one line
  void (*declare)(Command&);  // arguments and action
};

std::span<const CommandKind> command_kinds();

}  // namespace sluice
