// Gathering flags: the component's diagnostic, regions of the deck, all ranks.
#include "framework/run/refinement_flags.hpp"

namespace sluice {
namespace {

void add_flagged(const Warehouse& outputs, Label label, FlagField& flags) {
  const int slot = outputs.find(label, 0);
  for (int b = 0; b < static_cast<int>(outputs.local_boxes().size()); ++b) {
    const RealView v = outputs.view(slot, 0, b);
    for_each_cell(outputs.local_boxes()[static_cast<std::size_t>(b)].cells, [&](IntVec3 cell) {
      if (v(cell) != 0.0) flags.set(cell);
    });
  }
}

void add_regions(const LevelSolver& solver, const RefinementSettings& settings, FlagField& flags) {
  const Level& level = solver.level();
  for (const RefinedRegion& region : settings.regions) {
    if (region.finest_level <= level.index) continue;
    for (const GridBox& box : solver.state().local_boxes())
      for_each_cell(box.cells, [&](IntVec3 cell) {
        if (region.piece->inside(level.centre(cell))) flags.set(cell);
      });
  }
}

void merge_ranks(FlagField& flags, Communicator& communicator) {
  if (communicator.size() == 1) return;
  std::vector<std::uint64_t>& words = flags.words();
  const std::string mine(reinterpret_cast<const char*>(words.data()),
                         words.size() * sizeof(std::uint64_t));
  for (const std::string& text : communicator.gather_to_all(mine))
    for (std::size_t w = 0; w < words.size(); ++w) {
      std::uint64_t word;
      text.copy(reinterpret_cast<char*>(&word), sizeof word, w * sizeof word);
      words[w] |= word;
    }
}

}  // namespace

FlagField flags_of_level(LevelSolver& solver, const Component& component,
                         const RefinementSettings& settings, double time,
                         Communicator& communicator) {
  FlagField flags(solver.level().domain);
  const Label label = component.refine_flag();
  solver.compute_diagnostics(time, {label});
  add_flagged(solver.outputs(), label, flags);
  add_regions(solver, settings, flags);
  merge_ranks(flags, communicator);
  return flags;
}

}  // namespace sluice
