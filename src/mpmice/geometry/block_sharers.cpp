#include "mpmice/geometry/block_sharers.hpp"

#include <algorithm>
#include <map>

#include "framework/base/communicator.hpp"

namespace sluice::mpmice {
namespace {

constexpr int size_tag = 61, data_tag = 62;

}  // namespace

// The blocks near a box and its images.
template <int D>
std::vector<CellBox<D>> BlockSharers<D>::surroundings_of(const CellBox<D>& box) const {
  CellBox<D> grown = box;
  for (int& lower : grown.lower) lower -= surroundings;
  for (int& upper : grown.upper) upper += surroundings;
  std::vector<CellBox<D>> all{grown};
  for (std::size_t d = 0; d < D; ++d) {
    if (!sides_.periodic[d]) continue;
    const int n = sides_.domain.upper[d] - sides_.domain.lower[d];
    for (std::size_t i = 0, count = all.size(); i < count; ++i)
      for (const int by : {-n, n}) {
        CellBox<D> image = all[i];
        image.lower[d] += by;
        image.upper[d] += by;
        all.push_back(image);
      }
  }
  for (CellBox<D>& of : all) of = BlockDirectory<D>::blocks_of(common<D>(of, room_));
  std::erase_if(all, [](const CellBox<D>& of) { return of.empty(); });
  return all;
}

template <int D>
BlockSharers<D>::BlockSharers(std::vector<RankBox<D>> boxes, const PeriodicSides<D>& sides,
                              const CellBox<D>& room, const Communicator& ranks)
    : boxes_(std::move(boxes)), sides_(sides), room_(room), own_(ranks.rank()) {
  directory_.begin(room);
  CellBox<D> hull;
  std::vector<std::vector<int>> sharers;  // ranks, by block of this rank
  for (const RankBox<D>& box : boxes_) {
    if (box.rank != own_) continue;
    for (const CellBox<D>& near : surroundings_of(box.cells)) {
      hull.include(near);
      for_each_cell_of<D>(near, [&](const Cell<D>& block) {
        std::int32_t& entry = directory_.entry(block);
        if (entry != 0) return;
        sharers.emplace_back();
        entry = static_cast<std::int32_t>(sharers.size());
      });
    }
  }
  for (const RankBox<D>& box : boxes_) {
    if (box.rank == own_) continue;
    for (const CellBox<D>& near : surroundings_of(box.cells))
      for_each_cell_of<D>(common<D>(near, hull), [&](const Cell<D>& block) {
        const std::int32_t entry = directory_.find(block);
        if (entry == 0) return;
        std::vector<int>& of = sharers[static_cast<std::size_t>(entry - 1)];
        if (std::find(of.begin(), of.end(), box.rank) == of.end()) of.push_back(box.rank);
      });
  }
  for (std::vector<int>& of : sharers) {
    std::sort(of.begin(), of.end());
    neighbours_.insert(neighbours_.end(), of.begin(), of.end());
  }
  std::sort(neighbours_.begin(), neighbours_.end());
  neighbours_.erase(std::unique(neighbours_.begin(), neighbours_.end()), neighbours_.end());
  std::map<std::vector<int>, std::int32_t> numbers;
  std::vector<std::int32_t> set_of(sharers.size());
  for (std::size_t b = 0; b < sharers.size(); ++b) {
    for (int& rank : sharers[b])
      rank = static_cast<int>(std::lower_bound(neighbours_.begin(), neighbours_.end(), rank) -
                              neighbours_.begin());
    const auto [at, is_new] = numbers.emplace(sharers[b], static_cast<std::int32_t>(sets_.size()));
    if (is_new) sets_.push_back(sharers[b]);
    set_of[b] = 1 + at->second;
  }
  directory_.for_each_entry(
      [&](std::int32_t& entry) { entry = set_of[static_cast<std::size_t>(entry - 1)]; });
}

template <int D>
std::vector<CellBox<D>> BlockSharers<D>::cells() const {
  BlockDirectory<D> listed;
  listed.begin(room_);
  std::vector<CellBox<D>> all;
  for (const RankBox<D>& box : boxes_) {
    if (box.rank != own_) continue;
    for (const CellBox<D>& near : surroundings_of(box.cells))
      for_each_cell_of<D>(near, [&](const Cell<D>& block) {
        std::int32_t& entry = listed.entry(block);
        if (entry++ == 0) all.push_back(BlockDirectory<D>::cells_of(block));
      });
  }
  return all;
}

template <int D>
void BlockSharers<D>::swap(const Buffers& out, Buffers& in) const {
  const std::size_t count = neighbours_.size();
  in.resize(count);
  std::vector<double> sizes_in(count), sizes_out(count);
  Messages messages;
  for (std::size_t n = 0; n < count; ++n)
    messages.post_receive(&sizes_in[n], 1, neighbours_[n], size_tag);
  for (std::size_t n = 0; n < count; ++n) {
    sizes_out[n] = static_cast<double>(out[n].size());
    messages.post_send(&sizes_out[n], 1, neighbours_[n], size_tag);
  }
  messages.wait_all();
  for (std::size_t n = 0; n < count; ++n) in[n].resize(static_cast<std::size_t>(sizes_in[n]));
  swap_alike(out, in);
}

template <int D>
void BlockSharers<D>::swap_alike(const Buffers& out, Buffers& in) const {
  Messages messages;
  for (std::size_t n = 0; n < in.size(); ++n)
    if (!in[n].empty()) messages.post_receive(in[n].data(), in[n].size(), neighbours_[n], data_tag);
  for (std::size_t n = 0; n < out.size(); ++n)
    if (!out[n].empty()) messages.post_send(out[n].data(), out[n].size(), neighbours_[n], data_tag);
  messages.wait_all();
}

template class BlockSharers<1>;
template class BlockSharers<2>;
template class BlockSharers<3>;

}  // namespace sluice::mpmice
