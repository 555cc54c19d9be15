// Moving what statistics keep between layouts and levels, to checkpoints and back.
#include "framework/run/analysis/analysis_history.hpp"

#include <algorithm>

#include "framework/archive/archive.hpp"
#include "framework/grid/box_list.hpp"
#include "framework/refine/level_transfer.hpp"
#include "framework/task/halo.hpp"

namespace sluice {
namespace {

constexpr int ghosts = 1;  // as far as interpolation may look

// Every fine cell has the history of the coarse one.
class SameHistory final : public TransferOperators {
 public:
  void prolong(const StateViews& coarse, const StateViews& fine, const IndexBox& cells,
               const TransferGeometry& geometry, int /*order*/) const override {
    for (std::size_t s = 0; s < fine.size(); ++s)
      for_each_cell(cells, [&](IntVec3 c) { fine[s](c) = coarse[s](coarsen(c, geometry.ratio)); });
  }
  void restrict_to(const StateViews&, const StateViews&, const IndexBox&,
                   const TransferGeometry&) const override {}
  int flux_quantities() const override { return 0; }
  void correct(const StateViews&, const ConservedChange&, std::span<double>) const override {}
};

}  // namespace

Statistics::LevelStore::LevelStore(const Level& level, int rank, const std::vector<Label>& labels,
                                   const std::vector<int>& materials)
    : level_(level), rank_(rank), kept_(level_, rank) {
  for (std::size_t n = 0; n < labels.size(); ++n) {
    slots_.push_back(kept_.add({labels[n], materials[n], 1, ghosts}));
    slot_of_[labels[n]] = slots_.back();
  }
}

bool Statistics::LevelStore::holds(const Level& level) const {
  return std::equal(
      level_.boxes.begin(), level_.boxes.end(), level.boxes.begin(), level.boxes.end(),
      [](const GridBox& a, const GridBox& b) { return a.cells == b.cells && a.owner == b.owner; });
}

void Statistics::LevelStore::commit(const LevelStore* earlier, LevelStore* coarser) {
  std::vector<GridBox> before;
  if (earlier != nullptr) {
    before = earlier->level_.boxes;
    LevelCopy(earlier->level_, level_, rank_).run(earlier->kept_, kept_, slots_);
  }
  if (coarser == nullptr) return;
  HaloExchange(coarser->level_, ghosts, rank_).run(coarser->kept_, coarser->slots_);
  Interpolation::for_new_cells(coarser->level_, ghosts, level_, before, rank_)
      .run(nullptr, &coarser->kept_, 1.0, kept_, slots_, SameHistory(), 0);
}

void Statistics::LevelStore::add_pieces(std::vector<FieldPiece>& pieces) const {
  for (const int slot : slots_)
    for (int b = 0; b < static_cast<int>(kept_.local_boxes().size()); ++b) {
      const GridBox& box = kept_.local_boxes()[b];
      FieldPiece piece;
      piece.label = kept_.info(slot).label;
      piece.material = kept_.info(slot).material;
      piece.level = level_.index;
      piece.box_id = box.id;
      piece.cells = box.cells;
      piece.view = kept_.view(slot, 0, b);
      pieces.push_back(piece);
    }
}

bool Statistics::LevelStore::read(const ArchiveStep& checkpoint) {
  const auto field = [&](int slot) {
    return checkpoint.find(kept_.info(slot).label.name(), kept_.info(slot).material, level_.index);
  };
  if (!std::all_of(slots_.begin(), slots_.end(), [&](int s) { return field(s) != nullptr; }))
    return false;
  for (const int slot : slots_)
    for (int b = 0; b < static_cast<int>(kept_.local_boxes().size()); ++b)
      checkpoint.read_into(*field(slot), 0, kept_.local_boxes()[b].cells, kept_.view(slot, 0, b));
  return true;
}

}  // namespace sluice
