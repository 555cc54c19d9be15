// sluice tune DECK: which linear solver is fastest on the deck's own systems.
#include <fmt/format.h>
#include <time.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <optional>

#include "app/command/command_line.hpp"
#include "app/command/option_values.hpp"
#include "app/loading/scene_loader.hpp"
#include "app/process/python_tool.hpp"
#include "app/process/study_process.hpp"
#include "app/process/text_sink.hpp"
#include "app/tune/tune_deck.hpp"
#include "app/tune/tune_report.hpp"
#include "framework/archive/archive.hpp"
#include "framework/base/communicator.hpp"
#include "framework/base/console.hpp"
#include "framework/base/error.hpp"
#include "framework/base/temporary_folder.hpp"
#include "framework/run/simulation/simulation.hpp"

namespace sluice {
namespace {

namespace fs = std::filesystem;

struct TuneRequest {
  std::vector<std::string> overrides;
  std::string deck, json, apply, picture, restart;
  double budget = 60;                   // seconds
  std::optional<int> steps, from_step;  // none: as far as the share of the budget goes
  int systems = 3, threads = 1;
  bool quiet = false;
};

// Of the budget for the run that makes the systems: the first steps are not like the later ones.
constexpr double share_of_run = 1.0 / 3;
// Of the budget for the picture, where one is asked for.
constexpr double share_of_picture = 0.25;
constexpr std::size_t max_right_sides = 4;  // of a system
constexpr std::size_t max_curves = 6;

double seconds_now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

// Of all threads.
double processor_seconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

// Where a person looks on: one line that is overwritten.
class ProgressLine {
 public:
  explicit ProgressLine(bool quiet) : shown_(!quiet && is_terminal(stderr)) {}
  ~ProgressLine() { clear(); }
  void show(const std::string& text) {
    if (!shown_) return;
    const auto width = static_cast<std::size_t>(terminal_width(stderr)) - 1;
    fmt::print(stderr, "\r\033[K{}", text.substr(0, width));
    std::fflush(stderr);
    written_ = true;
  }
  void clear() {
    if (written_) fmt::print(stderr, "\r\033[K");
    written_ = false;
  }

