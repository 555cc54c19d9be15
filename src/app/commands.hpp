// The subcommands of `sluice`: each adds itself to the command line with what it does, and returns
// its exit status.
//
// An action may throw InputError, PhysicsError or SystemError; main prints the message and exits
// with the error's own status.
#pragma once

namespace sluice {

class CommandLine;

// For --help and `sluice help`.
inline constexpr const char* exit_statuses =
    "Exit status: 0 good; 1 the physics or a comparison failed; 2 bad input; 3 the system failed\n"
    "(disk, memory, MPI); 4 a run ended early, by a signal or its time limit, with a checkpoint";

void add_accuracy_command(CommandLine& line);
void add_run_command(CommandLine& line);
void add_check_command(CommandLine& line);
void add_compare_command(CommandLine& line);
void add_drive_command(CommandLine& line);
void add_export_command(CommandLine& line);
void add_extract_command(CommandLine& line);
void add_help_command(CommandLine& line);
void add_info_command(CommandLine& line);
void add_norms_command(CommandLine& line);
void add_plan_command(CommandLine& line);
void add_plot_command(CommandLine& line);
void add_regress_command(CommandLine& line);
void add_tune_command(CommandLine& line);

}  // namespace sluice
