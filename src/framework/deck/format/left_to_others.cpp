// What decks leave to be told elsewhere: each number is taken from there, with a warning.
#include <fmt/format.h>

#include <filesystem>

#include "framework/deck/faults.hpp"
#include "framework/deck/format/framework_schema.hpp"
#include "framework/deck/format/switcher.hpp"
#include "framework/deck/rule_tools.hpp"
#include "framework/deck/value_text.hpp"

namespace sluice {
namespace {

// The mean of a Sine condition is the pressure of the undisturbed state.
void give_mean_pressure(DeckNode& root, std::vector<Fault>& faults) {
  const DeckNode* pressure = root.find("PhysicalConstants/reference_pressure");
  DeckNode* grid = root.child("Grid");
  DeckNode* conditions = grid == nullptr ? nullptr : grid->child("BoundaryConditions");
  DeckNode* sine = conditions == nullptr ? nullptr : conditions->child("SINE_BC");
  if (sine == nullptr || pressure == nullptr || sine->child("reference_pressure") != nullptr)
    return;
  auto given = std::make_unique<DeckNode>();
  given->name = "reference_pressure";
  given->text = pressure->text;
  given->where = sine->where;
  sine->children.push_back(std::move(given));
  add_warning(
      faults, sine->where,
      fmt::format("<SINE_BC> has no <reference_pressure>: {} of <PhysicalConstants> is used",
                  pressure->text));
}

// The steps of a switcher are those of its components' decks.
void leave_steps_to_components(DeckNode& root, std::vector<Fault>& faults) {
  DeckNode* time = root.child("Time");
  DeckNode* multiplier = time == nullptr ? nullptr : time->child("timestep_multiplier");
  if (!runs_switcher(root) || multiplier == nullptr || real_of(time, multiplier->name) != 0) return;
  multiplier->text = "1";
  add_warning(
      faults, multiplier->where,
      "<timestep_multiplier> 0 has no effect; dropped: those of the components' decks are used");
}

// The folder of the archive is that of -o: of a path on another machine its last part is taken.
void leave_folder_to_command(DeckNode& root, std::vector<Fault>& faults) {
  DeckNode* output = root.child("DataArchiver");
  DeckNode* base = output == nullptr ? nullptr : output->child("filebase");
  if (base == nullptr) return;
  const std::filesystem::path path = base->text;
  const std::string name = path.filename().string();
  if (!path.is_absolute() || name.empty() || name == "." || name == "..") return;
  add_warning(faults, base->where,
              fmt::format("<filebase> {} is read as {}: the folder is given by -o",
                          in_quotes(base->text), in_quotes(name)));
  base->text = name;
}

}  // namespace

void fill_in_from_other_decks(DeckNode& root, std::vector<Fault>& faults) {
  give_mean_pressure(root, faults);
  leave_steps_to_components(root, faults);
  leave_folder_to_command(root, faults);
}

}  // namespace sluice
