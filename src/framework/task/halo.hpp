// A halo point: fills the ghost cells of old state from the boxes that own them.
//
// Copies inside this rank are direct; for every neighbour rank there is one packed message holding
// all slots of all regions, posted early and waited for late. Ghost cells outside the domain (and
// not periodic) are left to the component's boundary conditions.
#pragma once
#include <vector>

#include "framework/base/communicator.hpp"
#include "framework/field/warehouse.hpp"
#include "framework/task/thread_team.hpp"

namespace sluice {

// One region of ghost cells: cells of box `to` that equal cells of box `from`, shifted.
struct HaloCopy {
  int from = 0, to = 0;  // box ids
  IndexBox region;       // in the indices of `to`
  IntVec3 shift{};       // region + shift lies in `from`
};

// All copies that fill `width` ghost layers of the boxes of a level, ordered by (to, from, shift):
// the same list on every rank. Regions of width zero in inactive directions.
std::vector<HaloCopy> halo_copies(const Level& level, int width);

class HaloExchange {
 public:
  // `arrays`: of the warehouses. Where boxes share them, slots have `width` ghost layers, and what
  // lies in one place is copied once.
  HaloExchange(const Level& level, int width, int rank, Arrays arrays = Arrays::own);

  // Fills the ghosts of these slots. Deterministic: pure copies, those inside this rank by the team
  // where there are enough of them.
  void run(Warehouse& warehouse, const std::vector<int>& slots, const ThreadTeam* team = nullptr);
  std::size_t message_bytes(int components) const;  // sent by this rank in one exchange
  int neighbour_ranks() const { return static_cast<int>(peers_.size()); }

 private:
  struct Local {
    int from, to;  // local box numbers
    IndexBox region;
    IntVec3 shift;
  };
  struct Peer {
    int rank = 0;
    std::vector<Local> sends;     // `from` is a local box number; region in indices of the sender
    std::vector<Local> receives;  // `to` is a local box number
    std::vector<double> send_buffer, receive_buffer;
  };
  void copy_local(Warehouse& warehouse, const std::vector<int>& slots,
                  const ThreadTeam* team) const;

  std::vector<Local> local_;
  std::int64_t local_cells_ = 0;
  std::vector<Peer> peers_;
  Messages messages_;
};

}  // namespace sluice
