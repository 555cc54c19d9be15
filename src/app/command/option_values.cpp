// Reading option values.
#include "app/command/option_values.hpp"

#include <fmt/format.h>
#include <sched.h>

#include <cstdio>
#include <thread>

#include "framework/base/communicator.hpp"
#include "framework/base/error.hpp"
#include "framework/deck/load_deck.hpp"

namespace sluice {
namespace {

// Those that the system lets this process run on.
int processors() {
  cpu_set_t set;
  CPU_ZERO(&set);
  if (sched_getaffinity(0, sizeof set, &set) == 0 && CPU_COUNT(&set) > 0) return CPU_COUNT(&set);
  return static_cast<int>(std::thread::hardware_concurrency());  // 0: not known
}

}  // namespace

IntVec3 positive_triple(const std::string& text, const char* option) {
  if (text.empty()) return {};
  IntVec3 v;
  char end = 0;
  const int read = std::sscanf(text.c_str(), "%d,%d,%d%c", &v.x, &v.y, &v.z, &end);
  if (read != 3 || v.x < 1 || v.y < 1 || v.z < 1)
    throw InputError(
        fmt::format("{} takes three positive numbers I,J,K; found '{}'", option, text));
  return v;
}

SceneOptions RunOptionValues::scene_options(int ranks) const {
  SceneOptions options;
  options.ranks = ranks;
  options.boxes = positive_triple(boxes, "--boxes");
  options.force_directions = force_directions;
  return options;
}

IntVec3 RunOptionValues::block_extents() const {
  return positive_triple(block, "--block");
}

void add_deck_changes(Command& command, std::vector<std::string>& overrides,
                      const std::string& of) {
  const auto add = [&overrides](const std::string& path_and_xml) {
    overrides.push_back(addition(path_and_xml));
  };
  command.each(
      "--set", [&overrides](const std::string& text) { overrides.push_back(text); },
      ("Override PATH=VALUE" + of +
       " (may be repeated); the end of a path is enough where it means one place, as "
       "resolution=[500,1,1]")
          .c_str());
  command.each("--add", add,
               "Add tags, PATH=XML (may be repeated), as MaterialProperties/ICE=\"<material> ... "
               "</material>\"");
  command.each(
      "--save",
      [add](const std::string& label) {
        add(fmt::format("DataArchiver=<save label=\"{}\"/>", label));
      },
      "Save one more LABEL (may be repeated)");
}

void add_run_options(Command& command, RunOptionValues& values) {
  add_deck_changes(command, values.overrides);
  command.option("--threads", values.threads, "Threads of each rank");
  command.option("--boxes", values.boxes, "Split the level into I,J,K boxes");
  command.option("--block", values.block,
                 "Extents I,J,K of the blocks, which should fit the cache");
  command.flag("--force-all", values.force_all,
               "Skip no blocks and omit no work (to measure the savings)");
  command.flag("--force-directions", values.force_directions, "Treat every direction as active");
  command.flag("--no-output", values.no_output, "Write no archive");
  command.flag("--quiet", values.quiet,
               "Do not print warnings of the deck and notes about the time step");
  command.flag("--strict", values.strict, "Treat every warning of the deck as an error");
}

int threads_to_use(int asked) {
  const int there = processors();
  if (there < 1 || asked <= there) return asked;
  if (world().is_root())
    fmt::print(stderr,
               "note: --threads {}: this process has {} processor{}; it runs with {} thread{}\n",
               asked, there, there == 1 ? "" : "s", there, there == 1 ? "" : "s");
  return there;
}

void check_run_options(const RunOptionValues& values) {
  if (values.threads < 1) throw InputError("--threads takes a number of at least 1");
}

}  // namespace sluice
