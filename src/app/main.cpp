// The sluice command: gathers the subcommands, parses the command line, maps errors to statuses.
#include <fmt/format.h>

#include <algorithm>
#include <CLI/CLI.hpp>
#include <csignal>
#include <cstdio>
#include <exception>
#include <new>

#include "app/commands.hpp"
#include "framework/base/error.hpp"
#include "framework/deck/nearest_name.hpp"
#include "sluice_version.hpp"

namespace {

int report(int status, const char* message) {
  fmt::print(stderr, "sluice: error: {}\n", message);
  return status;
}

// Help and version leave with 0, every misuse of the command line with 2.
int report(const CLI::App& app, const CLI::ParseError& problem) {
  const int status = app.exit(problem);
  return status == 0 ? 0 : static_cast<int>(sluice::ExitStatus::bad_input);
}

// A first word that is no subcommand gets the nearest one as an answer.
void refuse_unknown_subcommand(const CLI::App& app, const std::string& word) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands({})) names.push_back(command->get_name());
  if (std::find(names.begin(), names.end(), word) != names.end()) return;
  throw sluice::InputError(fmt::format("there is no subcommand '{}' ({}; see sluice --help)", word,
                                       sluice::suggest_name(word, names)));
}

}  // namespace

int main(int argument_count, char** arguments) {
  std::signal(SIGXFSZ, SIG_IGN);  // a limit of file sizes is told as a full disk is
  CLI::App app("Sluice: coupled fluid-structure simulation with ICE, MPM and MPMICE", "sluice");
  app.set_version_flag("--version", std::string("sluice ") + sluice::version::kText);
  app.require_subcommand(1);
  app.footer(sluice::exit_statuses);

  int exit_status = 0;
  sluice::add_accuracy_command(app, exit_status);
  sluice::add_run_command(app, exit_status);
  sluice::add_check_command(app, exit_status);
  sluice::add_compare_command(app, exit_status);
  sluice::add_export_command(app, exit_status);
  sluice::add_extract_command(app, exit_status);
  sluice::add_help_command(app, exit_status);
  sluice::add_info_command(app, exit_status);
  sluice::add_norms_command(app, exit_status);
  sluice::add_plan_command(app, exit_status);
  sluice::add_plot_command(app, exit_status);
  sluice::add_regress_command(app, exit_status);

  try {
    const bool has_word = argument_count > 1 && arguments[1][0] != '-';
    if (has_word) refuse_unknown_subcommand(app, arguments[1]);
    app.parse(argument_count, arguments);
    return exit_status;
  } catch (const CLI::ParseError& problem) {
    return report(app, problem);
  } catch (const sluice::Error& problem) {
    return report(static_cast<int>(problem.status()), problem.what());
  } catch (const std::bad_alloc&) {
    return report(static_cast<int>(sluice::ExitStatus::system), "out of memory");
  } catch (const std::exception& problem) {
    return report(static_cast<int>(sluice::ExitStatus::system), problem.what());
  }
}
