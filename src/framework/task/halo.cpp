// Finding and carrying out halo copies.
#include "framework/task/halo.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include "framework/field/region_rows.hpp"
#include "framework/grid/box_list.hpp"
#include "framework/grid/grid_boxes.hpp"

namespace sluice {
namespace {

// Shifts by whole periods under which a box may be its own or another's neighbour: several where
// the ghost layers are wider than the domain.
std::vector<IntVec3> periodic_shifts(const Level& level, IntVec3 ghosts) {
  std::vector<IntVec3> shifts;
  const IntVec3 n = level.domain.size();
  auto reach = [&](int d) {
    const bool wraps = level.periodic[d] && level.active[d];
    return wraps ? (ghosts[d] + n[d] - 1) / n[d] : 0;
  };
  for (int k = -reach(2); k <= reach(2); ++k)
    for (int j = -reach(1); j <= reach(1); ++j)
      for (int i = -reach(0); i <= reach(0); ++i) shifts.push_back({i * n.x, j * n.y, k * n.z});
  return shifts;
}

// The cells of a region of a view, to a message and back.
double* pack(const RealView& v, const IndexBox& region, double* next) {
  for_each_row(v, region, v, {}, [&](double* row, const double*, int n) {
    copy_row(next, row, n);
    next += n;
  });
  return next;
}
const double* unpack(const RealView& v, const IndexBox& region, const double* next) {
  for_each_row(v, region, v, {}, [&](double* row, const double*, int n) {
    copy_row(row, next, n);
    next += n;
  });
  return next;
}

}  // namespace

std::vector<HaloCopy> halo_copies(const Level& level, int width) {
  std::vector<HaloCopy> copies;
  const IntVec3 ghosts = level.ghosts(width);
  const std::vector<IntVec3> shifts = periodic_shifts(level, ghosts);
  const BoxFinder finder(cells_of(level.boxes));
  std::vector<int> found;
  for (const GridBox& to : level.boxes) {
    const IndexBox grown = to.cells.grown(ghosts);
    const auto first = copies.end() - copies.begin();
    for (const IntVec3 shift : shifts) {
      finder.find(grown.shifted(shift), found);
      for (const int n : found) {
        const GridBox& from = level.boxes[n];
        if (from.id == to.id && shift == IntVec3{}) continue;
        copies.push_back(
            {from.id, to.id, intersection(grown, from.cells.shifted(IntVec3{} - shift)), shift});
      }
    }
    // Of one box, shifts keep their order.
    if (shifts.size() > 1)
      std::stable_sort(copies.begin() + first, copies.end(),
                       [](const HaloCopy& a, const HaloCopy& b) { return a.from < b.from; });
  }
  return copies;
}

HaloExchange::HaloExchange(const Level& level, int width, int rank, Arrays arrays) {
  std::vector<int> local_number(level.boxes.size(), -1);
  int count = 0;
  for (const GridBox& b : level.boxes)
    if (b.owner == rank) local_number[b.id] = count++;
  std::map<int, Peer> peers;
  const std::vector<std::vector<IndexBox>> held = held_by_frames(level, width, arrays);
  const auto add_local = [&](const Local& copy) {
    local_.push_back(copy);
    local_cells_ += copy.region.volume();
  };
  for (const HaloCopy& c : halo_copies(level, width)) {
    const int from_owner = level.boxes[c.from].owner;
    const int to_owner = level.boxes[c.to].owner;
    const Local copy{local_number[c.from], local_number[c.to], c.region, c.shift};
    if (from_owner == rank && to_owner == rank) {
      const std::vector<IndexBox>& holes = held[c.to];
      if (holes.empty()) {
        add_local(copy);
        continue;
      }
      for (const IndexBox& region : subtract({c.region}, holes))
        add_local({copy.from, copy.to, region, copy.shift});
    } else if (from_owner == rank) {
      peers[to_owner].sends.push_back(copy);
    } else if (to_owner == rank) {
      peers[from_owner].receives.push_back(copy);
    }
  }
  for (auto& [other, peer] : peers) {
    peer.rank = other;
    peers_.push_back(std::move(peer));
  }
}

std::size_t HaloExchange::message_bytes(int components) const {
  std::int64_t cells = 0;
  for (const Peer& p : peers_)
    for (const Local& s : p.sends) cells += s.region.volume();
  return static_cast<std::size_t>(cells) * components * sizeof(double);
}

// Ghost cells are written and other boxes' cells read: copies may run in any order.
void HaloExchange::copy_local(Warehouse& warehouse, const std::vector<int>& slots,
                              const ThreadTeam* team) const {
  constexpr std::int64_t worth_a_thread = 8192;  // cells
  const auto copy = [&](std::size_t n, int) {
    const Local& r = local_[n];
    for (int s : slots)
      for (int c = 0; c < warehouse.info(s).components; ++c)
        copy_region(warehouse.view(s, c, r.to), r.region, warehouse.view(s, c, r.from), r.shift);
  };
  if (team != nullptr && team->size() > 1 && local_cells_ >= worth_a_thread * team->size())
    team->for_each(local_.size(), copy);
  else
    for (std::size_t n = 0; n < local_.size(); ++n) copy(n, 0);
}

void HaloExchange::run(Warehouse& warehouse, const std::vector<int>& slots,
                       const ThreadTeam* team) {
  int components = 0;
  for (int s : slots) components += warehouse.info(s).components;
  auto doubles = [&](const std::vector<Local>& regions) -> std::size_t {
    std::int64_t cells = 0;
    for (const Local& r : regions) cells += r.region.volume();
    return cells * components;
  };
  for (Peer& p : peers_) {
    p.receive_buffer.resize(doubles(p.receives));
    messages_.post_receive(p.receive_buffer.data(), p.receive_buffer.size(), p.rank, 1);
  }
  for (Peer& p : peers_) {
    p.send_buffer.resize(doubles(p.sends));
    double* next = p.send_buffer.data();
    for (const Local& r : p.sends)
      for (int s : slots)
        for (int c = 0; c < warehouse.info(s).components; ++c)
          next = pack(warehouse.view(s, c, r.from), r.region.shifted(r.shift), next);
    messages_.post_send(p.send_buffer.data(), p.send_buffer.size(), p.rank, 1);
  }
  copy_local(warehouse, slots, team);
  messages_.wait_all();
  for (Peer& p : peers_) {
    const double* next = p.receive_buffer.data();
    for (const Local& r : p.receives)
      for (int s : slots)
        for (int c = 0; c < warehouse.info(s).components; ++c)
          next = unpack(warehouse.view(s, c, r.to), r.region, next);
  }
}

}  // namespace sluice
