// sluice run DECK: from deck to archive.
#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <optional>

#include "app/accuracy/target_error.hpp"
#include "app/command/command_line.hpp"
#include "app/command/effect_table.hpp"
#include "app/command/option_values.hpp"
#include "app/command/run_ending.hpp"
#include "app/loading/exact_start.hpp"
#include "app/loading/last_output.hpp"
#include "app/loading/scene_loader.hpp"
#include "app/loading/switched_parts.hpp"
#include "app/plan/best_settings.hpp"
#include "app/plan/memory_check.hpp"
#include "app/process/study_process.hpp"
#include "app/process/text_sink.hpp"
#include "framework/archive/archive.hpp"
#include "framework/archive/xdmf/xdmf_link.hpp"
#include "framework/base/communicator.hpp"
#include "framework/base/console.hpp"
#include "framework/base/json.hpp"
#include "framework/base/temporary_folder.hpp"
#include "framework/run/simulation/simulation.hpp"
#include "sluice_version.hpp"

namespace sluice {
namespace {

struct RunRequest {
  RunOptionValues run;
  std::string deck, restart, json, progress = "auto";
  std::string parent, last_line;  // parent: empty, where the run puts its archive
  std::optional<int> step, max_steps;
  std::optional<double> wall_limit;    // seconds
  std::optional<double> target_error;  // relative
  std::string quantity;
  bool copy = false, costs = false, plot = false, any_memory = false, best_settings = false,
       output_at_end = false;
};

// The deck of the run: as named, or the one that the archive keeps.
std::string deck_file(const RunRequest& o) {
  if (o.restart.empty()) {
    if (o.deck.empty()) throw InputError("name a deck, or an archive with --restart");
    return o.deck;
  }
  if (!o.deck.empty()) return o.deck;  // the run itself looks at the archive
  const std::filesystem::path kept = std::filesystem::path(o.restart) / "input.xml";
  if (!std::filesystem::exists(kept))
    throw InputError(fmt::format("--restart {}: there is no archive ({} does not exist)", o.restart,
                                 kept.string()));
  require_own_format(Archive::open(o.restart));
  return kept.string();
}

// Beside the archive that a restart continues, else in the working folder.
std::string parent_folder(const RunRequest& o) {
  namespace fs = std::filesystem;
  if (!o.parent.empty()) return o.parent;
  if (o.restart.empty()) return ".";
  const fs::path real = fs::canonical(o.restart).parent_path();
  return fs::equivalent(real, ".") ? "." : real.string();
}

void check_numbers(const RunRequest& o) {
  check_run_options(o.run);
  if (o.max_steps && *o.max_steps < 1)
    throw InputError(fmt::format(
        "--max-steps is {}; it takes a step number of at least 1 (leave it out for no limit)",
        *o.max_steps));
  if (o.wall_limit && !(*o.wall_limit > 0))
    throw InputError(fmt::format(
        "--wall-limit is {:g}; it takes seconds greater than 0 (leave it out for no limit)",
        *o.wall_limit));
  if (o.target_error && !(*o.target_error > 0 && *o.target_error < 1))
    throw InputError(fmt::format(
        "--target-error is {:g}; it takes a relative error between 0 and 1, as 0.01 for 1 %",
        *o.target_error));
  if (o.target_error && !o.restart.empty())
    throw InputError("--target-error chooses a resolution; a restart has one already");
  if (!o.quantity.empty() && !o.target_error)
    throw InputError("--quantity says of what --target-error is; give that as well");
  if (o.step && o.restart.empty())
    throw InputError("--step names a checkpoint of an archive; give that archive with --restart");
  if (o.step && *o.step < 0)
    throw InputError(
        fmt::format("--step is {}; it takes the number of a checkpoint's step, which "
                    "sluice info lists",
                    *o.step));
  if (o.json == "-" && (o.costs || o.plot))
    throw InputError(
        "--json - leaves no room on standard output for --costs and --plot; name a "
        "file, or leave them out (the report holds the costs)");
}

// The report alone on standard output, so that a program can read it.
ProgressMode progress_of(const RunRequest& o) {
  const ProgressMode asked = progress_mode_from(o.progress);
  return o.json == "-" ? ProgressMode::none : asked;
}

// Of a run that ended before its end: the command that goes on, or why there is none.
std::string continuation(const RunRequest& o, const RunReport& report) {
  if (!report.archive || report.last_checkpoint < 0)
    return "no checkpoint was written: this run cannot be continued\n";
  ContinueWords words;
  words.archive = *report.archive;
  words.parent = parent_folder(o);
  words.ranks = report.ranks;
  words.threads = o.run.threads;
  words.force_directions = o.run.force_directions;
  words.program = program_word();
  return "continue the run with\n" + command_to_continue(words) + "\n";
}

// Rank 0, the archive complete.
void tell_end(const RunRequest& o, const RunReport& report, ProgressMode progress) {
  if (progress != ProgressMode::none) {
    fmt::print("{}", summary(report));
    if (report.archive && report.status != RunStatus::failed)
      fmt::print("{}", error_lines(*report.archive));
    if (report.archive)
      if (const std::string note = last_output_note(*report.archive); !note.empty())
        fmt::print("{}\n", note);
  }
  if (o.costs)
    fmt::print("{}{}{}", measured_effect_table(report.effects), stages_text(report),
               messages_text(report));
  if (o.plot && !report.archive)
    fmt::print("no archive was written: there is nothing to draw\n");
  else if (o.plot && report.status != RunStatus::failed)
    fmt::print("picture: {}\n", draw_picture(*report.archive).string());
  if (ended_early(report.status))
    fmt::print(progress == ProgressMode::none ? stderr : stdout, "{}", continuation(o, report));
}

// What ParaView opens where it lies. A run that has failed has already said why.
void write_link(const RunReport& report) {
  if (!report.archive) return;
  try {
    const Archive archive = Archive::open(*report.archive);
    if (!archive.outputs().empty()) write_xdmf_link(archive);
  } catch (const Error&) {
    if (report.status != RunStatus::failed) throw;
  }
}

int run_on(Communicator& ranks, const RunRequest& o) {
  check_numbers(o);
  const std::unique_ptr<LoadedScene> loaded = load_scene(
      deck_file(o), o.run.overrides, o.run.scene_options(ranks.size()), o.run.warnings());
  RunOptions options;
  options.parent = parent_folder(o);
  options.output = !o.run.no_output;
  options.threads = threads_to_use(o.run.threads);
  if (!o.any_memory) require_memory(*loaded, ranks, options.threads, o.run.block_extents());
  options.force_all = o.run.force_all;
  options.limits.max_steps = o.max_steps.value_or(0);
  options.limits.wall_seconds = o.wall_limit.value_or(0);
  options.progress = progress_of(o);
  options.limits.tell = !o.run.quiet && options.progress != ProgressMode::none;
  options.program = fmt::format("sluice {}", version::kText);
  options.successors = successors_of(*loaded);
  options.kept_files = keep_files_of(*loaded);
  options.other_decks = name_subdecks(*loaded);
  options.deck_xml = to_xml(*loaded->deck.root);
  // A link to the newest archive will lead to the one that this run makes.
  if (!o.restart.empty()) options.restart = std::filesystem::canonical(o.restart);
  options.restart_step = o.step.value_or(-1);
  options.copy_earlier = o.copy;
  options.block = o.run.block_extents();
  options.limits.warn = !o.run.quiet;
  if (o.run.warnings() != Warnings::hidden && loaded->deck.root->find("Meta/exact_solution"))
    options.look_at_start = [&](Hierarchy& hierarchy, double time) {
      if (const auto fault = exact_start_fault(*loaded->deck.root, hierarchy, ranks, time))
        tell_warnings({*fault}, o.run.warnings());
    };
  // Opened before the run: a path that cannot be written must not cost a run.
  std::optional<TextSink> json;
  if (ranks.is_root() && !o.json.empty()) json.emplace(o.json);
  Simulation simulation(loaded->scene, *loaded->component, ranks, options);
  const RunReport report = simulation.run();
  if (ranks.is_root()) {
    if (json) {
      json->write(to_json(report).dump(2) + "\n");
      json->close();
    }
    if (!report.message.empty()) fmt::print(stderr, "sluice: error: {}\n", report.message);
    tell_end(o, report, options.progress);
    write_link(report);
    if (exit_status_of(report.status) == 0 && !o.last_line.empty()) fmt::print("{}\n", o.last_line);
  }
  return exit_status_of(report.status);
}

// With --target-error: the options with the resolution that a ladder of coarse runs promises.
RunRequest with_chosen_resolution(const Communicator& ranks, RunRequest o) {
  if (!o.target_error) return o;
  check_numbers(o);
  if (ranks.size() > 1)
    throw InputError(
        "--target-error runs a ladder of its own and takes one process; choose the resolution so, "
        "then run on ranks with the --set that it prints");
  const TemporaryFolder folder(TemporaryFolder::Place::disk);
  DeckLadder ladder(own_executable(), deck_file(o), o.run.overrides, folder.path());
  const ResolutionChoice choice = choose_resolution(ladder, *o.target_error, o.quantity);
  if (progress_of(o) != ProgressMode::none) {
    fmt::print("ladder of {} coarse runs: {}\n", ladder.rungs().size(),
               human_duration(choice.ladder_seconds));
    fmt::print(
        "chosen: {:.3g} times the cells of the deck along each direction; promised error {} (of "
        "{}), wanted {}; about {} of stepping\n",
        choice.factor, human_percent(choice.promised), choice.quantity,
        human_percent(*o.target_error), human_duration(choice.seconds));
    for (const std::string& one : choice.overrides) fmt::print("  --set '{}'\n", one);
  }
  o.run.overrides.insert(o.run.overrides.end(), choice.overrides.begin(), choice.overrides.end());
  return o;
}

// With --best-settings: the options with the basis, form and particles that the studies prove.
RunRequest with_best_settings(const Communicator& ranks, RunRequest o) {
  if (!o.best_settings) return o;
  if (!o.restart.empty())
    throw InputError("--best-settings chooses particles; a restart has them already");
  const BestSettings best = best_settings(deck_file(o), o.run.overrides);
  if (ranks.is_root() && progress_of(o) != ProgressMode::none) {
    for (const std::string& reason : best.reasons) fmt::print("solids: {}\n", reason);
    for (const std::string& one : best.overrides) fmt::print("  --set '{}'\n", one);
    if (!best.overrides.empty() && !o.run.no_output)
      fmt::print("the deck that runs is input.xml in the archive\n");
  }
  o.run.overrides.insert(o.run.overrides.end(), best.overrides.begin(), best.overrides.end());
  return o;
}

// With --output-at-end: as if the deck said so; the deck that the archive keeps does.
RunRequest with_output_at_end(RunRequest o) {
  if (o.output_at_end) o.run.overrides.emplace_back("DataArchiver/outputLastTimestep=true");
  return o;
}

// Settings first: the ladder is one of the deck that will run.
RunRequest with_choices(const Communicator& ranks, const RunRequest& o) {
  return with_chosen_resolution(ranks, with_best_settings(ranks, with_output_at_end(o)));
}

// Several ranks end together, whether well, in a failure that all know of, or in one that a single
// rank met while the others wait for its messages.
int run(const RunRequest& o) {
  Communicator& ranks = world();
  if (!ranks.uses_mpi()) return run_on(ranks, with_choices(ranks, o));
  try {
    ranks.exit_together(static_cast<ExitStatus>(run_on(ranks, with_choices(ranks, o))));
  } catch (const Error& e) {
    ranks.abort(e.status(), fmt::format("sluice: error: {}", e.what()));
  } catch (const std::exception& e) {
    ranks.abort(ExitStatus::system, fmt::format("sluice: error: {}", e.what()));
  }
}

}  // namespace

void declare_run_command(Command& command) {
  auto o = std::make_shared<RunRequest>();
  command.option("DECK", o->deck, "Deck (.ups); with --restart: the archive's own by default");
  command.option(
      "-o,--output", o->parent,
      "Parent folder of the archive (default: this folder, or that of the archive restarted)");
  command.option("--max-steps", o->max_steps, "Stop with a checkpoint after this step");
  command.option("--wall-limit", o->wall_limit,
                 "Stop with a checkpoint after this number of seconds");
  command.option("--restart", o->restart, "Continue from the last checkpoint of this archive");
  command.option("--step", o->step, "With --restart: from the checkpoint of this step");
  command.flag("--copy", o->copy,
               "With --restart: copy earlier outputs instead of referring to them");
  command.flag("--any-memory", o->any_memory,
               "Start even if the planned memory is more than the available memory");
  command.flag("--output-at-end", o->output_at_end,
               "Write an output at the end of the run, whatever the deck's interval");
  command.option("--json", o->json,
                 "Write the report of the run to this file; -: to standard output");
  command.option("--progress", o->progress, "auto, plain or none (warnings and errors only)");
  command.option(
      "--target-error", o->target_error,
      "Choose the resolution whose error bar is at most this relative error (0.01: 1 %)");
  command.option("--quantity", o->quantity,
                 "With --target-error: the label or history that it is of (all that is saved)");
  command.flag("--best-settings", o->best_settings,
               "Take the basis, form and particles of solids that the accuracy studies prove to be "
               "best; `sluice plan` names them");
  add_run_options(command, o->run);
  command.flag("--costs", o->costs,
               "Print the measured share of time of each effect, and messages");
  command.option("--last-line", o->last_line,
                 "Print this line at the end of a run that has succeeded, for scripts");
  command.flag("--plot", o->plot, "Draw the last output at the end, with the exact solution");
  command.action([o] { return run(*o); });
}

}  // namespace sluice
