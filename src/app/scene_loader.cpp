// Loading decks for commands that run or plan them.
#include "app/scene_loader.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <stdexcept>

#include "app/components.hpp"
#include "app/sluice_schema.hpp"
#include "framework/base/communicator.hpp"
#include "framework/base/console.hpp"
#include "framework/deck/faults.hpp"
#include "framework/deck/load_deck.hpp"
#include "framework/run/analysis_recorder.hpp"
#include "framework/run/output_writer.hpp"
#include "framework/scene/deck_values.hpp"

namespace sluice {
namespace {

void tell(const std::vector<Fault>& faults, bool quiet) {
  if (!world().is_root()) return;
  const bool colour = wants_colour(stderr);
  for (const Fault& f : faults) {
    if (f.severity == Severity::error || quiet) continue;
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

// The faults that reading finds are added; with errors among them there is no component.
std::unique_ptr<Component> read_component(const Deck& deck, const SceneOptions& options,
                                          Scene& scene, std::vector<Fault>& faults) {
  scene = read_scene(deck, options, faults);
  if (any_error(faults)) return nullptr;
  const ComponentKind* kind = component_kind(deck);
  if (kind == nullptr)
    throw std::logic_error("a deck without a component passed the schema's check");
  return kind->make(deck, scene, faults);
}

constexpr std::int64_t most_cells_to_make = 250'000;

// What a run finds when it is made ready. Levels that a regridder will make have no cells yet.
void make_ready(const Scene& scene, const Component& component, std::vector<Fault>& faults) {
  Hierarchy hierarchy(scene, component, world(), {});
  for (int l = 0; l < hierarchy.level_count(); ++l)
    component.initialise(hierarchy.level(l).state());
  const AnalysisRecorder analysis(scene, hierarchy, world());
  faults.insert(faults.end(), analysis.warnings().begin(), analysis.warnings().end());
  sort_saves(scene.output, hierarchy, analysis.field_labels());
}

}  // namespace

std::vector<Fault> scene_faults(const Deck& deck) {
  std::vector<Fault> faults;
  Scene scene;
  try {
    const auto component = read_component(deck, {}, scene, faults);
    if (component != nullptr && scene.grid.cell_count() <= most_cells_to_make)
      make_ready(scene, *component, faults);
  } catch (const DeckError& e) {
    faults.push_back(e.fault());
  } catch (const InputError& e) {
    add_error(faults, deck.root->where, e.what());
  }
  return faults;
}

std::unique_ptr<LoadedScene> load_scene(const std::string& file,
                                        const std::vector<std::string>& overrides,
                                        const SceneOptions& options, bool quiet) {
  auto loaded = std::make_unique<LoadedScene>();
  loaded->deck = load_deck(file, overrides, sluice_schema());
  tell(loaded->deck.faults, quiet);
  if (!loaded->deck.good()) throw InputError(errors_of(loaded->deck.faults));
  std::vector<Fault> faults;
  loaded->component = read_component(loaded->deck, options, loaded->scene, faults);
  tell(faults, quiet);
  if (const std::string errors = errors_of(faults); !errors.empty()) throw InputError(errors);
  return loaded;
}

}  // namespace sluice
