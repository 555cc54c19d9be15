// The subcommands of `sluice`: each adds itself to the parser and, when it is the one called,
// runs in its callback and sets the exit status.
//
// A callback may throw InputError, PhysicsError or SystemError; main prints the message and exits
// with the error's own status.
#pragma once

namespace CLI {
class App;
}

namespace sluice {

// For --help and `sluice help`.
inline constexpr const char* exit_statuses =
    "Exit status: 0 good; 1 the physics or a comparison failed; 2 bad input; 3 the system failed\n"
    "(disk, memory, MPI); 4 a run ended early, by a signal or its time limit, with a checkpoint";

void add_accuracy_command(CLI::App& app, int& exit_status);
void add_run_command(CLI::App& app, int& exit_status);
void add_check_command(CLI::App& app, int& exit_status);
void add_compare_command(CLI::App& app, int& exit_status);
void add_export_command(CLI::App& app, int& exit_status);
void add_extract_command(CLI::App& app, int& exit_status);
void add_help_command(CLI::App& app, int& exit_status);
void add_info_command(CLI::App& app, int& exit_status);
void add_norms_command(CLI::App& app, int& exit_status);
void add_plan_command(CLI::App& app, int& exit_status);
void add_plot_command(CLI::App& app, int& exit_status);
void add_regress_command(CLI::App& app, int& exit_status);

}  // namespace sluice
