// Laying out the patches of an interface: slots, cells with their faces, messages.
#include "framework/refine/flux_plan.hpp"

#include <algorithm>
#include <map>
#include <tuple>
#include <utility>

namespace sluice {

namespace {

constexpr std::array<std::ptrdiff_t, 6> no_faces = {-1, -1, -1, -1, -1, -1};

// A face of the last cell of the list or of one after it.
void append(const CellFace& face, CellFaces& list) {
  if (list.cells.empty() || list.cells.back() != face.cell) {
    list.cells.push_back(face.cell);
    list.slots.push_back(no_faces);
  }
  list.slots.back()[face.side] = face.slot;
}

}  // namespace

CellFaces by_cell(std::vector<CellFace>& faces) {
  const auto before = [](const CellFace& a, const CellFace& b) {
    return std::tie(a.cell.z, a.cell.y, a.cell.x, a.side) <
           std::tie(b.cell.z, b.cell.y, b.cell.x, b.side);
  };
  if (!std::is_sorted(faces.begin(), faces.end(), before))
    std::sort(faces.begin(), faces.end(), before);
  std::size_t cells = 0;
  for (std::size_t n = 0; n < faces.size(); ++n)
    if (n == 0 || faces[n].cell != faces[n - 1].cell) ++cells;
  CellFaces list;
  list.cells.reserve(cells);
  list.slots.reserve(cells);
  for (const CellFace& f : faces) append(f, list);
  return list;
}

// The boxes of a rank, and their numbers by id.
struct FluxPlan::LocalBoxes {
  LocalBoxes(const Level& level, int rank) : number(level.boxes.size(), -1) {
    for (const GridBox& b : level.boxes) {
      if (b.owner != rank) continue;
      number[b.id] = static_cast<int>(boxes.size());
      boxes.push_back(b);
    }
  }
  std::vector<GridBox> boxes;
  std::vector<int> number;
};

FluxPlan::FluxPlan(const Level& coarse, const Level& fine, int quantity_count, int rank)
    : nothing(fine.boxes.empty() || quantity_count == 0),
      quantities(quantity_count),
      domain(coarse.domain),
      volume_ratio(1.0 / (static_cast<double>(fine.ratio.x) * fine.ratio.y * fine.ratio.z)) {
  const LocalBoxes coarse_here(coarse, rank), fine_here(fine, rank);
  const Axes axes = active_axes(coarse);
  coarse_faces = FaceTable(coarse_here.boxes, axes, quantity_count);
  fine_faces = FaceTable(fine_here.boxes, axes, quantity_count);
  fine_boxes = fine_here.boxes.size();
  for (int side = 0; side < 2 * axes.count; ++side)
    back[side] = fine.ratio[axes.direction[side / 2]];
  const std::vector<InterfacePatch> found = interface_patches(coarse, fine, rank);
  patches.reserve(found.size());
  for (const InterfacePatch& f : found) {
    IntVec3 faces_each = fine.ratio;
    faces_each[axes.direction[f.axis]] = 1;
    add_patch(f, coarse_here, fine_here, faces_each);
  }
  coarse_faces.seal();
  fine_faces.seal();
  for (FluxPatch& p : patches) {
    if (p.fine_box < 0) continue;
    p.sum_slot = static_cast<std::ptrdiff_t>(sum_count);
    sum_count += p.faces();
  }
  list_cells(coarse_here.boxes, axes);
  add_peers(coarse, fine, rank, found);
}

void FluxPlan::add_patch(const InterfacePatch& found, const LocalBoxes& coarse,
                         const LocalBoxes& fine, IntVec3 faces_each) {
  FluxPatch& p = patches.emplace_back();
  p.side = 2 * found.axis + (found.high ? 1 : 0);
  p.coarse_cells = found.coarse_cells;
  p.fine_cells = found.fine_cells;
  p.fine_box = fine.number[found.fine_box];
  p.coarse_box = coarse.number[found.coarse_box];
  if (p.fine_box >= 0) {
    p.fine_slot = fine_faces.add(p.fine_box, found.axis, !found.high, p.fine_cells);
    p.fold = FaceFold(p.fine_cells, faces_each);
  }
  if (p.coarse_box >= 0)
    p.coarse_slot = coarse_faces.add(p.coarse_box, found.axis, found.high, p.coarse_cells);
}

// The faces of the cells of one row, to be listed in order.
class FluxPlan::RowFaces {
 public:
  RowFaces(const IndexBox& box, int along)
      : along_(along),
        low_(box.lower[along]),
        slots_(box.size()[along], no_faces),
        any_(slots_.size(), 0) {}

