// One run of a deck inside this process, on all its ranks, with its archive.
#pragma once
#include <filesystem>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

#include "framework/base/temporary_folder.hpp"
#include "framework/deck/deck.hpp"
#include "framework/run/simulation/simulation.hpp"
#include "properties/property_decks.hpp"

namespace sluice::properties {

// How a deck is run; none of it may change a bit of the result.
struct DeckRun {
  std::string deck;              // name of a PropertyDeck
  std::filesystem::path folder;  // parent of the archive
  IntVec3 split{};               // boxes asked for, at most one a cell; 0: as the deck says
  int box_cells = 0;             // most cells of a box of an adaptive level; 0: no limit
  IntVec3 block{};
  int threads = 1;
  int max_steps = 0;
  bool force_all = false;
  bool force_directions = false;  // every direction active: equal to round-off only
  bool more_saves = false;        // step labels and diagnostics that the deck does not ask for
  std::filesystem::path restart;  // an archive to go on from
  int restart_step = -1;
};
nlohmann::json to_json(const DeckRun& run);
DeckRun deck_run_from_json(const nlohmann::json& json);

// Collective. The archive is report.archive. Throws what a run throws.
RunReport carry_out(const DeckRun& run);

// A deck that is not in the table; no archive when no folder is given.
RunReport carry_out(const Deck& deck, const DeckRun& run,
                    const std::function<void(RunOptions&)>& change = {});
RunReport carry_out(const Deck& deck, const std::filesystem::path& folder,
                    const std::function<void(RunOptions&)>& change = {});
// With this at the end of its name a deck runs 11 steps and keeps outputs and checkpoints of each.
inline constexpr std::string_view every_step_suffix = "_every_step";
Deck load_property_deck(const std::string& full_name);

// Runs all of `runs` by `ranks` processes started once (this executable under the launcher).
// Returns the words of the first failure, or "".
std::string carry_out_on_ranks(const std::vector<DeckRun>& runs, int ranks);
// The other end of it: the process was started with --runs FILE.
int serve_runs(const std::filesystem::path& file);

// "" when outputs (or checkpoints) of both archives are equal, bit for bit or up to `allowed`
// (absolute or relative), else what differs.
std::string difference(const std::filesystem::path& a, const std::filesystem::path& b,
                       bool checkpoints, bool common_times = false, double allowed = 0);

// A folder that goes away with the object.
class ScratchFolder {
 public:
  std::filesystem::path operator/(const std::string& name) const;  // makes the folder

 private:
  TemporaryFolder folder_{TemporaryFolder::Place::disk};
};

}  // namespace sluice::properties
