// The tags of a switcher, and what must hold among them.
#include <fmt/format.h>

#include <filesystem>
#include <set>

#include "framework/deck/data_file.hpp"
#include "framework/deck/faults.hpp"
#include "framework/deck/format/framework_schema.hpp"
#include "framework/deck/format/switcher.hpp"
#include "framework/deck/rule_tools.hpp"
#include "framework/deck/schema.hpp"

namespace sluice {
namespace {

namespace fs = std::filesystem;

// Only components that can follow one another may be named, as each hands its state on.
AttributeSpec type_of_part(const std::vector<ComponentWord>& components) {
  AttributeSpec type = attribute("type", "the component, as given in its deck").once();
  if (components.empty()) return type.text();
  std::vector<std::string> words, others = {"arches", "mpmf", "poisson4", "smpm", "smpmice"};
  for (const ComponentWord& c : components) {
    (c.in_turn ? words : others).push_back(c.word);
    for (const std::string& spelling : c.spellings) {
      if (c.in_turn)
        type = type.spelling(spelling, c.word);
      else
        others.push_back(spelling);
    }
  }
  others.emplace_back(switcher_word);
  return type.words(words).not_built(others);
}

TagSpec criterion() {
  return tag("SwitchCriteria",
             "condition for the switch to the next component; the last one has none")
      .attribute(attribute("type", "kind of the condition")
                     .once()
                     .words({"Timestep"})
                     .not_built({"simpleBurn", "steadyBurn", "DDT1"}))
      .child(tag("timestep", "the next component starts after this number of steps of the run")
                 .once()
                 .only_for("type", {"Timestep"})
                 .integer()
                 .at_least(1));
}

TagSpec component_in_turn(const std::vector<ComponentWord>& components) {
  return tag("subcomponent", "a component of the run; they run in the order of the deck")
      .multiple()
      .only_for("type", {switcher_word})
      .with_children(
          {tag("SimulationComponent", "which component runs; absent: that of the deck")
               .attribute(type_of_part(components)),
           tag("input_file",
               "deck of the component: materials, limits of the time step and "
               "everything else except Meta, Grid, DataArchiver and the times of the "
               "run, which are taken from this deck")
               .once()
               .text(),
           criterion(),
           tag("init",
               "a variable that is initialised when the component starts; in fact all "
               "variables that the previous component does not carry are")
               .multiple()
               .with_attributes({attribute("var", "label").once().text(),
                                 attribute("matls", "materials whose variable it is")
                                     .once()
                                     .words({"mpm_matls", "all_matls"})
                                     .not_built({"ice_matls"}),
                                 attribute("levels", "levels on which the variable is initialised")
                                     .index_set()})});
}

// Each component but the last says when its turn ends, each later than the one before.
void check_criteria(const std::vector<const DeckNode*>& parts, std::vector<Fault>& faults) {
  int before = 0;
  for (std::size_t n = 0; n < parts.size(); ++n) {
    const DeckNode* criterion = parts[n]->child("SwitchCriteria");
    const bool last = n + 1 == parts.size();
    if (last && criterion != nullptr)
      add_error(faults, criterion->where,
                "<SwitchCriteria> in the last <subcomponent>: no component follows it",
                "remove it, or add a <subcomponent>");
    if (!last && criterion == nullptr)
      add_error(
          faults, parts[n]->where,
          fmt::format(
              "<subcomponent> {} of {} has no <SwitchCriteria>: those after it would never run",
              n + 1, parts.size()),
          "write <SwitchCriteria type=\"Timestep\"><timestep>N</timestep></SwitchCriteria>");
    if (last || criterion == nullptr) continue;
    const std::optional<int> step = integer_of(criterion, "timestep");
    if (!step) continue;
    if (n > 0 && *step <= before)
      add_error(faults, criterion->child("timestep")->where,
                fmt::format("<timestep> {} of <SwitchCriteria>, but this component starts after "
                            "step {} of the run",
                            *step, before),
                fmt::format("steps are counted from the start of the run: {} or more", before + 1));
    before = *step;
  }
}

// A missing file is told once, however many components name it.
void check_files(const std::vector<const DeckNode*>& parts, std::vector<Fault>& faults) {
  std::set<std::string> told;
  for (const DeckNode* part : parts) {
    const DeckNode* file = part->child("input_file");
    if (file == nullptr || !find_subdeck(*file).empty() || !told.insert(file->text).second)
      continue;
    add_error(faults, file->where,
              fmt::format("<input_file>: the deck '{}' does not exist", file->text),
              "searched in the folder of this deck, in the working directory and in the folders "
              "above the deck");
  }
}

}  // namespace

bool runs_switcher(const DeckNode& root) {
  const DeckNode* component = root.child("SimulationComponent");
  return component != nullptr && component->attribute("type") == switcher_word;
}

std::vector<TagSpec> switcher_tags(const std::vector<ComponentWord>& components) {
  return {tag("carry_over",
              "a variable that is kept from one component to the next; in fact all variables that "
              "both carry are")
              .multiple()
              .only_for("type", {switcher_word})
              .with_attributes({attribute("var", "label").once().text(),
                                attribute("matls", "materials whose variable it is").index_set(),
                                attribute("level", "level of the variable").words({"finest"})}),
          component_in_turn(components)};
}

std::string find_subdeck(const DeckNode& input_file) {
  std::error_code failed;
  const fs::path name = input_file.text, folder = fs::path(input_file.where.file).parent_path();
  std::vector<fs::path> places = search_folders(input_file.where);
  for (fs::path& place : places) place /= name;
  places.emplace_back(name);
  for (const fs::path& path : places)
    if (fs::is_regular_file(path, failed)) return path.lexically_normal().string();
  fs::path above = fs::absolute(folder, failed).lexically_normal();
  while (above.has_relative_path()) {
    above = above.parent_path();
    if (fs::is_regular_file(above / name, failed)) return (above / name).string();
  }
  return {};
}

void check_switcher(const DeckNode& root, std::vector<Fault>& faults) {
  if (!runs_switcher(root)) return;
  const DeckNode* component = root.child("SimulationComponent");
  const std::vector<const DeckNode*> parts = component->all("subcomponent");
  if (parts.empty())
    add_error(faults, component->where,
              "<SimulationComponent type=\"switcher\"> has no <subcomponent>: nothing to run",
              "name the deck of each component in a <subcomponent><input_file>");
  check_files(parts, faults);
  check_criteria(parts, faults);
  if (const DeckNode* analysis = root.child("DataAnalysis"))
    add_not_built(faults, analysis->where, "<DataAnalysis> of a switcher");
  for (const auto& block : root.children)
    for (const char* name : {"MPM", "MaterialProperties", "PhysicalBC", "PhysicalConstants"})
      if (block->name == name && !block->defaulted)
        add_warning(faults, block->where,
                    fmt::format("<{}> has no effect: it belongs in the decks of the components "
                                "that the switcher names",
                                name),
                    "remove it");
}

}  // namespace sluice
