// Allocation and layout of fields.
#include "framework/field/warehouse.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <new>
#include <stdexcept>
#include <utility>

namespace sluice {
namespace {

constexpr std::size_t alignment = 64;
constexpr std::size_t vector = alignment / sizeof(double);

// Numbers that arrays may fill together. A piece of memory for every array of every box would be
// hundreds, with each level that is laid out; sanitizers shall see where those of each box end.
#ifdef __SANITIZE_ADDRESS__
constexpr std::size_t max_together = 0;
#else
constexpr std::size_t max_together = std::size_t{1} << 19;
#endif

// Of an array, with one vector beyond its last number.
std::size_t room_of(std::size_t count) {
  return (count + vector - 1) / vector * vector + vector;
}

// act(part) for the parts of a region that lie outside of `cells`, side by side.
template <class F>
void for_each_outside(const IndexBox& region, const IndexBox& cells, F&& act) {
  IndexBox rest = region;
  for (int d = 0; d < 3; ++d) {
    IndexBox low = rest, high = rest;
    low.upper[d] = rest.lower[d] = std::min(std::max(rest.lower[d], cells.lower[d]), rest.upper[d]);
    high.lower[d] = rest.upper[d] =
        std::max(std::min(rest.upper[d], cells.upper[d]), rest.lower[d]);
    act(low);
    act(high);
  }
}

}  // namespace

AlignedArray::AlignedArray(std::size_t count, Contents contents) : count_(count) {
  // Rows are read in whole vectors: one of them beyond the last number.
  // calloc does not clear what the system hands out clear: levels come and go with their memory.
  std::size_t bytes = count * sizeof(double) + 2 * alignment;
  void* base = contents == Contents::zero ? std::calloc(bytes, 1) : std::malloc(bytes);
  if (base == nullptr) throw std::bad_alloc();
  void* p = base;
  std::align(alignment, count * sizeof(double), p, bytes);
  data_ = std::unique_ptr<double[], Free>(static_cast<double*>(p), Free(base));
#ifdef __SANITIZE_ADDRESS__
  if (contents == Contents::undefined)
    std::fill_n(data_.get(), count, std::numeric_limits<double>::signaling_NaN());
#endif
}

void AlignedArray::Free::operator()(double*) const {
  std::free(base);
}

RealView lay_out(double* data, const IndexBox& box, const Level& level) {
  RealView v;
  v.data = data;
  v.box = box;
  std::ptrdiff_t stride = 1;
  for (int d = 0; d < 3; ++d) {
    v.stride[d] = level.active[d] ? stride : 0;
    if (level.active[d]) stride *= box.size()[d];
  }
  return v;
}

RealView part_of(const RealView& whole, const IndexBox& part) {
  RealView v = whole;
  v.data += whole.offset(part.lower);
  v.box = part;
  return v;
}

Warehouse::Warehouse(const Level& level, int rank, Arrays arrays)
    : level_(&level), arrays_(arrays) {
  for (const GridBox& b : level.boxes)
    if (b.owner == rank) local_.push_back(b);
}

int Warehouse::find(Label label, int material) const {
  for (std::size_t s = 0; s < slots_.size(); ++s)
    if (slots_[s].info.label == label && slots_[s].info.material == material)
      return static_cast<int>(s);
  return -1;
}

const std::vector<BoxFrame>& Warehouse::frames(int ghosts) {
  if (framed_ == ghosts) return frames_;
  framed_ = ghosts;
  frames_.clear();
  if (arrays_ == Arrays::shared) {
    frames_ = box_frames(local_, *level_, ghosts);
  } else {
    for (std::size_t b = 0; b < local_.size(); ++b)
      frames_.push_back({local_[b].cells.grown(level_->ghosts(ghosts)), {static_cast<int>(b)}});
  }
  return frames_;
}

int Warehouse::add(const SlotInfo& info, Contents contents) {
  if (const int old = find(info.label, info.material); old >= 0) {
    const SlotInfo& have = slots_[old].info;
    if (have.ghosts < info.ghosts || have.components != info.components)
      throw std::logic_error("slot " + info.label.name() + " exists with another shape");
    return old;
  }
  Slot slot;
  slot.info = info;
  const IntVec3 ghosts = level_->ghosts(info.ghosts);
  const std::vector<BoxFrame>& frames = this->frames(info.ghosts);
  const std::size_t components = info.components;
  const auto room = [&](std::size_t f) {  // of one component
    return room_of(frames[f].hull.volume());
  };
  slot.views.resize(local_.size() * components);
  for (std::size_t first = 0, last = 0; first < frames.size(); first = last) {
    std::size_t count = components * room(last++);
    while (last < frames.size() && count + components * room(last) <= max_together)
      count += components * room(last++);
    slot.arrays.emplace_back(count, contents);
    double* data = slot.arrays.back().data();
    for (std::size_t f = first; f < last; ++f)
      for (std::size_t c = 0; c < components; ++c, data += room(f)) {
        const RealView whole = lay_out(data, frames[f].hull, *level_);
        slot.numbers += frames[f].hull.volume();
        for (const int b : frames[f].boxes) {
          slot.views[b * components + c] = part_of(whole, local_[b].cells.grown(ghosts));
        }
      }
  }
  slot.uniform.assign(blocks_.size(), unknown);
  slots_.push_back(std::move(slot));
  return static_cast<int>(slots_.size()) - 1;
}

bool Warehouse::any_nonzero(int slot, int c, int b, const IndexBox& region) const {
  const RealView v = view(slot, c, b);
  if (blocks_.size() == 0) return any_other(v, region, 0.0);
  const bool inside = blocks_.any_block(b, region, [&](int block, const IndexBox& cells) {
    const double value = uniform(slot, block);
    return std::isnan(value) ? any_other(v, intersection(region, cells), 0.0) : value != 0.0;
  });
  if (inside) return true;
  bool outside = false;
  for_each_outside(region, local_[b].cells,
                   [&](const IndexBox& side) { outside = outside || any_other(v, side, 0.0); });
  return outside;
}

void Warehouse::cut(IntVec3 extents) {
  blocks_ = BlockLattice(local_, extents);
  marks_.clear();
  for (const GridBox& b : local_) marks_.emplace_back(b.cells, *level_);
  forget();
}

void Warehouse::forget() {
  for (Slot& s : slots_) s.uniform.assign(blocks_.size(), unknown);
  for (RowMarks& m : marks_) m.clear();
}

void Warehouse::forget(int b, const IndexBox& region) {
  if (blocks_.size() == 0) return;
  blocks_.any_block(b, region, [&](int block, const IndexBox& cells) {
    forget_block(b, block, cells);
    return false;
  });
}

void Warehouse::forget_block(int b, int block, const IndexBox& cells) {
  for (Slot& s : slots_) s.uniform[block] = unknown;
  marks_[b].clear(cells);
}

void Warehouse::clear(int slot, int b) {
  const auto zero = [&](const IndexBox& part) {
    for (int c = 0; c < info(slot).components; ++c) fill(view(slot, c, b), part, 0.0);
  };
  const IndexBox all = view(slot, 0, b).box;
  if (blocks_.size() == 0) return zero(all);
  const IndexBox& cells = local_[b].cells;
  for_each_outside(all, cells, zero);
  blocks_.any_block(b, cells, [&](int block, const IndexBox& part) {
    if (uniform(slot, block) != 0.0) zero(part);
    set_uniform(slot, block, 0.0);
    return false;
  });
}

void Warehouse::clear_for(int slot, int b, const std::vector<IndexBox>& parts) {
  Slot& s = slots_[slot];
  s.filled.resize(local_.size());
  std::optional<std::vector<IndexBox>>& filled = s.filled[b];
  if (!filled) {
    clear(slot, b);
    filled.emplace();
  }
  for (const IndexBox& part : *filled)
    for (int c = 0; c < s.info.components; ++c) fill(view(slot, c, b), part, 0.0);
  if (blocks_.size() > 0)
    blocks_.any_block(b, local_[b].cells, [&](int block, const IndexBox&) {
      set_uniform(slot, block, 0.0);
      return false;
    });
  *filled = parts;
}

std::size_t Warehouse::bytes() const {
  std::size_t n = 0;
  for (const Slot& s : slots_) n += s.numbers * sizeof(double);
  return n;
}

void Warehouse::swap(Warehouse& other) noexcept {
  std::swap(level_, other.level_);
  std::swap(arrays_, other.arrays_);
  std::swap(local_, other.local_);
  std::swap(slots_, other.slots_);
  std::swap(frames_, other.frames_);
  std::swap(framed_, other.framed_);
  std::swap(blocks_, other.blocks_);
  std::swap(marks_, other.marks_);
}

}  // namespace sluice
