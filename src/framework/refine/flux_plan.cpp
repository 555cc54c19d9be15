// Laying out the patches of an interface: slots, cells with their faces, messages.
#include "framework/refine/flux_plan.hpp"

#include <algorithm>
#include <map>
#include <tuple>
#include <utility>

namespace sluice {

namespace {

// A face of the last cell of the list or of one after it.
void append(const CellFace& face, CellFaces& list) {
  if (list.cells.empty() || list.cells.back() != face.cell) {
    list.cells.push_back(face.cell);
    list.slots.push_back({-1, -1, -1, -1, -1, -1});
  }
  list.slots.back()[static_cast<std::size_t>(face.side)] = face.slot;
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
      number[static_cast<std::size_t>(b.id)] = static_cast<int>(boxes.size());
      boxes.push_back(b);
    }
  }
  std::vector<GridBox> boxes;
  std::vector<int> number;
};

FluxPlan::FluxPlan(const Level& coarse, const Level& fine, int quantity_count, int rank)
    : nothing(fine.boxes.empty() || quantity_count == 0),
      quantities(static_cast<std::size_t>(quantity_count)),
      domain(coarse.domain),
      volume_ratio(1.0 / (static_cast<double>(fine.ratio.x) * fine.ratio.y * fine.ratio.z)) {
  const LocalBoxes coarse_here(coarse, rank), fine_here(fine, rank);
  const Axes axes = active_axes(coarse);
  coarse_faces = FaceTable(coarse_here.boxes, axes, quantity_count);
  fine_faces = FaceTable(fine_here.boxes, axes, quantity_count);
  fine_boxes = fine_here.boxes.size();
  for (int side = 0; side < 2 * axes.count; ++side)
    back[static_cast<std::size_t>(side)] = fine.ratio[axes.direction[side / 2]];
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
  p.fine_box = fine.number[static_cast<std::size_t>(found.fine_box)];
  p.coarse_box = coarse.number[static_cast<std::size_t>(found.coarse_box)];
  if (p.fine_box >= 0) {
    p.fine_slot = fine_faces.add(p.fine_box, found.axis, !found.high, p.fine_cells);
    p.fold = FaceFold(p.fine_cells, faces_each);
  }
  if (p.coarse_box >= 0)
    p.coarse_slot = coarse_faces.add(p.coarse_box, found.axis, found.high, p.coarse_cells);
}

// Cells of the local coarse boxes row by row, from the table of their faces.
void FluxPlan::list_cells(const std::vector<GridBox>& boxes, const Axes& axes) {
  const int along = axes.direction[0];
  std::vector<CellFace> faces;  // of one row
  for (std::size_t b = 0; b < boxes.size(); ++b) {
    CellFaces& list = coarse_cells.emplace_back();
    IndexBox rows = boxes[b].cells;
    rows.upper[along] = rows.lower[along] + 1;
    for_each_cell(rows, [&](IntVec3 row) {
      faces.clear();
      for (int axis = 0; axis < axes.count; ++axis)
        for (const FaceTable::Segment& s : coarse_faces.segments(static_cast<int>(b), axis, row))
          for (int n = 0; n < s.count; ++n) {
            IntVec3 cell = row;
            cell[along] = s.first + n;
            faces.push_back({cell, 2 * axis + (s.high ? 1 : 0), s.slot + n});
          }
      const auto before = [=](const CellFace& a, const CellFace& c) {
        return std::pair(a.cell[along], a.side) < std::pair(c.cell[along], c.side);
      };
      if (!std::is_sorted(faces.begin(), faces.end(), before))
        std::sort(faces.begin(), faces.end(), before);
      for (const CellFace& f : faces) append(f, list);
    });
  }
}

void FluxPlan::add_peers(const Level& coarse, const Level& fine, int rank,
                         const std::vector<InterfacePatch>& found) {
  std::map<int, FluxPeer> by_rank;
  for (std::size_t n = 0; n < found.size(); ++n) {
    const int fine_rank = fine.boxes[static_cast<std::size_t>(found[n].fine_box)].owner;
    const int coarse_rank = coarse.boxes[static_cast<std::size_t>(found[n].coarse_box)].owner;
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
