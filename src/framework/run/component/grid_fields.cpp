#include "framework/run/component/grid_fields.hpp"

#include <algorithm>

namespace sluice {

IndexBox piece_cells(const IndexBox& cells, Label label, const Level& level) {
  IndexBox piece = cells;
  const IntVec3 closing = closing_layers(label.info().centring);
  for (int d = 0; d < 3; ++d)
    if (level.active[d] && cells.upper[d] == level.domain.upper[d]) piece.upper[d] += closing[d];
  return piece;
}

std::size_t GridFields::boxes() const {
  return std::count_if(level_->boxes.begin(), level_->boxes.end(),
                       [this](const GridBox& b) { return b.owner == rank_; });
}

void GridFields::add(Label label, int material) {
  if (has(label, material)) return;
  first_[{label, material}] = arrays_.size();
  for (int c = 0; c < component_count(label.info().type); ++c)
    for (const GridBox& b : level_->boxes)
      if (b.owner == rank_) {
        const IndexBox cells = piece_cells(b.cells, label, *level_);
        arrays_.push_back({label, material, c, b.id, cells, std::vector<double>(cells.volume())});
      }
}

void GridFields::set(Label label, int material, int component, IntVec3 at, double value) {
  const std::size_t count = boxes();
  const std::size_t begin = first_.at({label, material}) + component * count;
  for (std::size_t n = begin; n < begin + count; ++n) {
    Array& a = arrays_[n];
    if (!a.cells.contains(at)) continue;
    const IntVec3 i = at - a.cells.lower, size = a.cells.size();
    a.values[i.x + size.x * (i.y + static_cast<std::size_t>(size.y) * i.z)] = value;
    return;
  }
}

std::vector<FieldPiece> GridFields::pieces() const {
  std::vector<FieldPiece> all;
  for (const Array& a : arrays_) {
    FieldPiece piece;
    piece.label = a.label;
    piece.material = a.material;
    piece.level = level_->index;
    piece.box_id = a.box_id;
    piece.component = a.component;
    piece.cells = a.cells;
    piece.view.data = a.values.data();
    piece.view.box = a.cells;
    piece.view.stride[1] = a.cells.size().x;
    piece.view.stride[2] = static_cast<std::ptrdiff_t>(a.cells.size().x) * a.cells.size().y;
    all.push_back(piece);
  }
  return all;
}

}  // namespace sluice
