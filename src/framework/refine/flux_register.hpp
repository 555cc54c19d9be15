// Fluxes through the faces where a level meets a finer one, and making both levels agree on them.
//
// Each interface face of the coarse level is kept by the coarse cell outside the fine level. A
// sweep over the coarse level records its own flux there, every substep of the fine level its fluxes
// through the fine faces; afterwards the coarse cell gets the difference
//   change = sign (sum over substeps and fine faces of F_fine V_fine / V_coarse - F_coarse),
// sign +1 when the cell is on the high side of the face. Fluxes are amounts per volume of the cell
// of the level that computed them, positive along the axis, as the schemes use them. Sums are taken
// in pairs, so that mirrored scenes give mirrored bits, and do not depend on boxes or ranks.
// What a cell cannot bear (it would become inadmissible) goes back to the fine cells on the other
// side of the same faces: nothing is created.
#pragma once
#include <memory>
#include <span>
#include <vector>

#include "framework/base/communicator.hpp"
#include "framework/field/warehouse.hpp"
#include "framework/refine/transfer_operators.hpp"
#include "framework/task/row.hpp"

namespace sluice {

// Faces of a level where fluxes are recorded, found by row without a search.
class FaceTable {
 public:
  // `count` faces in a row: the low (high = false) or high faces, along an axis, of the cells
  // `first`, first + 1, ... of the row (index along the row's direction); values go to
  // slot, slot + 1, ...
  struct Segment {
    int first = 0, count = 0;
    bool high = false;
    std::ptrdiff_t slot = 0;
  };

  FaceTable() = default;
  // Boxes are the local ones of a warehouse; `quantities` numbers a face.
  FaceTable(const std::vector<GridBox>& boxes, const Axes& axes, int quantities);

  bool empty() const { return faces_ == 0; }
  // Faces along `axis` of the row of cells that starts at `cell` in local box `box`.
  std::span<const Segment> segments(int box, int axis, IntVec3 cell) const;
  // Faces that belong to cells of this block, in any axis: such a block must not sleep.
  bool touches(int box, const IndexBox& block) const;
  double* values(int quantity) { return values_[static_cast<std::size_t>(quantity)].data(); }
  const double* values(int quantity) const {
    return values_[static_cast<std::size_t>(quantity)].data();
  }
  std::size_t bytes() const;

  // Appends the faces of `cells` (one layer thick along the axis; low or high faces) of a local
  // box; the first slot. Rows of the region follow each other, x fastest. seal() ends building.
  std::ptrdiff_t add(int box, int axis, bool high, const IndexBox& cells);
  void seal();

 private:
  struct Rows {                       // of one box and axis
    std::vector<std::int32_t> begin;  // by row: first segment; one more at the end
    std::vector<Segment> segments;
  };
  std::vector<IndexBox> boxes_;
  std::vector<Rows> rows_;  // by box * axes + axis
  std::vector<std::vector<double>> values_;
  std::ptrdiff_t faces_ = 0;
  Axes axes_;
};

// What a sweep over one level records into; either may be null. The component's recording task
// keeps a pointer to this, the run changes what it points to when boxes are laid out anew.
struct FluxRecorder {
  FaceTable* as_coarse = nullptr;  // towards the next finer level
  FaceTable* as_fine = nullptr;    // towards the next coarser level
};

struct CorrectionReport {
  std::int64_t limited = 0;  // coarse cells that took less than the whole correction
  bool failed = false;       // fine cells could not take the rest back: the step must be redone
  IntVec3 first{};           // the lowest limited coarse cell
};

class FluxRegister {
 public:
  FluxRegister(const Level& coarse, const Level& fine, int quantities, int rank);
  FluxRegister(FluxRegister&&) noexcept;
  FluxRegister& operator=(FluxRegister&&) noexcept;
  ~FluxRegister();

  FaceTable& coarse_faces();
  FaceTable& fine_faces();

  void clear();        // before a step of the coarse level
  void add_substep();  // after an accepted substep of the fine level
  // After the last substep: corrects the new states of both levels. Collective; `limited` and
  // `failed` are agreed upon by all ranks.
  CorrectionReport correct(Warehouse& coarse, Warehouse& fine, const std::vector<int>& slots,
                           const TransferOperators& operators, Communicator& communicator);
  std::size_t bytes() const;

 private:
  struct Plan;
  std::unique_ptr<Plan> plan_;
};

}  // namespace sluice