 private:
  bool shown_, written_ = false;
};

void check(const TuneRequest& o) {
  if (!(o.budget > 0))
    throw InputError(fmt::format("--budget is {:g}; it takes seconds greater than 0", o.budget));
  if (o.steps && *o.steps < 1)
    throw InputError(fmt::format("--steps is {}; it takes a number of at least 1", *o.steps));
  if (o.deck.empty() && o.restart.empty())
    throw InputError("name a deck, or an archive with --restart");
  if (o.from_step && o.restart.empty())
    throw InputError("--step names a checkpoint of an archive; give that archive with --restart");
  if (o.systems < 1)
    throw InputError(fmt::format("--systems is {}; it takes a number of at least 1", o.systems));
  if (o.threads < 1) throw InputError("--threads takes a number of at least 1");
  std::error_code none;
  if (!o.apply.empty() && fs::equivalent(o.apply, o.deck, none))
    throw InputError("--apply names the deck itself; the tuned copy needs a name of its own");
}

void need_solve(const Deck& deck) {
  if (deck.root->find("CFD/ICE/ImplicitSolver") != nullptr || deck.root->child("SolverTest"))
    return;
  throw InputError(
      fmt::format("{} solves no linear system: sluice tune is for decks with <ImplicitSolver> in "
                  "<CFD><ICE>",
                  deck.file));
}

// Runs steps of the deck, from its start or from a checkpoint; what they solve for is kept.
CapturedSystems capture(const LoadedScene& loaded, const TuneRequest& o, TuneReport& report) {
  solve::SystemCapture captured(static_cast<std::size_t>(o.systems), max_right_sides);
  RunOptions options;
  options.output = false;
  options.threads = threads_to_use(o.threads);
  if (!o.restart.empty()) {
    const Archive earlier = Archive::open(o.restart);
    options.restart = earlier.folder();
    options.restart_step = earlier.select_checkpoint(o.from_step.value_or(-1)).step;
    report.first_step = options.restart_step;
  }
  if (o.steps) options.limits.max_steps = report.first_step + *o.steps;
  options.limits.wall_seconds = share_of_run * o.budget;
  options.limits.tell = options.limits.warn = false;
  options.progress = ProgressMode::none;
  const double before = processor_seconds();
  Simulation simulation(loaded.scene, *loaded.component, world(), options);
  const RunReport run = simulation.run();
  const double spent = processor_seconds() - before;
  CapturedSystems systems = captured.take();
  if (systems.empty())
    throw PhysicsError(
        run.message.empty()
            ? "these steps of the deck solve no linear system with a nonzero right-hand side"
            : run.message);
  if (run.status == RunStatus::failed && !o.quiet)
    fmt::print(stderr, "sluice: warning: the run ended: {}\n", run.message);
  report.own = captured.settings();
  report.steps = run.steps;
  report.step_seconds = run.steps > 0 && o.threads == 1 ? spent / run.steps : 0;
  for (const auto& system : systems) {
    report.numbers.push_back(system->number());
    report.right_sides.push_back(system->right_sides());
  }
  report.unknowns = systems.back()->unknowns();
  report.levels = systems.back()->levels();
  return systems;
}

std::string bytes_of(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

// The copy is loaded, as a run of it would.
void write_copy(const TuneRequest& o, const TuneReport& report) {
  std::string text = bytes_of(o.deck);
  if (report.worth_it()) text = tuned_deck(text, o.deck, report.own, report.best()->settings);
  write_text(o.apply, text);
  load_scene(o.apply, o.overrides, {}, Warnings::hidden);
  fmt::print("{}: {}\n", report.worth_it() ? "tuned deck" : "copy of the deck", o.apply);
}

// A message instead of a failure where Python cannot draw: the table is complete without.
void draw(const TuneRequest& o, const TuneReport& report) try {
  const TemporaryFolder folder(TemporaryFolder::Place::disk);
  const fs::path json = folder / "tune.json", log = folder / "log";
  std::ofstream(json) << tune_json(report);
  const int status = run_python_tool({"residuals", json.string(), "-o", o.picture}, log);
  if (status == 0)
    fmt::print("picture: {}\n", o.picture);
  else
    fmt::print(stderr, "sluice: warning: no picture: {}\n", last_lines(log, 3));
} catch (const SystemError& missing) {
  fmt::print(stderr, "sluice: warning: no picture: {}\n", missing.what());
}

int tune(TuneRequest o) {
  check(o);
  if (o.deck.empty()) o.deck = (fs::path(o.restart) / "input.xml").string();
  if (world().size() > 1) throw InputError("sluice tune runs on one rank; start it without mpirun");
  const auto loaded =
      load_scene(o.deck, o.overrides, {}, o.quiet ? Warnings::hidden : Warnings::shown);
  if (!loaded->later.empty())
    throw InputError(
        "sluice tune runs one component; name the deck of one component of the switcher");
  need_solve(loaded->deck);
  const double begin = seconds_now();
  const auto clock = [begin] { return seconds_now() - begin; };
  ProgressLine line(o.quiet);
  TuneReport report;
  report.deck = loaded->deck.file;
  report.title = loaded->scene.title;
  report.budget = o.budget;
  line.show(fmt::format("running {}steps of the deck, at most {}",
                        o.steps ? fmt::format("{} ", *o.steps) : "",
                        human_duration(share_of_run * o.budget)));
  const CapturedSystems systems = capture(*loaded, o, report);
  const double for_search = o.picture.empty() ? o.budget : (1 - share_of_picture) * o.budget;
  TuneSearch search(
      systems, solver_candidates(report.own, systems), clock, for_search,
      [&](const TuneProgress& p) {
        line.show(fmt::format("[{}/{}] {}; {} spent, about {} left", p.done + 1, p.all, p.doing,
                              human_duration(p.seconds), human_duration(p.left)));
      });
  report.ranking = search.run();
  report.ranked_by = search.systems_done();
  if (!o.picture.empty()) {
    line.show("residuals against time, for the picture");
    report.curve_goal = relative_tolerance(report.own, systems);
    report.curves = search.curves(report.ranking, report.curve_goal, max_curves, o.budget);
  }
  report.seconds = clock();
  line.clear();
  if (!o.json.empty()) write_text(o.json, tune_json(report));
  if (o.json != "-") fmt::print("{}", tune_text(report));
  if (!o.picture.empty()) draw(o, report);
  if (!o.apply.empty()) write_copy(o, report);
  return static_cast<int>(report.best() == nullptr ? ExitStatus::failed : ExitStatus::good);
}

}  // namespace

void declare_tune_command(Command& command) {
  auto o = std::make_shared<TuneRequest>();
  command.option("DECK", o->deck,
                 "Deck (.ups) with <ImplicitSolver>; with --restart: the archive's own by default");
  command.option("--budget", o->budget, "Seconds for the search (60)");
  command.option("--steps", o->steps,
                 "Time steps to run while linear systems are collected (as many as a third of the "
                 "budget allows)");
  command.option("--restart", o->restart,
                 "Take the systems of the steps after the last checkpoint of this archive");
  command.option("--step", o->from_step, "With --restart: after the checkpoint of this step");
  command.option("--systems", o->systems,
                 "Linear systems to keep, evenly spaced over these steps, the last among them (3)");
  command.option("--apply", o->apply,
                 "Write a copy of the deck with the best solver; all other bytes are unchanged");
  command.option("--picture", o->picture,
                 "Draw residual against time of the best (.png, .svg or .pdf)");
  command.option("--json", o->json, "Write all measurements to this file; -: to standard output");
  add_deck_changes(command, o->overrides);
  command.option("--threads", o->threads,
                 "Threads of the run; the solvers are measured with one thread");
  command.flag("--quiet", o->quiet, "Do not print warnings of the deck and the progress line");
  command.action([o] { return tune(*o); });
}

}  // namespace sluice
