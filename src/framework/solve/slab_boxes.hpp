// Numbers of the boxes of a level on their way into the slabs of a window, and back.
#pragma once
#include <functional>

#include "framework/solve/cell_matrix.hpp"

namespace sluice::solve {

class SlabBoxes {
 public:
  // The part of the level that a rank has of the window.
  using SlabOf = std::function<IndexBox(int rank)>;
  SlabBoxes(const Level& level, SlabOf slab_of) : level_(level), slab_of_(std::move(slab_of)) {}

  // Collective, both. put(part): takes what a part of the own slab holds, box by box.
  using Put = std::function<void(const ConstRealView& part)>;
  void load(const ConstBoxViews& own, const Put& put) const;
  // take(part): fills it, a part of the own slab.
  using Take = std::function<void(const RealView& part)>;
  void store(const Take& take, const BoxViews& own) const;

 private:
  // region(part of a box, number of the box among the owner's), box by box.
  template <class F>
  void for_parts(int owner, int slab_rank, F&& region) const;
  std::size_t cells_between(int owner, int slab_rank) const;
  // A buffer for each rank, of the cells of its boxes in the own slab, or of the own boxes in its.
  using Buffers = std::vector<std::vector<double>>;
  Buffers owner_buffers() const;
  Buffers slab_buffers() const;

  const Level& level_;
  SlabOf slab_of_;
};

}  // namespace sluice::solve
