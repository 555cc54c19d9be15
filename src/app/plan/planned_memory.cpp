// Counting bytes: scratch of the sweeps, states, outputs, messages, the initial fill.
#include "app/plan/planned_memory.hpp"

#include <algorithm>

#include "framework/grid/box_frames.hpp"
#include "framework/task/block_sweep.hpp"
#include "framework/task/halo.hpp"
#include "framework/task/sweep_executor.hpp"

namespace sluice {
namespace {

// A process that has read a deck and opened an archive, without fields; measured.
constexpr double base_bytes = 34.5 * 1024 * 1024;
constexpr double base_bytes_with_ranks = 48.5 * 1024 * 1024;
constexpr double real_bytes = sizeof(double);
// The initial fill keeps six primitives of the largest box, a count and a flag a cell.
constexpr double fill_bytes_per_cell = 6 * real_bytes + 5;

class MemoryPlanner {
 public:
  explicit MemoryPlanner(const MemoryRequest& request)
      : r_(request), levels_(request.hierarchy.grid()) {}

  std::pair<PlannedMemory, PlannedMessages> plan() const {
    PlannedMemory m;
    PlannedMessages messages;
    m.base = r_.ranks > 1 ? base_bytes_with_ranks : base_bytes;
    std::set<Label> kept = r_.stored;
    m.scratch = scratch_bytes_of_all(kept);
    kept.insert(r_.computed.begin(), r_.computed.end());
    m.state_doubles_per_cell = state_components(r_.component);
    for (const SlotInfo& s : r_.component.state().work_slots())
      m.work_doubles_per_cell += s.components;
    m.step_arrays = r_.component.step().array_bytes(levels_.back());
    for (Label l : kept) m.output_doubles_per_cell += stored_components(r_.materials, l);
    const PlannedMemory alike = m;  // on all ranks; the rest depends on their boxes
    double sum = 0;
    for (int rank = 0; rank < r_.ranks; ++rank) {
      PlannedMemory here = alike;
      add_fields(here, rank, kept);
      if (r_.ranks > 1) here.messages = 2 * bytes_sent(rank, messages);  // sent and received
      sum += here.peak();
      if (rank == 0 || here.peak() > m.peak()) m = here;
    }
    m.all_ranks = sum;
    return {m, messages};
  }

 private:
  // Plain steps, those that store more, and diagnostics have sweeps of their own.
  double scratch_bytes_of_all(const std::set<Label>& kept) const {
    const Level& level = r_.scene.grid.levels.front();
    double bytes = scratch_bytes(plan_step_graph(r_.component, level, {}));
    if (!kept.empty()) bytes += scratch_bytes(plan_step_graph(r_.component, level, kept));
    if (!r_.computed.empty())
      bytes += scratch_bytes(plan_diagnostic_graph(r_.component, level, r_.computed));
    return bytes;
  }

  // So has each level.
  double scratch_bytes(const PlannedGraph& g) const {
    double bytes = 0;
    for (const Level& level : levels_) {
      const IntVec3 block =
          r_.block == IntVec3{} ? default_block(level, r_.component.blocks().size()) : r_.block;
      IntVec3 largest{1, 1, 1};
      for (const Block& b : place_blocks(level.boxes, block))
        largest = max(largest, b.cells.size());
      const StateBinding none;
      bytes +=
          static_cast<double>(BlockSweep(g.list, g.plan, level, none, largest).scratch_bytes());
    }
    return r_.threads * bytes;
  }

  // Bytes of one component over the boxes of a level on a rank, with this many ghost layers.
  static double array_bytes(const Level& level, int rank, int ghosts) {
    double cells = 0;
    for (const GridBox& b : level.boxes)
      if (b.owner == rank)
        cells += static_cast<double>(b.cells.grown(level.ghosts(ghosts)).volume());
    return real_bytes * cells;
  }

  // Under gravity the fill reaches down to the low end of the domain and is cut afterwards.
  double initial_fill_bytes(const Level& level, const GridBox& box) const {
    const IndexBox& cells = box.cells;
    IndexBox filled = cells;
    for (int d = 0; d < 3; ++d)
      if (r_.scene.constants.gravity[d] != 0) filled.lower[d] = level.domain.lower[d];
    const double whole = fill_bytes_per_cell * static_cast<double>(filled.volume());
    if (filled == cells) return whole;
    return std::max(whole, 6 * real_bytes * static_cast<double>(filled.volume() + cells.volume()));
  }

  void add_fields(PlannedMemory& m, int rank, const std::set<Label>& kept) const {
    for (const Level& level : levels_) {
      // Old and new; with substeps also the state at the start of the coarse step.
      const int copies = r_.hierarchy.levels[level.index].substeps > 1 ? 3 : 2;
      for (const SlotInfo& s : r_.component.state().slots())
        m.states += copies * s.components * real_bytes *
                    static_cast<double>(framed_cells(level, rank, s.ghosts));
      const int width = halo_width(r_.component.state());
      m.work_fields += copies * m.work_doubles_per_cell * real_bytes *
                       static_cast<double>(framed_cells(level, rank, width));
      for (Label l : kept)
        m.outputs += stored_components(r_.materials, l) *
                     array_bytes(level, rank, l.info().centring == Centring::cell ? 0 : 1);
      for (const GridBox& b : level.boxes)
        if (b.owner == rank)
          m.initial_fill = std::max(m.initial_fill, initial_fill_bytes(level, b));
    }
  }

  // By a rank in a step; `most` keeps those of the one that sends most.
  double bytes_sent(int rank, PlannedMessages& most) const {
    int width = 0, components = 0;
    for (const SlotInfo& s : r_.component.state().slots()) {
      width = std::max(width, s.ghosts);
      components += s.components;
    }
    double all_levels = 0;
    for (const Level& level : levels_) {
      const HaloExchange halo(level, width, rank);
      const auto bytes = static_cast<std::int64_t>(halo.message_bytes(components));
      all_levels += static_cast<double>(bytes);
      if (level.index == 0 && bytes > most.bytes) most = {bytes, halo.neighbour_ranks()};
    }
    return all_levels;
  }

  const MemoryRequest& r_;
  std::vector<Level> levels_;  // of the start
};

}  // namespace

double PlannedMemory::peak() const {
  return base + states + work_fields + step_arrays + particles +
         std::max(initial_fill, outputs + scratch + messages);
}

double stored_components(const MaterialsOfLabels& materials, Label label) {
  const auto found = materials.find(label);
  const double count = found == materials.end() ? 1.0 : static_cast<double>(found->second.size());
  return component_count(label.info().type) * count;
}

std::pair<PlannedMemory, PlannedMessages> plan_memory(const MemoryRequest& request) {
  return MemoryPlanner(request).plan();
}

}  // namespace sluice
