// Loading, running and comparing.
#include "properties/deck_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "app/loading/sluice_schema.hpp"
#include "app/process/study_process.hpp"
#include "framework/archive/archive.hpp"
#include "framework/archive/compare/compare.hpp"
#include "framework/deck/load_deck.hpp"
#include "ice/deck/ice_scene.hpp"
#include "ice/ice.hpp"

namespace sluice::properties {
namespace {

namespace fs = std::filesystem;

void require_good(const std::vector<Fault>& faults) {
  for (const Fault& f : faults)
    if (f.severity == Severity::error) throw InputError(to_string(f));
}

void save_more(Scene& scene) {
  SaveRequest request = scene.output.saves.front();
  for (const char* label :
       {"uvel_FC", "press_equil_CC", "mom_L_ME_CC", "mag_grad_rho_CC", "speedSound_CC"}) {
    request.label = label;
    const auto same = [&](const SaveRequest& r) { return r.label == label; };
    if (std::none_of(scene.output.saves.begin(), scene.output.saves.end(), same))
      scene.output.saves.push_back(request);
  }
}

struct Loaded {
  Scene scene;
  std::unique_ptr<ice::Ice> component;
};

std::unique_ptr<Loaded> load(const Deck& deck, const DeckRun& run) {
  require_good(deck.faults);
  auto loaded = std::make_unique<Loaded>();
  SceneOptions options;
  options.ranks = world().size();
  options.force_directions = run.force_directions;
  std::vector<Fault> faults;
  loaded->scene = read_scene(deck, options, faults);
  require_good(faults);
  if (!(run.split == IntVec3{})) {
    options.boxes = min(run.split, loaded->scene.grid.levels.front().domain.size());
    loaded->scene = read_scene(deck, options, faults);
  }
  ice::IceScene ice_scene = ice::read_ice_scene(deck, loaded->scene, faults);
  require_good(faults);
  if (run.more_saves) save_more(loaded->scene);
  loaded->component = std::make_unique<ice::Ice>(loaded->scene, std::move(ice_scene));
  return loaded;
}

IntVec3 triple(const nlohmann::json& j) {
  return {j.at(0).get<int>(), j.at(1).get<int>(), j.at(2).get<int>()};
}

}  // namespace

nlohmann::json to_json(const DeckRun& r) {
  return {{"deck", r.deck},
          {"folder", r.folder.string()},
          {"split", {r.split.x, r.split.y, r.split.z}},
          {"box_cells", r.box_cells},
          {"block", {r.block.x, r.block.y, r.block.z}},
          {"threads", r.threads},
          {"max_steps", r.max_steps},
          {"force_all", r.force_all},
          {"more_saves", r.more_saves},
          {"restart", r.restart.string()},
          {"restart_step", r.restart_step}};
}

DeckRun deck_run_from_json(const nlohmann::json& j) {
  DeckRun r;
  r.deck = j.at("deck");
  r.folder = j.at("folder").get<std::string>();
  r.split = triple(j.at("split"));
  r.box_cells = j.at("box_cells");
  r.block = triple(j.at("block"));
  r.threads = j.at("threads");
  r.max_steps = j.at("max_steps");
  r.force_all = j.at("force_all");
  r.more_saves = j.at("more_saves");
  r.restart = j.at("restart").get<std::string>();
  r.restart_step = j.at("restart_step");
  return r;
}

Deck load_property_deck(const std::string& full_name) {
  const auto& all = property_decks();
  const bool every_step = full_name.ends_with(every_step_suffix);
  const std::string name =
      every_step ? full_name.substr(0, full_name.size() - every_step_suffix.size()) : full_name;
  const auto it =
      std::find_if(all.begin(), all.end(), [&](const PropertyDeck& d) { return d.name == name; });
  if (it == all.end()) throw std::logic_error("no property deck " + name);
  std::vector<std::string> overrides = it->overrides;
  if (every_step)
    for (const char* one :
         {"Time/max_Timesteps=11", "DataArchiver/outputTimestepInterval=1",
          "DataArchiver/checkpoint/@timestepInterval=1", "DataArchiver/checkpoint/@cycle=0"})
      overrides.emplace_back(one);
  return load_deck(it->file, overrides, sluice_schema());
}

RunReport carry_out(const Deck& deck, const DeckRun& run,
                    const std::function<void(RunOptions&)>& change) {
  const std::unique_ptr<Loaded> loaded = load(deck, run);
  RunOptions o;
  o.parent = run.folder;
  o.output = !run.folder.empty();
  o.threads = run.threads;
  o.force_all = run.force_all;
  o.limits.max_steps = run.max_steps;
  o.progress = ProgressMode::none;
  o.program = "properties";
  o.deck_xml = to_xml(*deck.root);
  o.restart = run.restart;
  o.restart_step = run.restart_step;
  o.block = run.block;
  o.max_box_cells = run.box_cells;
  if (change) change(o);
  Simulation simulation(loaded->scene, *loaded->component, world(), o);
  return simulation.run();
}

RunReport carry_out(const DeckRun& run) {
  return carry_out(load_property_deck(run.deck), run);
}

RunReport carry_out(const Deck& deck, const fs::path& folder,
                    const std::function<void(RunOptions&)>& change) {
  DeckRun run;
  run.folder = folder;
  return carry_out(deck, run, change);
}

std::string carry_out_on_ranks(const std::vector<DeckRun>& runs, int ranks) {
  ScratchFolder scratch;
  nlohmann::json list = nlohmann::json::array();
  for (const DeckRun& r : runs) list.push_back(to_json(r));
  const fs::path file = (scratch / "list") / "runs.json";
  std::ofstream(file) << list.dump();
  ProcessRequest request;
  request.words = {SLUICE_MPIEXEC, "--allow-run-as-root", "--oversubscribe",
                   "-np",          std::to_string(ranks), own_executable().string(),
                   "--runs",       file.string()};
  request.output = file.parent_path() / "log";
  if (const int status = run_process(request); status != 0)
    return fmt::format("exit status {}: {}", status, last_lines(request.output, 10));
  return {};
}

int serve_runs(const fs::path& file) {
  std::ifstream in(file);
  try {
    for (const nlohmann::json& j : nlohmann::json::parse(in)) carry_out(deck_run_from_json(j));
  } catch (const std::exception& e) {
    world().abort(ExitStatus::system, e.what());
  }
  world().finalize();
  return 0;
}

std::string difference(const fs::path& a, const fs::path& b, bool checkpoints, bool common_times,
                       double allowed) {
  CompareOptions options;
  options.checkpoints = checkpoints;
  options.common_times = common_times;
  options.absolute = options.relative = allowed;
  const CompareResult result = compare(Archive::open(a), Archive::open(b), options);
  if (!result.not_comparable.empty()) return "not comparable: " + result.not_comparable.front();
  if (const auto first = result.first())
    return fmt::format("{} values differ, first {}", result.differing, to_string(*first));
  return result.values == 0 ? "nothing was compared" : "";
}

fs::path ScratchFolder::operator/(const std::string& name) const {
  const fs::path path = folder_ / name;
  fs::create_directories(path);
  return path;
}

}  // namespace sluice::properties
