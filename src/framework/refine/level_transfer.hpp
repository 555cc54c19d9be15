// Data that moves between levels, and between two layouts of one level.
//
// Which regions move is found once, when boxes are laid out; moving them is pure copying (plus the
// component's operators), inside a rank directly, between ranks in one packed message a peer.
// Every value depends on cells alone, never on boxes or ranks. `slots`: the slots of the conserved
// state, the same numbers in all warehouses. Constructors keep no reference to the levels.
#pragma once
#include <memory>
#include <vector>

#include "framework/base/communicator.hpp"
#include "framework/field/warehouse.hpp"
#include "framework/refine/transfer_operators.hpp"
#include "framework/task/thread_team.hpp"

namespace sluice {

// Fine cells that are to be interpolated from the coarser level.
//  - ghost cells (`width` layers) of the fine boxes that no box of their level holds, not even as a
//    periodic image, inside the domain: fill at a coarse-fine interface;
//  - or cells of fine boxes that were not there before a regrid.
// Needs all ghost cells of the coarser level's boxes filled `coarse_ghosts` layers deep: copies of
// other boxes' cells, outside the domain, and its own coarse-fine ghosts. A cell must have the same
// value in all arrays that hold it. `arrays`: of the fine warehouses, whose
// slots have `width` ghost layers where boxes share them.
class Interpolation {
 public:
  static Interpolation for_ghosts(const Level& coarse, int coarse_ghosts, const Level& fine,
                                  int width, int rank, Arrays arrays = Arrays::own);
  static Interpolation for_new_cells(const Level& coarse, int coarse_ghosts, const Level& fine,
                                     const std::vector<GridBox>& earlier, int rank);
  Interpolation(Interpolation&&) noexcept;
  Interpolation& operator=(Interpolation&&) noexcept;
  ~Interpolation();

  // Coarse values at `share` of the way from `before` to `after` (linear; share 0 reads only
  // `before`, share 1 only `after`, and the unread one may be null).
  void run(const Warehouse* before, const Warehouse* after, double share, Warehouse& fine,
           const std::vector<int>& slots, const TransferOperators& operators, int order,
           const ThreadTeam* team = nullptr);

  std::int64_t cells() const;  // fine cells that this rank interpolates
  std::size_t message_bytes(int components) const;

 private:
  struct Plan;
  explicit Interpolation(std::unique_ptr<Plan> plan);
  std::unique_ptr<Plan> plan_;
};

// Coarse cells under fine boxes, from these.
class Restriction {
 public:
  Restriction(const Level& coarse, const Level& fine, int rank);
  Restriction(Restriction&&) noexcept;
  Restriction& operator=(Restriction&&) noexcept;
  ~Restriction();
  void run(const Warehouse& fine, Warehouse& coarse, const std::vector<int>& slots,
           const TransferOperators& operators, const ThreadTeam* team = nullptr);

 private:
  struct Plan;
  std::unique_ptr<Plan> plan_;
};

// Interior cells that two layouts of a level share, copied from one to the other (after a regrid,
// or when boxes move between ranks).
class LevelCopy {
 public:
  LevelCopy(const Level& from, const Level& to, int rank);
  LevelCopy(LevelCopy&&) noexcept;
  LevelCopy& operator=(LevelCopy&&) noexcept;
  ~LevelCopy();
  void run(const Warehouse& from, Warehouse& to, const std::vector<int>& slots);

 private:
  struct Plan;
  std::unique_ptr<Plan> plan_;
};

}  // namespace sluice
