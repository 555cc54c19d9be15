// Bringing fine fluxes to the coarse cells at the same faces, and correcting both levels.
#include "framework/refine/flux_register.hpp"

#include <algorithm>

#include "framework/base/reduction.hpp"
#include "framework/refine/flux_plan.hpp"

namespace sluice {
namespace {

// A number for each quantity and slot.
class Values {
 public:
  Values(std::size_t quantities, std::size_t slots) : slots_(slots), all_(quantities * slots) {}
  double* operator[](std::size_t quantity) { return all_.data() + quantity * slots_; }
  const double* operator[](std::size_t quantity) const { return all_.data() + quantity * slots_; }
  void clear() { std::fill(all_.begin(), all_.end(), 0.0); }
  std::size_t bytes() const { return all_.capacity() * sizeof(double); }

 private:
  std::size_t slots_;
  std::vector<double> all_;
};

// The two faces of a direction are added first, so that mirrored cells get mirrored bits.
double over_faces(const std::array<std::ptrdiff_t, 6>& slots, const double* values,
                  const BySide& scale) {
  const auto at = [&](std::size_t side) {
    return slots[side] < 0 ? 0.0 : scale[side] * values[slots[side]];
  };
  return ((at(0) + at(1)) + (at(2) + at(3))) + (at(4) + at(5));
}

constexpr BySide whole = {1, 1, 1, 1, 1, 1};
constexpr int sums_tag = 2, rest_tag = 3;

}  // namespace

struct FluxRegister::Work : FluxPlan {
  struct Limited {
    std::int64_t count = 0, lowest = 0;
  };

  Work(const Level& coarse, const Level& fine, int quantity_count, int rank);
  void pack(const std::vector<std::size_t>& which, std::ptrdiff_t FluxPatch::*slot,
            const Values& values, std::vector<double>& buffer) const;
  void unpack(const std::vector<std::size_t>& which, std::ptrdiff_t FluxPatch::*slot,
              Values& values, const std::vector<double>& buffer) const;
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

  Values sums;     // by sum_slot: fine fluxes; at last what goes back to them
  Values changes;  // by coarse_slot: of the coarse cell; at last what it did not take
  std::vector<std::vector<double>> coarse_shares;  // by local box, by listed cell
  Messages messages;
  Reduction agreement;

