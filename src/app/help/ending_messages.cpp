// The table of messages that end a run; a test finds each phrase in the sources.
#include "app/help/ending_messages.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

namespace sluice {
namespace {

constexpr EndingMessage table[] = {
    // The state
    {"inadmissible even with dt", 1,
     "A cell of the fluid would get a negative density, a negative internal energy, or a volume "
     "fraction outside of 0 to 1. The step was repeated with half its length up to 20 times, and "
     "the smallest did not help. The message names the first cell, its level, the material and "
     "the value.",
     "Look at the state before the step (`sluice plot UDA --checkpoint`). If the cell lies at an "
     "inflow or at the edge of an initial region, its density, temperature and pressure may "
     "contradict each other. Otherwise take a smaller `<cfl>`, `<advection type=\"FirstOrder\">`, "
     "or a finer grid at this place."},
    {"is admissible on both levels even with dt", 1,
     "At the edge of a finer level the corrected fluxes leave a cell in an inadmissible state on "
     "one of the two levels.",
     "Widen the refined region with `<cell_stability_dilation>`, so that the strong gradient does "
     "not meet its edge, or take a smaller `<cfl>`."},
    {"The state is damaged", 1,
     "A value that was good at the end of the step before is not a number at the start of this "
     "one: "
     "memory was changed from outside, or the program has a fault.",
     "Continue from the last checkpoint with `sluice run --restart UDA`. If it happens again at "
     "the same step, please report it with the deck."},
    {"so that the time cannot advance", 1,
     "The stable time step has become zero or is not a number: somewhere the speed of the flow or "
     "of "
     "sound is infinite, or a density has nearly vanished.",
     "Find the place with `sluice info UDA --extremes --checkpoint`. Initial states with a "
     "pressure that does not follow from density and temperature are a common cause, as are units "
     "that are mixed."},
    {"would be below delt_min", 1,
     "A step was rejected, and half of it would be smaller than `<delt_min>` of the deck.",
     "Lower `<delt_min>` (0 means no lower bound), then look in the events of `run.json` for the "
     "reason of the rejection."},
    {"by numerical error of transfer and integration", 1,
     "A solid gained more energy in one step than its loads and its contacts gave it. Such a "
     "gain grows until the body explodes, so the run ends before it is written as a result.",
     "Take a smaller `<timestep_multiplier>`, another `<interpolator>` (`cpdi` or `gimp` rather "
     "than `linear`), or more particles in a cell. `sluice plan` names the settings that the "
     "studies prove."},
    {"must lie on the finest level as a whole", 1,
     "In a coupled run a part of a solid lies on a coarser level than its surface is computed on.",
     "Refine around the solid: a region of `<AMR><Refine>` that it does not leave, or a wider "
     "`<cell_stability_dilation>` of the regridder, so that it does not move out between regrids."},
    {"the fluid left next to a solid in cell", 1,
     "The part of a cell that a solid leaves to the fluid holds an inadmissible state, and no "
     "neighbour could take its content up.",
     "Take a smaller `<timestep_multiplier>`, or a finer grid where the solid closes a gap."},
    {"a solid moves by more than", 1,
     "A solid in a fluid crosses more cells in a step than its surface can be followed over.",
     "The step is repeated with a smaller length first. If it ends the run, the solid has become "
     "faster than any wave: look at its velocity in the last checkpoint."},
    {"the step turns it inside out", 1,
     "A particle would be inverted (det F <= 0) by the step, and shorter steps did not help.",
     "Take a smaller `<timestep_multiplier>` and more particles in a cell. At very large strains "
     "let particles fail (`<erosion>`), or use a basis that follows them (`cpdi`)."},
    // Solvers
    {"the pressure did not converge", 1,
     "The passes of the semi-implicit pressure solve did not reach the tolerance of the volume "
     "error.",
     "Take a smaller `<cfl>`, a larger `<outer_iteration_tolerance>`, or more "
     "`<max_outer_iterations>`; `sluice tune DECK` finds a faster and safer solver."},
    {"the pressure cannot be solved for", 1,
     "The linear solver refused the system of the pressure: a coefficient is not a number, or a "
     "row "
     "is empty.",
     "The state before is the cause nearly always: see the advice for inadmissible states."},
    {"Newton's method has not converged", 1,
     "The implicit step of a solid found no equilibrium within its iterations. In a static step "
     "the body may have no stable equilibrium at this load (it buckles or breaks), or nothing may "
     "hold it.",
     "Apply the load in smaller steps, hold the body in every direction in which it can move, or "
     "take a dynamic step (`<dynamic>true</dynamic>`)."},
    {"Newton's method: a force is not a number", 1,
     "A particle of the implicit step is deformed beyond what its law can answer.",
     "Apply the load in smaller steps."},
    // The machine
    {"of memory at its peak", 2,
     "The fields and particles of the run need more memory than the machine, or the limit of the "
     "job, has. Nothing was started.",
     "Use larger cells, fewer particles per cell (`<res>`), or more machines; `sluice plan` lists "
     "what takes the memory. `--any-memory` starts the run nevertheless."},
    {"free some space or choose another folder", 3,
     "The disk is full, or your quota is. The archive is complete up to the last indexed step.",
     "Free some space and continue with `sluice run --restart UDA`."},
    {"choose a folder that you may write to", 3, "The folder of the archive may not be written to.",
     "Choose another with `-o DIR`."},
    {"raise the limit of file sizes", 3, "A file would become larger than your shell allows.",
     "Raise the limit with `ulimit -f unlimited`, then continue from the last checkpoint."},
    {"the run ends here", 3,
     "The folder of the archive, its deck or a step was removed or renamed while the run was "
     "writing. A run does not go on whose results would be incomplete.",
     "Start again, or continue from a checkpoint that is still there."},
    {"another run is writing into", 3, "Two runs may not write into one archive.",
     "Wait for the other run, or give this one its own folder with `-o DIR`."},
    {"another rank may have died", 3,
     "A message between ranks failed. The first message of the job's log names the rank that "
     "ended first; it often lacked memory.",
     "See the first message; then try fewer ranks on a machine. The last checkpoint is good."},
    {"mpirun belongs to another MPI than this program", 3,
     "The launcher and the program use different MPI libraries, so that each process runs alone.",
     "Use the `mpirun` of the MPI that Sluice was compiled with (`which -a mpirun`)."},
    {"they do not run the same plan", 3,
     "The ranks do not agree on what is summed: they read different decks, or different builds of "
     "Sluice were started.",
     "Start all ranks with the same executable, deck and options, on machines that see the same "
     "files."},
};

std::string lower(std::string_view text) {
  std::string out(text);
  std::transform(out.begin(), out.end(), out.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return out;
}

// Without the marks of code.
std::string plain(std::string_view text) {
  std::string out;
  for (const char c : text)
    if (c != '`') out += c;
  return out;
}

constexpr std::size_t least_words = 8;  // letters of a text that is sought within phrases

}  // namespace

std::span<const EndingMessage> ending_messages() {
  return table;
}

std::string help_on_message(std::string_view text) {
  const std::string wanted = lower(text);
  std::string found;
  for (const EndingMessage& m : table) {
    const std::string phrase = lower(m.phrase);
    const bool within = wanted.size() >= least_words && phrase.find(wanted) != std::string::npos;
    if (!within && wanted.find(phrase) == std::string::npos) continue;
    found += fmt::format("{}\"... {} ...\" (exit status {})\n  {}\n  What to do: {}\n",
                         found.empty() ? "" : "\n", m.phrase, m.status, plain(m.meaning),
                         plain(m.change));
  }
  return found;
}

std::string page_of_messages() {
  std::string page =
      "# When it stops\n\nEach message that ends a run, what it means and what to change. "
      "`sluice help \"WORDS OF THE MESSAGE\"`\ntells the same. Whatever ends a run, every indexed "
      "step of its archive reads back, and the last checkpoint is\ngood: `sluice run --restart "
      "UDA` continues from it, and `sluice plot UDA --checkpoint` draws it.\n\nThis page is "
      "written by `sluice help --messages`. Faults of a deck are not in it: they name file, line, "
      "what\nwas found and what was expected, and end with status 2 before any work.\n";
  const std::pair<int, const char*> parts[] = {{1, "Status 1: the calculation cannot go on"},
                                               {2, "Status 2: it was not started"},
                                               {3, "Status 3: the machine does not allow it"}};
  for (const auto& [status, title] : parts) {
    page += fmt::format("\n## {}\n", title);
    for (const EndingMessage& m : table)
      if (m.status == status)
        page += fmt::format("\n### ... {} ...\n\n{}\n\n**What to do.** {}\n", m.phrase, m.meaning,
                            m.change);
  }
  return page;
}

}  // namespace sluice
