// Bringing fine fluxes to the coarse cells at the same faces, and correcting both levels.
#include "framework/refine/flux_register.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <tuple>
#include <utility>

#include "framework/base/reduction.hpp"
#include "framework/refine/face_fold.hpp"
#include "framework/refine/interface_patches.hpp"

namespace sluice {
namespace {

using Values = std::vector<std::vector<double>>;  // by quantity, by slot
using BySide = std::array<double, 6>;             // side of a cell: 2 * axis + (high ? 1 : 0)

// One patch as this rank sees it; box numbers and first slots are -1 where another rank has them.
struct Patch {
  int side = 0;  // of the coarse cells
  int fine_box = -1, coarse_box = -1;
  IndexBox coarse_cells, fine_cells;
  std::ptrdiff_t fine_slot = -1;    // in the table of fine faces
  std::ptrdiff_t sum_slot = -1;     // of the sums over fine faces, one a coarse face
  std::ptrdiff_t coarse_slot = -1;  // in the table of coarse faces, and of the changes
  FaceFold fold;

  std::size_t faces() const { return static_cast<std::size_t>(coarse_cells.volume()); }
};

// A face of a cell, and where its values are.
struct CellFace {
  IntVec3 cell;
  int side = 0;
  std::ptrdiff_t slot = 0;
};

// Cells, each once, with the slots of their faces by side; -1: none.
struct CellFaces {
  std::vector<IntVec3> cells;
  std::vector<std::array<std::ptrdiff_t, 6>> slots;
};

CellFaces by_cell(std::vector<CellFace>& faces) {
  std::sort(faces.begin(), faces.end(), [](const CellFace& a, const CellFace& b) {
    return std::tie(a.cell.z, a.cell.y, a.cell.x, a.side) <
           std::tie(b.cell.z, b.cell.y, b.cell.x, b.side);
  });
  CellFaces list;
  for (const CellFace& f : faces) {
    if (list.cells.empty() || list.cells.back() != f.cell) {
      list.cells.push_back(f.cell);
      list.slots.push_back({-1, -1, -1, -1, -1, -1});
    }
    list.slots.back()[static_cast<std::size_t>(f.side)] = f.slot;
  }
  return list;
}

// The two faces of a direction are added first, so that mirrored cells get mirrored bits.
double over_faces(const std::array<std::ptrdiff_t, 6>& slots, const std::vector<double>& values,
                  const BySide& scale) {
  const auto at = [&](std::size_t side) {
    return slots[side] < 0 ? 0.0 : scale[side] * values[static_cast<std::size_t>(slots[side])];
  };
  return ((at(0) + at(1)) + (at(2) + at(3))) + (at(4) + at(5));
}

// The boxes of a rank, and their numbers by id.
struct LocalBoxes {
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

// Patches shared with one other rank: the fine cells here and the coarse ones there, and the
// opposite.
struct Peer {
  int rank = 0;
  std::vector<std::size_t> fine_here, coarse_here;
  std::vector<double> fine_buffer, coarse_buffer;
};

constexpr int sums_tag = 2, rest_tag = 3;

}  // namespace

struct FluxRegister::Plan {
  struct Limited {
    std::int64_t count = 0, lowest = 0;
  };

  Plan(const Level& coarse, const Level& fine, int quantity_count, int rank);
  void add_patch(const InterfacePatch& found, const LocalBoxes& coarse, const LocalBoxes& fine,
                 IntVec3 faces_each);
  void add_peers(const Level& coarse, const Level& fine, int rank,
                 const std::vector<InterfacePatch>& found);
  void list_cells(std::size_t coarse_boxes);

  void pack(const std::vector<std::size_t>& which, std::ptrdiff_t Patch::*slot,
            const Values& values, std::vector<double>& buffer) const;
  void unpack(const std::vector<std::size_t>& which, std::ptrdiff_t Patch::*slot, Values& values,
              const std::vector<double>& buffer) const;
  void bring_sums();
  void find_changes();
  Limited correct_coarse(Warehouse& coarse, const std::vector<int>& slots,
                         const TransferOperators& operators);
  void keep_rest();
  void bring_rest();
  bool correct_fine(Warehouse& fine, const std::vector<int>& slots,
                    const TransferOperators& operators);
  void correct_cells(Warehouse& warehouse, int box, const std::vector<int>& slots,
                     const TransferOperators& operators, const CellFaces& faces,
                     const Values& values, const BySide& scale, std::vector<double>& share);
  std::int64_t number_of(IntVec3 cell) const;
  IntVec3 cell_of(std::int64_t number) const;

