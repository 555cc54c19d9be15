// The subcommands of `sluice`: each adds itself to the command line with what it does, and returns
// its exit status (0 good, 1 failed, 2 bad input, 3 system).
//
// An action may throw InputError, PhysicsError or SystemError; main prints the message and exits
// with the error's own status.
#pragma once

namespace sluice {

class CommandLine;

void add_accuracy_command(CommandLine& line);
void add_run_command(CommandLine& line);
void add_check_command(CommandLine& line);
void add_compare_command(CommandLine& line);
void add_export_command(CommandLine& line);
void add_extract_command(CommandLine& line);
void add_help_command(CommandLine& line);
void add_info_command(CommandLine& line);
void add_norms_command(CommandLine& line);
void add_plan_command(CommandLine& line);
void add_plot_command(CommandLine& line);
void add_regress_command(CommandLine& line);

}  // namespace sluice
