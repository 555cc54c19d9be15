// Coarse cells from the fine ones above them, straight into a local box or into a message.
#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "framework/grid/box_list.hpp"
#include "framework/refine/level_transfer.hpp"
#include "framework/refine/region_exchange.hpp"

namespace sluice {
namespace {

// The most coarse cells that one thread takes at a time.
constexpr std::int64_t max_cells = 2048;

// Slabs of a region, with whole rows.
std::vector<IndexBox> slabs(const IndexBox& cells) {
  const int d = cells.size().z > 1 ? 2 : cells.size().y > 1 ? 1 : 0;
  const int n =
      static_cast<int>(std::clamp<std::int64_t>(cells.volume() / max_cells, 1, cells.size()[d]));
  IntVec3 pieces{1, 1, 1};
  pieces[d] = n;
  return split(cells, pieces);
}

}  // namespace

struct Restriction::Plan {
  struct Part {
    int fine = -1, coarse = -1;   // local boxes; -1: of another rank
    IndexBox cells;               // coarse
    PackedMessages::Piece piece;  // where one of the two is -1
  };
  Plan(const Level& coarse, const Level& fine, int rank);

  Level frame;  // the coarse level
  TransferGeometry geometry;
  std::vector<Part> sends, locals, receives;
  PackedMessages messages;
  std::int64_t local_cells = 0;  // coarse ones whose fine cells are here, too
  std::vector<StateViews> fine_views, coarse_views;
  StateViews packed;
};

Restriction::Plan::Plan(const Level& coarse, const Level& fine, int rank)
    : frame(without_boxes(coarse)), geometry{fine.ratio, fine.active} {
  const BoxFinder finder(cells_of(coarse.boxes));
  const std::vector<int> coarse_number = local_numbers(coarse, rank);
  const std::vector<int> fine_number = local_numbers(fine, rank);
  std::vector<int> found;
  for (std::size_t f = 0; f < fine.boxes.size(); ++f) {
    const GridBox& box = fine.boxes[f];
    const IndexBox covered = coarsen(box.cells, geometry.ratio);
    std::int64_t held = 0;
    finder.find(covered, found);
    for (const int n : found) {
      const Part part{
          fine_number[f], coarse_number[n], intersection(covered, coarse.boxes[n].cells), {}};
      held += part.cells.volume();
      if (part.fine >= 0 && part.coarse >= 0) {
        local_cells += part.cells.volume();
        for (const IndexBox& slab : slabs(part.cells))
          locals.push_back({part.fine, part.coarse, slab, {}});
      } else if (part.fine >= 0) {
        sends.push_back(part);
        sends.back().piece = messages.add_send(coarse.boxes[n].owner, part.cells.volume());
      } else if (part.coarse >= 0) {
        receives.push_back(part);
        receives.back().piece = messages.add_receive(box.owner, part.cells.volume());
      }
    }
    if (held != covered.volume() || refine(covered, geometry.ratio) != box.cells)
      throw std::logic_error(fmt::format(
          "level {} does not nest in level {}: the box ({}, {}, {}) to ({}, {}, {}) does not end "
          "where coarse cells do, or lies above cells that no box of level {} holds",
          fine.index, coarse.index, box.cells.lower.x, box.cells.lower.y, box.cells.lower.z,
          box.cells.upper.x, box.cells.upper.y, box.cells.upper.z, coarse.index));
  }
}

Restriction::Restriction(const Level& coarse, const Level& fine, int rank)
    : plan_(std::make_unique<Plan>(coarse, fine, rank)) {}
Restriction::Restriction(Restriction&&) noexcept = default;
Restriction& Restriction::operator=(Restriction&&) noexcept = default;
Restriction::~Restriction() = default;

void Restriction::run(const Warehouse& fine, Warehouse& coarse, const std::vector<int>& slots,
                      const TransferOperators& operators, const ThreadTeam* team) {
  Plan& p = *plan_;
  const int components = component_count(coarse, slots);
  view_boxes(fine, slots, p.fine_views);
  view_boxes(coarse, slots, p.coarse_views);
  p.messages.start(components);
  for (const Plan::Part& s : p.sends) {
    view_array(p.messages.outgoing(s.piece), s.cells, p.frame, components, p.packed);
    operators.restrict_to(p.fine_views[s.fine], p.packed, s.cells, p.geometry);
  }
  p.messages.send();
  const auto restrict_local = [&](std::size_t n, int) {
    const Plan::Part& l = p.locals[n];
    operators.restrict_to(p.fine_views[l.fine], p.coarse_views[l.coarse], l.cells, p.geometry);
  };
  if (team != nullptr && team->size() > 1 && p.local_cells >= 2 * max_cells)
    team->for_each(p.locals.size(), restrict_local);
  else
    for (std::size_t n = 0; n < p.locals.size(); ++n) restrict_local(n, 0);
  p.messages.wait();
  for (const Plan::Part& r : p.receives) {
    view_array(p.messages.incoming(r.piece), r.cells, p.frame, components, p.packed);
    copy_state(p.coarse_views[r.coarse], r.cells, p.packed, {});
  }
}

}  // namespace sluice