  bool nothing = true;  // on no rank
  std::size_t quantities = 0;
  IndexBox domain;  // of the coarse level
  FaceTable coarse_faces, fine_faces;
  std::vector<Patch> patches;
  std::vector<Peer> peers;
  double volume_ratio = 1;              // of a fine cell to a coarse cell
  BySide one{}, back{};                 // back: coarse volume over that of the fine cells at a face
  Values sums;                          // by sum_slot: fine fluxes; at last what goes back to them
  Values changes;                       // by coarse_slot: of the coarse cell; at last what is left
  std::vector<CellFaces> coarse_cells;  // by local box
  std::vector<std::vector<double>> coarse_shares;  // by local box, by cell
  std::size_t fine_boxes = 0;
  Messages messages;
  Reduction agreement;

  // Working room of corrections.
  StateViews views;
  ConservedChange change;
  std::vector<std::size_t> changed;  // which of the listed cells
  std::vector<double> changed_share;
};

FluxRegister::Plan::Plan(const Level& coarse, const Level& fine, int quantity_count, int rank)
    : nothing(fine.boxes.empty()),
      quantities(static_cast<std::size_t>(quantity_count)),
      domain(coarse.domain),
      volume_ratio(1.0 / (static_cast<double>(fine.ratio.x) * fine.ratio.y * fine.ratio.z)) {
  const LocalBoxes coarse_here(coarse, rank), fine_here(fine, rank);
  const Axes axes = active_axes(coarse);
  coarse_faces = FaceTable(coarse_here.boxes, axes, quantity_count);
  fine_faces = FaceTable(fine_here.boxes, axes, quantity_count);
  fine_boxes = fine_here.boxes.size();
  one.fill(1.0);
  for (int side = 0; side < 2 * axes.count; ++side)
    back[static_cast<std::size_t>(side)] = fine.ratio[axes.direction[side / 2]];
  const std::vector<InterfacePatch> found = interface_patches(coarse, fine, rank);
  for (const InterfacePatch& f : found) {
    IntVec3 faces_each = fine.ratio;
    faces_each[axes.direction[f.axis]] = 1;
    add_patch(f, coarse_here, fine_here, faces_each);
  }
  coarse_faces.seal();
  fine_faces.seal();
  std::ptrdiff_t sum_count = 0;
  for (Patch& p : patches) {
    if (p.fine_box < 0) continue;
    p.sum_slot = sum_count;
    sum_count += static_cast<std::ptrdiff_t>(p.faces());
  }
  sums.assign(quantities, std::vector<double>(static_cast<std::size_t>(sum_count)));
  changes.assign(quantities, std::vector<double>(static_cast<std::size_t>(coarse_faces.faces())));
  change.amount.resize(quantities);
  list_cells(coarse_here.boxes.size());
  add_peers(coarse, fine, rank, found);
}

void FluxRegister::Plan::add_patch(const InterfacePatch& found, const LocalBoxes& coarse,
                                   const LocalBoxes& fine, IntVec3 faces_each) {
  Patch p;
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
  patches.push_back(p);
}

void FluxRegister::Plan::list_cells(std::size_t coarse_boxes) {
  std::vector<std::vector<CellFace>> faces(coarse_boxes);
  for (const Patch& p : patches) {
    if (p.coarse_box < 0) continue;
    std::ptrdiff_t slot = p.coarse_slot;
    for_each_cell(p.coarse_cells, [&](IntVec3 c) {
      faces[static_cast<std::size_t>(p.coarse_box)].push_back({c, p.side, slot++});
    });
  }
  for (std::vector<CellFace>& f : faces) {
    coarse_cells.push_back(by_cell(f));
    coarse_shares.emplace_back(coarse_cells.back().cells.size(), 1.0);
  }
}

void FluxRegister::Plan::add_peers(const Level& coarse, const Level& fine, int rank,
                                   const std::vector<InterfacePatch>& found) {
  std::map<int, Peer> by_rank;
  for (std::size_t n = 0; n < found.size(); ++n) {
    const int fine_rank = fine.boxes[static_cast<std::size_t>(found[n].fine_box)].owner;
    const int coarse_rank = coarse.boxes[static_cast<std::size_t>(found[n].coarse_box)].owner;
    if (fine_rank == coarse_rank) continue;
    Peer& peer = by_rank[fine_rank == rank ? coarse_rank : fine_rank];
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

void FluxRegister::Plan::pack(const std::vector<std::size_t>& which, std::ptrdiff_t Patch::*slot,
                              const Values& values, std::vector<double>& buffer) const {
  double* next = buffer.data();
  for (const std::size_t n : which)
    for (const std::vector<double>& v : values)
      next = std::copy_n(v.data() + patches[n].*slot, patches[n].faces(), next);
}

void FluxRegister::Plan::unpack(const std::vector<std::size_t>& which, std::ptrdiff_t Patch::*slot,
                                Values& values, const std::vector<double>& buffer) const {
  const double* next = buffer.data();
  for (const std::size_t n : which)
    for (std::vector<double>& v : values) {
      std::copy_n(next, patches[n].faces(), v.data() + patches[n].*slot);
      next += patches[n].faces();
    }
}

// The sums of fine fluxes go where the changes of coarse cells are.
void FluxRegister::Plan::bring_sums() {
  for (Peer& peer : peers)
    if (!peer.coarse_here.empty())
      messages.post_receive(peer.coarse_buffer.data(), peer.coarse_buffer.size(), peer.rank,
                            sums_tag);
  for (Peer& peer : peers) {
    if (peer.fine_here.empty()) continue;
    pack(peer.fine_here, &Patch::sum_slot, sums, peer.fine_buffer);
    messages.post_send(peer.fine_buffer.data(), peer.fine_buffer.size(), peer.rank, sums_tag);
  }
  for (const Patch& p : patches)
    if (p.fine_box >= 0 && p.coarse_box >= 0)
      for (std::size_t q = 0; q < quantities; ++q)
        std::copy_n(sums[q].data() + p.sum_slot, p.faces(), changes[q].data() + p.coarse_slot);
  messages.wait_all();
  for (const Peer& peer : peers)
    unpack(peer.coarse_here, &Patch::coarse_slot, changes, peer.coarse_buffer);
}

void FluxRegister::Plan::find_changes() {
  for (const Patch& p : patches) {
    if (p.coarse_box < 0) continue;
    const double sign = p.side % 2 == 0 ? 1.0 : -1.0;  // low faces: what passes comes in
    for (std::size_t q = 0; q < quantities; ++q) {
      const double* recorded = coarse_faces.values(static_cast<int>(q)) + p.coarse_slot;
      double* c = changes[q].data() + p.coarse_slot;
      for (std::size_t n = 0; n < p.faces(); ++n) c[n] = sign * (c[n] - recorded[n]);
    }
  }
}

// Corrects the listed cells of a local box by the sum over their faces of scale * value. A cell
// that nothing changes is left as it is, to the bit; its share is 1.
void FluxRegister::Plan::correct_cells(Warehouse& warehouse, int box, const std::vector<int>& slots,
                                       const TransferOperators& operators, const CellFaces& faces,
                                       const Values& values, const BySide& scale,
                                       std::vector<double>& share) {
  changed.clear();
  change.cells.clear();
  for (std::vector<double>& a : change.amount) a.clear();
  share.assign(faces.cells.size(), 1.0);
  for (std::size_t c = 0; c < faces.cells.size(); ++c) {
    bool any = false;
    for (std::size_t q = 0; q < quantities; ++q) {
      change.amount[q].push_back(over_faces(faces.slots[c], values[q], scale));
      any = any || change.amount[q].back() != 0.0;
    }
    if (any) {
      changed.push_back(c);
      change.cells.push_back(faces.cells[c]);
    } else {
      for (std::vector<double>& a : change.amount) a.pop_back();
    }
  }
  if (changed.empty()) return;
  views.clear();
  for (const int s : slots)
    for (int c = 0; c < warehouse.info(s).components; ++c)
      views.push_back(warehouse.view(s, c, box));
  changed_share.assign(changed.size(), 0.0);
  operators.correct(views, change, changed_share);
  for (std::size_t n = 0; n < changed.size(); ++n) share[changed[n]] = changed_share[n];
}

std::int64_t FluxRegister::Plan::number_of(IntVec3 cell) const {
  const IntVec3 n = domain.size(), c = cell - domain.lower;
  return c.x + n.x * (c.y + static_cast<std::int64_t>(n.y) * c.z);
}

IntVec3 FluxRegister::Plan::cell_of(std::int64_t number) const {
  const IntVec3 n = domain.size();
  const std::int64_t row = number / n.x;
  return domain.lower + IntVec3{static_cast<int>(number % n.x), static_cast<int>(row % n.y),
                                static_cast<int>(row / n.y)};
}

FluxRegister::Plan::Limited FluxRegister::Plan::correct_coarse(Warehouse& coarse,
                                                               const std::vector<int>& slots,
                                                               const TransferOperators& operators) {
  Limited limited;
  for (std::size_t b = 0; b < coarse_cells.size(); ++b) {
    const CellFaces& faces = coarse_cells[b];
    if (faces.cells.empty()) continue;
    correct_cells(coarse, static_cast<int>(b), slots, operators, faces, changes, one,
                  coarse_shares[b]);
    for (std::size_t c = 0; c < faces.cells.size(); ++c) {
      if (coarse_shares[b][c] >= 1.0) continue;
      const std::int64_t number = number_of(faces.cells[c]);
      limited.lowest = limited.count == 0 ? number : std::min(limited.lowest, number);
      ++limited.count;
    }
  }
  return limited;
}

// What the coarse cells did not take, face by face.
void FluxRegister::Plan::keep_rest() {
  for (std::size_t b = 0; b < coarse_cells.size(); ++b)
    for (std::size_t c = 0; c < coarse_cells[b].cells.size(); ++c) {
      const double share = coarse_shares[b][c];
      for (const std::ptrdiff_t slot : coarse_cells[b].slots[c]) {
        if (slot < 0) continue;
        for (std::vector<double>& v : changes) {
          double& rest = v[static_cast<std::size_t>(slot)];
          rest = share < 1.0 ? (1.0 - share) * rest : 0.0;
        }
      }
    }
}

void FluxRegister::Plan::bring_rest() {
  for (Peer& peer : peers)
    if (!peer.fine_here.empty())
      messages.post_receive(peer.fine_buffer.data(), peer.fine_buffer.size(), peer.rank, rest_tag);
  for (Peer& peer : peers) {
    if (peer.coarse_here.empty()) continue;
    pack(peer.coarse_here, &Patch::coarse_slot, changes, peer.coarse_buffer);
    messages.post_send(peer.coarse_buffer.data(), peer.coarse_buffer.size(), peer.rank, rest_tag);
  }
  for (const Patch& p : patches)
    if (p.fine_box >= 0 && p.coarse_box >= 0)
      for (std::size_t q = 0; q < quantities; ++q)
        std::copy_n(changes[q].data() + p.coarse_slot, p.faces(), sums[q].data() + p.sum_slot);
  messages.wait_all();
  for (const Peer& peer : peers) unpack(peer.fine_here, &Patch::sum_slot, sums, peer.fine_buffer);
}

// Gives the rest to the fine cells at the same faces, so that the amounts on both levels add up;
// true when one of them cannot take it. Rare, so that its lists are made here.
bool FluxRegister::Plan::correct_fine(Warehouse& fine, const std::vector<int>& slots,
                                      const TransferOperators& operators) {
  std::vector<std::vector<CellFace>> faces(fine_boxes);
  for (const Patch& p : patches) {
    if (p.fine_box < 0) continue;
    const IntVec3 wide = p.coarse_cells.size(),
                  each{p.fine_cells.size().x / wide.x, p.fine_cells.size().y / wide.y,
                       p.fine_cells.size().z / wide.z};
    for_each_cell(p.fine_cells, [&](IntVec3 cell) {
      const IntVec3 at = cell - p.fine_cells.lower;
      const std::ptrdiff_t slot =
          p.sum_slot + at.x / each.x + wide.x * (at.y / each.y + wide.y * (at.z / each.z));
      const bool some = std::any_of(sums.begin(), sums.end(), [&](const std::vector<double>& v) {
        return v[static_cast<std::size_t>(slot)] != 0.0;
      });
      if (some) faces[static_cast<std::size_t>(p.fine_box)].push_back({cell, p.side ^ 1, slot});
    });
  }
  bool failed = false;
  std::vector<double> share;
  for (std::size_t b = 0; b < fine_boxes; ++b) {
    if (faces[b].empty()) continue;
    correct_cells(fine, static_cast<int>(b), slots, operators, by_cell(faces[b]), sums, back,
                  share);
    failed = failed || std::any_of(share.begin(), share.end(), [](double s) { return !(s >= 1); });
  }
  return failed;
}

FluxRegister::FluxRegister(const Level& coarse, const Level& fine, int quantities, int rank)
    : plan_(std::make_unique<Plan>(coarse, fine, quantities, rank)) {}
FluxRegister::FluxRegister(FluxRegister&&) noexcept = default;
FluxRegister& FluxRegister::operator=(FluxRegister&&) noexcept = default;
FluxRegister::~FluxRegister() = default;

FaceTable& FluxRegister::coarse_faces() {
  return plan_->coarse_faces;
}
FaceTable& FluxRegister::fine_faces() {
  return plan_->fine_faces;
}

void FluxRegister::clear() {
  plan_->coarse_faces.clear();
  plan_->fine_faces.clear();
  for (std::vector<double>& s : plan_->sums) std::fill(s.begin(), s.end(), 0.0);
}

void FluxRegister::add_substep() {
  for (const Patch& p : plan_->patches)
    if (p.fine_box >= 0)
      for (std::size_t q = 0; q < plan_->quantities; ++q)
        p.fold.add(plan_->fine_faces.values(static_cast<int>(q)) + p.fine_slot, plan_->volume_ratio,
                   plan_->sums[q].data() + p.sum_slot);
}

CorrectionReport FluxRegister::correct(Warehouse& coarse, Warehouse& fine,
                                       const std::vector<int>& slots,
                                       const TransferOperators& operators,
                                       Communicator& communicator) {
  CorrectionReport report;
  if (plan_->nothing) return report;
  plan_->bring_sums();
  plan_->find_changes();
  const Plan::Limited limited = plan_->correct_coarse(coarse, slots, operators);
  Reduction& agreed = plan_->agreement;
  agreed.clear();
  const auto count = agreed.add_count(limited.count);
  const auto lowest = agreed.add_minimum(limited.count > 0 ? 0.0 : 1.0, limited.lowest);
  communicator.reduce(agreed);
  report.limited = agreed.count(count);
  if (report.limited == 0) return report;
  report.first = plan_->cell_of(agreed.tag(lowest));
  plan_->keep_rest();
  plan_->bring_rest();
  const bool failed_here = plan_->correct_fine(fine, slots, operators);
  agreed.clear();
  const auto failed = agreed.add_any(failed_here);
  communicator.reduce(agreed);
  report.failed = agreed.any(failed);
  return report;
}

std::size_t FluxRegister::bytes() const {
  const Plan& p = *plan_;
  std::size_t n = p.coarse_faces.bytes() + p.fine_faces.bytes() + p.patches.size() * sizeof(Patch);
  for (const Values* values : {&p.sums, &p.changes, &p.coarse_shares})
    for (const std::vector<double>& v : *values) n += v.capacity() * sizeof(double);
  for (const CellFaces& c : p.coarse_cells)
    n += c.cells.capacity() * (sizeof(IntVec3) + sizeof(c.slots.front()));
  for (const Peer& peer : p.peers)
    n += (peer.fine_buffer.capacity() + peer.coarse_buffer.capacity()) * sizeof(double);
  return n;
}

}  // namespace sluice
