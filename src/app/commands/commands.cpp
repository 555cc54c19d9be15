// The table of subcommands.
#include "app/commands/commands.hpp"

#include "app/command/command_line.hpp"
#include "sluice_version.hpp"

namespace sluice {

void declare_accuracy_command(Command& command);
void declare_run_command(Command& command);
void declare_check_command(Command& command);
void declare_compare_command(Command& command);
void declare_convert_command(Command& command);
void declare_drive_command(Command& command);
void declare_export_command(Command& command);
void declare_extract_command(Command& command);
void declare_help_command(Command& command);
void declare_info_command(Command& command);
void declare_movie_command(Command& command);
void declare_new_command(Command& command);
void declare_norms_command(Command& command);
void declare_plan_command(Command& command);
void declare_plot_command(Command& command);
void declare_regress_command(Command& command);
void declare_report_command(Command& command);
void declare_stability_command(Command& command);
void declare_tune_command(Command& command);

namespace {

constexpr CommandKind kinds[] = {
    {"accuracy", "Measure error against time for a study", declare_accuracy_command},
    {"run", "Run a deck: from .ups to .uda archive", declare_run_command},
    {"check", "Find all faults of decks without running them", declare_check_command},
    {"compare", "Compare two archives value by value", declare_compare_command},
    {"convert", "Write the .ups deck that says the same as a deck of Peridigm (.yaml, .xml)",
     declare_convert_command},
    {"drive",
     "Take one particle of a material along a path of deformation: stress, energy, "
     "temperature.\nThe deck contains <MaterialDriver>: a <material> as in <MaterialProperties>, "
     "<temperature>,\nand consecutive <piece>s, each with <duration>, <steps> and "
     "a\n<velocity_gradient>, a final <deformation> F, or a <rotation> by an "
     "<angle>.\ninputs/mpm/drive has examples.",
     declare_drive_command},
    {"export", "Write .pvd, .vti, .vtm and .vtp files for ParaView and VisIt",
     declare_export_command},
    {"extract", "Write values of a label as CSV", declare_extract_command},
    {"help", "Explain a command, a tag, a law, a label or a message", declare_help_command},
    {"info", "Describe the content of an archive; exit 1 if it is damaged", declare_info_command},
    {"movie", "Draw an archive over time: .gif or .mp4", declare_movie_command},
    {"new", "Write a commented deck to begin with", declare_new_command},
    {"norms", "Print L1, L2 and Linf norms of the difference of archives", declare_norms_command},
    {"plan", "Show what a run will do and cost, without running", declare_plan_command},
    {"plot", "Draw archives: profiles, planes, particles, histories", declare_plot_command},
    {"regress", "Compare short cases with golden results, and with restarts, splits and ranks",
     declare_regress_command},
    {"report", "Write one HTML page of a run: deck, plan, costs, conservation, events, pictures",
     declare_report_command},
    {"stability",
     "Run hard cases over sweeps of step, resolution and stiffness, and draw where they hold;\nof "
     "a "
     "deck: say how far it is from failing",
     declare_stability_command},
    {"tune",
     "Find the fastest linear solver for a deck: run its first steps, try solvers on the systems "
     "that occur, print a table and the tags for the deck",
     declare_tune_command},
};

}  // namespace

std::span<const CommandKind> command_kinds() {
  return kinds;
}

void add_commands(CommandLine& line) {
  for (const CommandKind& kind : kinds) {
    Command command = line.add(kind.name, kind.summary);
    kind.declare(command);
  }
}

std::vector<CommandText> command_texts() {
  CommandLine line("sluice", version::kText);
  add_commands(line);
  return line.texts();
}

}  // namespace sluice
