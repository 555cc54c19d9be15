// Options that several commands share, and their values.
#pragma once
#include <string>
#include <vector>

#include "app/command/command_line.hpp"
#include "app/loading/scene_loader.hpp"
#include "framework/base/vec3.hpp"
#include "framework/scene/scene.hpp"

namespace sluice {

// "I,J,K", each at least 1; zeros for an empty text. InputError names the option.
IntVec3 positive_triple(const std::string& text, const char* option);

// How a deck is run: the same for `run`, and for `plan`, which tells what such a run does.
struct RunOptionValues {
  std::vector<std::string> overrides;
  std::string boxes, block;
  int threads = 1;
  bool force_all = false, force_directions = false, no_output = false, quiet = false,
       strict = false;

  SceneOptions scene_options(int ranks) const;
  Warnings warnings() const {
    return strict ? Warnings::refused : quiet ? Warnings::hidden : Warnings::shown;
  }
  IntVec3 block_extents() const;
};

// --set, --add and --save: changes of a deck, as load_deck takes them, in their order. `of` says
// which deck, where a command has several: " of a deck".
void add_deck_changes(Command& command, std::vector<std::string>& overrides,
                      const std::string& of = "");

void add_run_options(Command& command, RunOptionValues& values);
// The threads that a run takes: as many as are asked for, but no more than this process has
// processors, with a note on rank 0. No result depends on their number.
int threads_to_use(int asked);
// InputError for a number out of range.
void check_run_options(const RunOptionValues& values);

}  // namespace sluice