  // Working room of corrections.
  StateViews views;
  ConservedChange change;
  std::vector<std::size_t> changed;  // which of the listed cells
  std::vector<double> changed_share;
};

FluxRegister::Work::Work(const Level& coarse, const Level& fine, int quantity_count, int rank)
    : FluxPlan(coarse, fine, quantity_count, rank),
      sums(quantities, sum_count),
      changes(quantities, coarse_faces.faces()),
      coarse_shares(coarse_cells.size()) {
  change.amount.resize(quantities);
}

void FluxRegister::Work::pack(const std::vector<std::size_t>& which,
                              std::ptrdiff_t FluxPatch::*slot, const Values& values,
                              std::vector<double>& buffer) const {
  double* next = buffer.data();
  for (const std::size_t n : which)
    for (std::size_t q = 0; q < quantities; ++q)
      next = std::copy_n(values[q] + patches[n].*slot, patches[n].faces(), next);
}

void FluxRegister::Work::unpack(const std::vector<std::size_t>& which,
                                std::ptrdiff_t FluxPatch::*slot, Values& values,
                                const std::vector<double>& buffer) const {
  const double* next = buffer.data();
  for (const std::size_t n : which)
    for (std::size_t q = 0; q < quantities; ++q) {
      std::copy_n(next, patches[n].faces(), values[q] + patches[n].*slot);
      next += patches[n].faces();
    }
}

// The sums of fine fluxes go where the changes of coarse cells are.
void FluxRegister::Work::bring_sums() {
  for (FluxPeer& peer : peers)
    if (!peer.coarse_here.empty())
      messages.post_receive(peer.coarse_buffer.data(), peer.coarse_buffer.size(), peer.rank,
                            sums_tag);
  for (FluxPeer& peer : peers) {
    if (peer.fine_here.empty()) continue;
    pack(peer.fine_here, &FluxPatch::sum_slot, sums, peer.fine_buffer);
    messages.post_send(peer.fine_buffer.data(), peer.fine_buffer.size(), peer.rank, sums_tag);
  }
  for (const FluxPatch& p : patches)
    if (p.fine_box >= 0 && p.coarse_box >= 0)
      for (std::size_t q = 0; q < quantities; ++q)
        std::copy_n(sums[q] + p.sum_slot, p.faces(), changes[q] + p.coarse_slot);
  messages.wait_all();
  for (const FluxPeer& peer : peers)
    unpack(peer.coarse_here, &FluxPatch::coarse_slot, changes, peer.coarse_buffer);
}

void FluxRegister::Work::find_changes() {
  for (const FluxPatch& p : patches) {
    if (p.coarse_box < 0) continue;
    const double sign = p.side % 2 == 0 ? 1.0 : -1.0;  // low faces: what passes comes in
    for (std::size_t q = 0; q < quantities; ++q) {
      const double* recorded = coarse_faces.values(static_cast<int>(q)) + p.coarse_slot;
      double* c = changes[q] + p.coarse_slot;
      for (std::size_t n = 0; n < p.faces(); ++n) c[n] = sign * (c[n] - recorded[n]);
    }
  }
}

// Corrects the listed cells of a local box by the sum over their faces of scale * value. A cell
// that nothing changes is left as it is, to the bit; its share is 1.
void FluxRegister::Work::correct_cells(Warehouse& warehouse, int box, const std::vector<int>& slots,
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

std::int64_t FluxRegister::Work::number_of(IntVec3 cell) const {
  const IntVec3 n = domain.size(), c = cell - domain.lower;
  return c.x + n.x * (c.y + static_cast<std::int64_t>(n.y) * c.z);
}

IntVec3 FluxRegister::Work::cell_of(std::int64_t number) const {
  const IntVec3 n = domain.size();
  const std::int64_t row = number / n.x;
  return domain.lower + IntVec3{static_cast<int>(number % n.x), static_cast<int>(row % n.y),
                                static_cast<int>(row / n.y)};
}

FluxRegister::Work::Limited FluxRegister::Work::correct_coarse(Warehouse& coarse,
                                                               const std::vector<int>& slots,
                                                               const TransferOperators& operators) {
  Limited limited;
  for (std::size_t b = 0; b < coarse_cells.size(); ++b) {
    const CellFaces& faces = coarse_cells[b];
    if (faces.cells.empty()) continue;
    correct_cells(coarse, static_cast<int>(b), slots, operators, faces, changes, whole,
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
void FluxRegister::Work::keep_rest() {
  for (std::size_t b = 0; b < coarse_cells.size(); ++b)
    for (std::size_t c = 0; c < coarse_cells[b].cells.size(); ++c) {
      const double share = coarse_shares[b][c];
      for (const std::ptrdiff_t slot : coarse_cells[b].slots[c]) {
        if (slot < 0) continue;
        for (std::size_t q = 0; q < quantities; ++q) {
          double& rest = changes[q][slot];
          rest = share < 1.0 ? (1.0 - share) * rest : 0.0;
        }
      }
    }
}

void FluxRegister::Work::bring_rest() {
  for (FluxPeer& peer : peers)
    if (!peer.fine_here.empty())
      messages.post_receive(peer.fine_buffer.data(), peer.fine_buffer.size(), peer.rank, rest_tag);
  for (FluxPeer& peer : peers) {
    if (peer.coarse_here.empty()) continue;
    pack(peer.coarse_here, &FluxPatch::coarse_slot, changes, peer.coarse_buffer);
    messages.post_send(peer.coarse_buffer.data(), peer.coarse_buffer.size(), peer.rank, rest_tag);
  }
  for (const FluxPatch& p : patches)
    if (p.fine_box >= 0 && p.coarse_box >= 0)
      for (std::size_t q = 0; q < quantities; ++q)
        std::copy_n(changes[q] + p.coarse_slot, p.faces(), sums[q] + p.sum_slot);
  messages.wait_all();
  for (const FluxPeer& peer : peers)
    unpack(peer.fine_here, &FluxPatch::sum_slot, sums, peer.fine_buffer);
}

// Gives the rest to the fine cells at the same faces, so that the amounts on both levels add up;
// true when one of them cannot take it. Rare, so that its lists are made here.
bool FluxRegister::Work::correct_fine(Warehouse& fine, const std::vector<int>& slots,
                                      const TransferOperators& operators) {
  std::vector<std::vector<CellFace>> faces(fine_boxes);
  for (const FluxPatch& p : patches) {
    if (p.fine_box < 0) continue;
    const IntVec3 wide = p.coarse_cells.size(),
                  each{p.fine_cells.size().x / wide.x, p.fine_cells.size().y / wide.y,
                       p.fine_cells.size().z / wide.z};
    for_each_cell(p.fine_cells, [&](IntVec3 cell) {
      const IntVec3 at = cell - p.fine_cells.lower;
      const std::ptrdiff_t slot =
          p.sum_slot + at.x / each.x + wide.x * (at.y / each.y + wide.y * (at.z / each.z));
      bool some = false;
      for (std::size_t q = 0; q < quantities; ++q) some = some || sums[q][slot] != 0.0;
      if (some) faces[p.fine_box].push_back({cell, p.side ^ 1, slot});
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
    : work_(std::make_unique<Work>(coarse, fine, quantities, rank)) {}
FluxRegister::FluxRegister(FluxRegister&&) noexcept = default;
FluxRegister& FluxRegister::operator=(FluxRegister&&) noexcept = default;
FluxRegister::~FluxRegister() = default;

FaceTable& FluxRegister::coarse_faces() {
  return work_->coarse_faces;
}
FaceTable& FluxRegister::fine_faces() {
  return work_->fine_faces;
}

void FluxRegister::clear() {
  work_->coarse_faces.clear();
  work_->fine_faces.clear();
  work_->sums.clear();
}

void FluxRegister::add_substep() {
  for (const FluxPatch& p : work_->patches)
    if (p.fine_box >= 0)
      for (std::size_t q = 0; q < work_->quantities; ++q)
        p.fold.add(work_->fine_faces.values(static_cast<int>(q)) + p.fine_slot, work_->volume_ratio,
                   work_->sums[q] + p.sum_slot);
}

CorrectionReport FluxRegister::correct(Warehouse& coarse, Warehouse& fine,
                                       const std::vector<int>& slots,
                                       const TransferOperators& operators,
                                       Communicator& communicator) {
  CorrectionReport report;
  if (work_->nothing) return report;
  work_->bring_sums();
  work_->find_changes();
  const Work::Limited limited = work_->correct_coarse(coarse, slots, operators);
  Reduction& agreed = work_->agreement;
  agreed.clear();
  const auto count = agreed.add_count(limited.count);
  const auto lowest = agreed.add_minimum(limited.count > 0 ? 0.0 : 1.0, limited.lowest);
  communicator.reduce(agreed);
  report.limited = agreed.count(count);
  if (report.limited == 0) return report;
  report.first = work_->cell_of(agreed.tag(lowest));
  work_->keep_rest();
  work_->bring_rest();
  const bool failed_here = work_->correct_fine(fine, slots, operators);
  agreed.clear();
  const auto failed = agreed.add_any(failed_here);
  communicator.reduce(agreed);
  report.failed = agreed.any(failed);
  return report;
}

std::size_t FluxRegister::bytes() const {
  const Work& p = *work_;
  std::size_t n = p.coarse_faces.bytes() + p.fine_faces.bytes() + p.sums.bytes() +
                  p.changes.bytes() + p.patches.size() * sizeof(FluxPatch);
  for (const std::vector<double>& v : p.coarse_shares) n += v.capacity() * sizeof(double);
  for (const CellFaces& c : p.coarse_cells)
    n += c.cells.capacity() * (sizeof(IntVec3) + sizeof(c.slots.front()));
  for (const FluxPeer& peer : p.peers)
    n += (peer.fine_buffer.capacity() + peer.coarse_buffer.capacity()) * sizeof(double);
  return n;
}

}  // namespace sluice
