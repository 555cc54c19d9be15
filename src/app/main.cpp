// The sluice command: gathers the subcommands, maps errors to statuses. Under the name of a tool of
// the public suite it is that tool.
#include <fmt/format.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <exception>
#include <new>
#include <string>
#include <vector>

#include "app/classic/classic_tools.hpp"
#include "app/command/command_line.hpp"
#include "app/commands/commands.hpp"
#include "framework/base/error.hpp"
#include "sluice_version.hpp"

namespace {

int report(int status, const char* message) {
  fmt::print(stderr, "sluice: error: {}\n", message);
  return status;
}

int run_sluice(const std::vector<std::string>& words) {
  sluice::CommandLine line("Sluice: coupled fluid-structure simulation with ICE, MPM and MPMICE",
                           std::string("sluice ") + sluice::version::kText);
  sluice::add_commands(line);
  return line.run(words);
}

}  // namespace

int main(int argument_count, char** arguments) {
  std::signal(SIGXFSZ, SIG_IGN);  // a limit of file sizes is told as a full disk is
  const std::vector<std::string> words(arguments + std::min(argument_count, 1),
                                       arguments + argument_count);
  try {
    const sluice::ClassicTool* tool =
        sluice::find_classic_tool(argument_count > 0 ? arguments[0] : "");
    if (tool != nullptr) return run_classic_tool(*tool, {tool->name, words, run_sluice});
    return run_sluice(words);
  } catch (const sluice::Error& problem) {
    return report(static_cast<int>(problem.status()), problem.what());
  } catch (const std::bad_alloc&) {
    return report(static_cast<int>(sluice::ExitStatus::system), "out of memory");
  } catch (const std::exception& problem) {
    return report(static_cast<int>(sluice::ExitStatus::system), problem.what());
  }
}
