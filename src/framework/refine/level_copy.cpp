// Copies between two layouts of a level.
#include "framework/grid/box_list.hpp"
#include "framework/refine/level_transfer.hpp"
#include "framework/refine/region_exchange.hpp"

namespace sluice {

struct LevelCopy::Plan {
  struct Part {
    int from = -1, to = -1;  // local boxes; -1: of another rank
    IndexBox cells;
    PackedMessages::Piece piece;  // where one of the two is -1
  };
  Plan(const Level& from, const Level& to, int rank);

  Level frame;
  std::vector<Part> sends, locals, receives;
  PackedMessages messages;
  std::vector<StateViews> from_views, to_views;
  StateViews packed;
};

LevelCopy::Plan::Plan(const Level& from, const Level& to, int rank) : frame(without_boxes(to)) {
  const BoxFinder finder(cells_of(from.boxes));
  const std::vector<int> from_number = local_numbers(from, rank);
  const std::vector<int> to_number = local_numbers(to, rank);
  std::vector<int> found;
  for (std::size_t t = 0; t < to.boxes.size(); ++t) {
    finder.find(to.boxes[t].cells, found);
    for (const int n : found) {
      const Part part{
          from_number[n], to_number[t], intersection(from.boxes[n].cells, to.boxes[t].cells), {}};
      if (part.from >= 0 && part.to >= 0) {
        locals.push_back(part);
      } else if (part.from >= 0) {
        sends.push_back(part);
        sends.back().piece = messages.add_send(to.boxes[t].owner, part.cells.volume());
      } else if (part.to >= 0) {
        receives.push_back(part);
        receives.back().piece = messages.add_receive(from.boxes[n].owner, part.cells.volume());
      }
    }
  }
}

LevelCopy::LevelCopy(const Level& from, const Level& to, int rank)
    : plan_(std::make_unique<Plan>(from, to, rank)) {}
LevelCopy::LevelCopy(LevelCopy&&) noexcept = default;
LevelCopy& LevelCopy::operator=(LevelCopy&&) noexcept = default;
LevelCopy::~LevelCopy() = default;

void LevelCopy::run(const Warehouse& from, Warehouse& to, const std::vector<int>& slots) {
  Plan& p = *plan_;
  const int components = component_count(to, slots);
  view_boxes(from, slots, p.from_views);
  view_boxes(to, slots, p.to_views);
  p.messages.start(components);
  for (const Plan::Part& s : p.sends) {
    view_array(p.messages.outgoing(s.piece), s.cells, p.frame, components, p.packed);
    copy_state(p.packed, s.cells, p.from_views[s.from], {});
  }
  p.messages.send();
  for (const Plan::Part& l : p.locals)
    copy_state(p.to_views[l.to], l.cells, p.from_views[l.from], {});
  p.messages.wait();
  for (const Plan::Part& r : p.receives) {
    view_array(p.messages.incoming(r.piece), r.cells, p.frame, components, p.packed);
    copy_state(p.to_views[r.to], r.cells, p.packed, {});
  }
}

}  // namespace sluice
