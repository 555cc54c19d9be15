#include "app/loading/switched_parts.hpp"

#include <fmt/format.h>

#include "app/loading/sluice_schema.hpp"
#include "framework/deck/faults.hpp"
#include "framework/deck/schema.hpp"

namespace sluice {
namespace {

// Where the component of a part is named, in its own deck.
const Location& place_of(const SubDeck& part) {
  const DeckNode* component = part.deck.root->child("SimulationComponent");
  return component != nullptr ? component->where : part.where;
}

void check_scene(const Scene& scene, const SubDeck& part, std::vector<Fault>& faults) {
  if (!scene.analysis.modules.empty())
    add_not_built(faults, place_of(part), "<DataAnalysis> of a component of a switcher",
                  "leave it out");
  if (scene.refinement.adaptive)
    add_not_built(faults, place_of(part), "adaptive levels of a component of a switcher",
                  "leave <AMR> out");
}

// Can the part's component go on from the state of the one before.
void check_follows(const Scene& scene_before, const Component& before, const SubDeck& part_before,
                   const Scene& scene, const Component& after, const SubDeck& part,
                   std::vector<Fault>& faults) {
  const std::string follows =
      fmt::format("this component continues the run of {}: ", part_before.deck.file);
  if (const std::string differs = succession_obstacle(*before.particles(), *after.particles());
      !differs.empty()) {
    add_error(faults, place_of(part), follows + differs,
              "the decks of a switcher have the same materials in the same order");
    return;
  }
  for (std::size_t d = 0; d < 3; ++d)
    if (scene_before.directions[d].active != scene.directions[d].active)
      add_error(faults, place_of(part),
                fmt::format("{}direction {} is active in only one of them", follows, "xyz"[d]));
  for (const PassedOn& p : passed_on(*before.particles(), *after.particles()))
    if (!p.lacking.empty())
      add_error(faults, place_of(part),
                fmt::format("{}particles of '{}' need {}, which the particles of the earlier "
                            "component do not have",
                            follows, p.kind, fmt::join(p.lacking, ", ")),
                "give both the same constitutive models and the same flags");
}

}  // namespace

void check_parts(const LoadedScene& run, std::vector<Fault>& faults) {
  check_scene(run.scene, run.parts.front(), faults);
  const Scene* scene_before = &run.scene;
  const Component* before = run.component.get();
  for (std::size_t n = 0; n < run.later.size(); ++n) {
    const LaterScene& later = *run.later[n];
    check_scene(later.scene, run.parts[n + 1], faults);
    check_follows(*scene_before, *before, run.parts[n], later.scene, *later.component,
                  run.parts[n + 1], faults);
    scene_before = &later.scene;
    before = later.component.get();
  }
}

std::vector<Successor> successors_of(const LoadedScene& run) {
  std::vector<Successor> successors;
  for (std::size_t n = 0; n < run.later.size(); ++n)
    successors.push_back(
        {run.parts[n + 1].after, &run.later[n]->scene, run.later[n]->component.get()});
  return successors;
}

KeptFiles keep_files_of(LoadedScene& run) {
  KeptFiles files;
  const Schema schema = sluice_schema();
  keep_files(*run.deck.root, schema, files);
  for (SubDeck& part : run.parts) keep_files(*part.deck.root, schema, files);
  return files;
}

std::map<std::string, std::string> name_subdecks(LoadedScene& run) {
  std::map<std::string, std::string> decks;
  if (run.parts.empty()) return decks;
  std::size_t n = 0;
  for (const auto& child : run.deck.root->child("SimulationComponent")->children) {
    if (child->name != "subcomponent") continue;
    const std::string name = fmt::format("input_{}.xml", n + 1);
    child->child("input_file")->text = name;
    decks[name] = to_xml(*run.parts[n++].deck.root);
  }
  return decks;
}

}  // namespace sluice
