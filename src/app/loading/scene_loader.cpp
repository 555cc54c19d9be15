// Loading decks for commands that run or plan them.
#include "app/loading/scene_loader.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <set>
#include <stdexcept>

#include "app/loading/components.hpp"
#include "app/loading/exact_start.hpp"
#include "app/loading/sluice_schema.hpp"
#include "app/loading/switched_parts.hpp"
#include "framework/base/communicator.hpp"
#include "framework/base/console.hpp"
#include "framework/deck/faults.hpp"
#include "framework/deck/format/framework_schema.hpp"
#include "framework/deck/load_deck.hpp"
#include "framework/grid/gaps.hpp"
#include "framework/run/analysis/analysis_recorder.hpp"
#include "framework/run/simulation/output_writer.hpp"
#include "framework/run/simulation/run_labels.hpp"
#include "framework/scene/deck_values.hpp"

namespace sluice {
namespace {

void tell(std::vector<Fault>& faults, Warnings warnings) {
  if (warnings == Warnings::refused) refuse_warnings(faults);
  if (!world().is_root() || warnings != Warnings::shown) return;
  const bool colour = wants_colour(stderr);
  for (const Fault& f : faults) {
    if (f.severity == Severity::error) continue;
    fmt::print(stderr, "{}\n", styled(to_string(f), Style::yellow, colour));
  }
}

// All errors as one message; empty when there is none.
std::string errors_of(const std::vector<Fault>& faults) {
  std::string text;
  int count = 0;
  for (const Fault& f : faults)
    if (f.severity == Severity::error) {
      text += "\n" + to_string(f);
      ++count;
    }
  if (count == 0) return {};
  return fmt::format("{} fault{} in the deck:{}", count, count == 1 ? "" : "s", text);
}

void check_gaps(const Scene& scene, const ComponentKind& kind, std::vector<Fault>& faults) {
  if (!has_gaps(scene.grid.levels.front())) return;
  const bool levels = scene.grid.levels.size() > 1 || scene.refinement.adaptive;
  if (kind.takes_gaps && !levels) return;
  add_not_built(faults, scene.grid_settings.where,
                levels
                    ? "several levels of which the coarsest has gaps"
                    : fmt::format("a coarsest level that has gaps, of the component {}", kind.type),
                "together its boxes must fill a rectangular block");
}

// The faults that reading finds are added; with errors among them there is no component.
std::unique_ptr<Component> read_component(const Deck& deck, const SceneOptions& options,
                                          Scene& scene, std::vector<Fault>& faults) {
  scene = read_scene(deck, options, faults);
  if (any_error(faults)) return nullptr;
  const ComponentKind* kind = component_kind(*deck.root);
  if (kind == nullptr)
    throw std::logic_error("a deck without a component passed the schema's check");
  check_gaps(scene, *kind, faults);
  std::unique_ptr<Component> component = kind->make(deck, scene, faults);
  if (component == nullptr) return nullptr;
  std::vector<std::string> histories = labels_of_analyses(*deck.root);
  if (kind->histories != nullptr)
    for (std::string& name : kind->histories(*deck.root)) histories.push_back(std::move(name));
  settle_saves(scene.output, *component, RunLabels(*component, std::move(histories)), faults);
  return component;
}

// The same of each component of a switcher.
void read_parts(const SceneOptions& options, LoadedScene& run, std::vector<Fault>& faults) {
  for (std::size_t n = 0; n < run.parts.size(); ++n) {
    const Deck& deck = run.parts[n].deck;
    if (n == 0) {
      run.component = read_component(deck, options, run.scene, faults);
      continue;
    }
    LaterScene& later = *run.later.emplace_back(std::make_unique<LaterScene>());
    later.component = read_component(deck, options, later.scene, faults);
  }
  if (!any_error(faults)) check_parts(run, faults);
}

// What a deck without faults means.
void read_run(const Deck& deck, const SceneOptions& options, LoadedScene& run,
              std::vector<Fault>& faults) {
  if (!runs_switcher(*deck.root)) {
    run.component = read_component(deck, options, run.scene, faults);
    return;
  }
  run.parts = read_subdecks(*deck.root, sluice_schema());
  for (const SubDeck& part : run.parts)
    faults.insert(faults.end(), part.deck.faults.begin(), part.deck.faults.end());
  if (!any_error(faults)) read_parts(options, run, faults);
  // What the components share, such as the grid, is told once.
  std::set<std::string> told;
  std::erase_if(faults, [&](const Fault& f) { return !told.insert(to_string(f)).second; });
}

constexpr std::int64_t max_cells_to_make = 250'000;

// What a run finds when it is made ready. Levels that a regridder will make have no cells yet.
void make_ready(const Scene& scene, const Component& component, std::vector<Fault>& faults) {
  Hierarchy hierarchy(scene, component, world(), {});
  for (int l = 0; l < hierarchy.level_count(); ++l)
    component.state().initialise(hierarchy.level(l).state());
  const AnalysisRecorder analysis(scene, hierarchy, world());
  faults.insert(faults.end(), analysis.warnings().begin(), analysis.warnings().end());
  sort_saves(scene.output, hierarchy, analysis.field_labels());
}

// With the levels that a run of it would begin with.
void compare_start(const Deck& deck, const Scene& scene, const Component& component,
                   std::vector<Fault>& faults) {
  if (deck.root->find("Meta/exact_solution") == nullptr) return;
  Hierarchy hierarchy(scene, component, world(), {});
  hierarchy.initialise();
  if (const auto fault = exact_start_fault(*deck.root, hierarchy, world(), scene.time.initial_time))
    faults.push_back(*fault);
}

}  // namespace

void refuse_warnings(std::vector<Fault>& faults) {
  for (Fault& f : faults)
    if (f.severity == Severity::warning) f.severity = Severity::error;
}

void tell_warnings(std::vector<Fault> faults, Warnings warnings) {
  tell(faults, warnings);
  if (const std::string errors = errors_of(faults); !errors.empty()) throw InputError(errors);
}

std::vector<Fault> scene_faults(const Deck& deck) {
  std::vector<Fault> faults;
  LoadedScene run;
  try {
    read_run(deck, {}, run, faults);
    if (any_error(faults) || run.scene.grid.cell_count() > max_cells_to_make) return faults;
    make_ready(run.scene, *run.component, faults);
    if (!any_error(faults)) compare_start(deck, run.scene, *run.component, faults);
    for (const auto& later : run.later) make_ready(later->scene, *later->component, faults);
  } catch (const DeckError& e) {
    faults.push_back(e.fault());
  } catch (const InputError& e) {
    add_error(faults, deck.root->where, e.what());
  }
  return faults;
}

std::unique_ptr<LoadedScene> load_scene(const std::string& file,
                                        const std::vector<std::string>& overrides,
                                        const SceneOptions& options, Warnings warnings) {
  auto loaded = std::make_unique<LoadedScene>();
  loaded->deck = load_deck(file, overrides, sluice_schema());
  tell(loaded->deck.faults, warnings);
  if (!loaded->deck.good()) throw InputError(errors_of(loaded->deck.faults));
  std::vector<Fault> faults;
  read_run(loaded->deck, options, *loaded, faults);
  tell(faults, warnings);
  if (const std::string errors = errors_of(faults); !errors.empty()) throw InputError(errors);
  return loaded;
}

}  // namespace sluice
