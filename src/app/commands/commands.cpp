// The table of subcommands.
#include "app/commands/commands.hpp"

namespace sluice {

void declare_accuracy_command(Command& command);
void declare_run_command(Command& command);
void declare_check_command(Command& command);
void declare_compare_command(Command& command);
void declare_drive_command(Command& command);
void declare_export_command(Command& command);
void declare_extract_command(Command& command);
void declare_help_command(Command& command);
void declare_info_command(Command& command);
void declare_norms_command(Command& command);
void declare_plan_command(Command& command);
void declare_plot_command(Command& command);
void declare_regress_command(Command& command);
void declare_tune_command(Command& command);

namespace {

constexpr CommandKind kinds[] = {
    {"accuracy", "What accuracy costs: error against time of a study", declare_accuracy_command},
    {"run", "Run a deck: from .ups to .uda archive", declare_run_command},
    {"check", "Find all faults of decks without running them", declare_check_command},
    {"compare", "Compare two archives value by value", declare_compare_command},
    {"drive",
     "One particle of a material along a path of deformation: stress, energy, temperature.\nThe "
     "deck holds <MaterialDriver>: a <material> as in <MaterialProperties>, <temperature>,\nand "
     "<piece>s that follow each other, each with <duration>, <steps> and a\n<velocity_gradient>, a "
     "<deformation> that F goes to, or a <rotation> by an <angle>.\ninputs/mpm/drive has examples.",
     declare_drive_command},
    {"export", "Write .pvd, .vti, .vtm and .vthb files for ParaView and VisIt",
     declare_export_command},
    {"extract", "Write values of a label as CSV", declare_extract_command},
    {"help", "Explain a tag of the deck", declare_help_command},
    {"info", "Say what an archive holds; exit 1 when damaged", declare_info_command},
    {"norms", "L1, L2 and Linf of the difference of archives", declare_norms_command},
    {"plan", "Show what a run will do and cost, without running", declare_plan_command},
    {"plot", "Draw an archive: profiles, slices, particles, histories", declare_plot_command},
    {"regress", "Compare short runs with golden results, restarts, splits and ranks",
     declare_regress_command},
    {"tune",
     "Find the fastest linear solver for a deck: runs its first steps, tries solvers on the "
     "systems that come up, prints a table and the tags to paste",
     declare_tune_command},
};

}  // namespace

std::span<const CommandKind> command_kinds() {
  return kinds;
}

}  // namespace sluice
