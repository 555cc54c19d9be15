// The sluice command: gathers the subcommands, maps errors to statuses.
#include <fmt/format.h>

#include <csignal>
#include <cstdio>
#include <exception>
#include <new>

#include "app/command/command_line.hpp"
#include "app/commands/commands.hpp"
#include "framework/base/error.hpp"
#include "sluice_version.hpp"

namespace {

int report(int status, const char* message) {
  fmt::print(stderr, "sluice: error: {}\n", message);
  return status;
}

}  // namespace

int main(int argument_count, char** arguments) {
  std::signal(SIGXFSZ, SIG_IGN);  // a limit of file sizes is told as a full disk is
  sluice::CommandLine line("Sluice: coupled fluid-structure simulation with ICE, MPM and MPMICE",
                           std::string("sluice ") + sluice::version::kText);
  for (const sluice::CommandKind& kind : sluice::command_kinds()) {
    sluice::Command command = line.add(kind.name, kind.summary);
    kind.declare(command);
  }
  try {
    return line.run({arguments + 1, arguments + argument_count});
  } catch (const sluice::Error& problem) {
    return report(static_cast<int>(problem.status()), problem.what());
  } catch (const std::bad_alloc&) {
    return report(static_cast<int>(sluice::ExitStatus::system), "out of memory");
  } catch (const std::exception& problem) {
    return report(static_cast<int>(sluice::ExitStatus::system), problem.what());
  }
}
