#include "framework/solve/slab_boxes.hpp"

#include "framework/base/communicator.hpp"

namespace sluice::solve {
namespace {

constexpr int load_tag = 63, store_tag = 64;

template <class T>
ArrayView<T> part_of(const ArrayView<T>& v, const IndexBox& part) {
  ArrayView<T> inner = v;
  inner.data = v.data + v.offset(part.lower);
  inner.box = part;
  return inner;
}

// Posts what goes from and to each other rank, and waits.
void swap_buffers(std::vector<std::vector<double>>& in, std::vector<std::vector<double>>& out,
                  int tag) {
  Messages messages;
  for (std::size_t r = 0; r < in.size(); ++r)
    if (!in[r].empty()) messages.post_receive(in[r].data(), in[r].size(), static_cast<int>(r), tag);
  for (std::size_t r = 0; r < out.size(); ++r)
    if (!out[r].empty()) messages.post_send(out[r].data(), out[r].size(), static_cast<int>(r), tag);
  messages.wait_all();
}

}  // namespace

template <class F>
void SlabBoxes::for_parts(int owner, int slab_rank, F&& region) const {
  const IndexBox slab = slab_of_(slab_rank);
  std::size_t n = 0;
  for (const GridBox& box : level_.boxes) {
    if (box.owner != owner) continue;
    const IndexBox part = intersection(box.cells, slab);
    if (!part.empty()) region(part, n);
    ++n;
  }
}

std::size_t SlabBoxes::cells_between(int owner, int slab_rank) const {
  std::size_t count = 0;
  for_parts(owner, slab_rank, [&](const IndexBox& part, std::size_t) { count += part.volume(); });
  return count;
}

SlabBoxes::Buffers SlabBoxes::owner_buffers() const {
  Buffers buffers(world().size());
  for (int r = 0; r < world().size(); ++r)
    if (r != world().rank()) buffers[r].resize(cells_between(r, world().rank()));
  return buffers;
}

SlabBoxes::Buffers SlabBoxes::slab_buffers() const {
  Buffers buffers(world().size());
  for (int r = 0; r < world().size(); ++r)
    if (r != world().rank()) buffers[r].resize(cells_between(world().rank(), r));
  return buffers;
}

void SlabBoxes::load(const ConstBoxViews& own, const Put& put) const {
  Buffers in = owner_buffers(), out = slab_buffers();
  const int rank = world().rank();
  for (int r = 0; r < world().size(); ++r) {
    double* next = out[r].data();
    if (r == rank) continue;
    for_parts(rank, r, [&](const IndexBox& part, std::size_t n) {
      for_each_cell(part, [&](IntVec3 c) { *next++ = own[n](c); });
    });
  }
  swap_buffers(in, out, load_tag);
  for (int r = 0; r < world().size(); ++r) {
    const double* next = in[r].data();
    for_parts(r, rank, [&](const IndexBox& part, std::size_t n) {
      if (r == rank) return put(part_of(own[n], part));
      put(view_of(next, part));
      next += part.volume();
    });
  }
}

void SlabBoxes::store(const Take& take, const BoxViews& own) const {
  Buffers in = slab_buffers(), out = owner_buffers();
  const int rank = world().rank();
  for (int r = 0; r < world().size(); ++r) {
    double* next = out[r].data();
    for_parts(r, rank, [&](const IndexBox& part, std::size_t n) {
      if (r == rank) return take(part_of(own[n], part));
      take(view_of(next, part));
      next += part.volume();
    });
  }
  swap_buffers(in, out, store_tag);
  for (int r = 0; r < world().size(); ++r) {
    const double* next = in[r].data();
    if (r == rank) continue;
    for_parts(rank, r, [&](const IndexBox& part, std::size_t n) {
      for_each_cell(part, [&](IntVec3 c) { own[n](c) = *next++; });
    });
  }
}

}  // namespace sluice::solve