  void add(const FaceTable::Segment& s, int side) {
    const std::size_t low = s.first - low_, count = s.count;
    first_ = std::min(first_, low);
    last_ = std::max(last_, low + count);
    for (std::size_t n = 0; n < count; ++n) {
      slots_[low + n][side] = s.slot + static_cast<std::ptrdiff_t>(n);
      any_[low + n] = 1;
    }
  }
  // Lists them from number `next` on; how many.
  std::size_t move_to(CellFaces& list, std::size_t next, IntVec3 row) {
    const std::size_t start = next;
    for (std::size_t n = first_; n < last_; ++n) {
      if (any_[n] == 0) continue;
      row[along_] = low_ + static_cast<int>(n);
      list.cells[next] = row;
      list.slots[next++] = slots_[n];
      slots_[n] = no_faces;
      any_[n] = 0;
    }
    first_ = any_.size();
    last_ = 0;
    return next - start;
  }

 private:
  int along_, low_;
  std::vector<std::array<std::ptrdiff_t, 6>> slots_;  // by cell
  std::vector<std::uint8_t> any_;
  std::size_t first_ = any_.size(), last_ = 0;  // cells with faces
};

// Cells of the local coarse boxes row by row, from the table of their faces.
void FluxPlan::list_cells(const std::vector<GridBox>& boxes, const Axes& axes) {
  std::vector<std::size_t> faces(boxes.size(), 0);
  for (const FluxPatch& p : patches)
    if (p.coarse_box >= 0) faces[p.coarse_box] += p.faces();
  coarse_cells.resize(boxes.size());
  const int along = axes.direction[0];
  for (std::size_t b = 0; b < boxes.size(); ++b) {
    if (faces[b] == 0) continue;
    CellFaces& list = coarse_cells[b];
    list.resize(faces[b]);
    std::size_t count = 0;
    RowFaces found(boxes[b].cells, along);
    IndexBox rows = boxes[b].cells;
    rows.upper[along] = rows.lower[along] + 1;
    for_each_cell(rows, [&](IntVec3 row) {
      for (int axis = 0; axis < axes.count; ++axis)
        for (const FaceTable::Segment& s : coarse_faces.segments(static_cast<int>(b), axis, row))
          found.add(s, 2 * axis + (s.high ? 1 : 0));
      count += found.move_to(list, count, row);
    });
    list.resize(count);
  }
}

void FluxPlan::add_peers(const Level& coarse, const Level& fine, int rank,
                         const std::vector<InterfacePatch>& found) {
  std::map<int, FluxPeer> by_rank;
  for (std::size_t n = 0; n < found.size(); ++n) {
    const int fine_rank = fine.boxes[found[n].fine_box].owner;
    const int coarse_rank = coarse.boxes[found[n].coarse_box].owner;
    if (fine_rank == coarse_rank) continue;
    FluxPeer& peer = by_rank[fine_rank == rank ? coarse_rank : fine_rank];
    (fine_rank == rank ? peer.fine_here : peer.coarse_here).push_back(n);
  }
  for (auto& [other, peer] : by_rank) {
    std::size_t fine_values = 0, coarse_values = 0;
    for (const std::size_t n : peer.fine_here) fine_values += patches[n].faces() * quantities;
    for (const std::size_t n : peer.coarse_here) coarse_values += patches[n].faces() * quantities;
    peer.rank = other;
    peer.fine_buffer.resize(fine_values);
    peer.coarse_buffer.resize(coarse_values);
    peers.push_back(std::move(peer));
  }
}

}  // namespace sluice
