// Fluxes through the faces where a level meets a finer one, and making both levels agree on them.
//
// Each interface face of the coarse level is kept by the coarse cell outside the fine level. A
// sweep over the coarse level records its own flux there, every substep of the fine level its own
// through the fine faces; afterwards the coarse cell gets the difference
//   change = sign (sum over substeps and fine faces of F_fine V_fine / V_coarse - F_coarse),
// sign +1 when the cell is on the high side of the face. Fluxes are amounts per volume of the cell
// of the level that computed them, positive along the axis, as the schemes use them. Sums are taken
// in pairs, so that mirrored scenes give mirrored bits, and do not depend on boxes or ranks.
// What a cell cannot bear (it would become inadmissible) goes back to the fine cells on the other
// side of the same faces, share by share: nothing is created. A cell that nothing changes keeps its
// bits.
#pragma once
#include <memory>
#include <vector>

#include "framework/base/communicator.hpp"
#include "framework/field/warehouse.hpp"
#include "framework/refine/face_table.hpp"
#include "framework/refine/transfer_operators.hpp"

namespace sluice {

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
  struct Work;
  std::unique_ptr<Work> work_;
};

}  // namespace sluice
