// What carries things out through open faces (LODI) whose deck gives no velocity far away.
//
// Across a face: the mean velocity over it. Along the face: the mean over all open faces across
// that direction, zero where there is none (what runs along a face while a vortex passes it is no
// mean of the flow). Sums are of the coarsest level, which has the whole face, and exact.
#include <algorithm>
#include <cstdint>

#include "ice/boundary/boundary_fill.hpp"

namespace sluice::ice {
namespace {

// Cells and velocity across, by direction; then the same by open face.
constexpr int sums_of_directions = 6;

// Of an open face: its cells, which are equally large, and the velocity across it.
struct FaceSum {
  std::int64_t cells = 0;
  ExactSum velocity;

  void add_to(std::span<ExactSum> sums, int first) const {
    sums[first].add(static_cast<double>(cells));
    sums[first + 1].merge(velocity);
  }
};

}  // namespace

// Numbered side by side, region by region: alike on all levels. Only what changes along a face
// needs to know what carries it.
void BoundaryFill::number_open_face(Side side) {
  const std::size_t n = index_of(side);
  GhostRule& rule = rules_[n].back();
  if (!rule.waves || setting_.conditions.lodi->velocity_infinity) return;
  if (level_->active_count() < 2) return;
  rule.open_face = open_faces();
  open_faces_.push_back(direction_of(side));
  if (mixtures_[n].empty()) return;
  MixtureRule& mixture = mixtures_[n].back();
  mixture.common.open_face = rule.open_face;
  for (MixtureRule::Part& part : mixture.parts) part.rule.open_face = rule.open_face;
}

int BoundaryFill::sum_count() const {
  return open_faces_.empty() ? 0 : sums_of_directions + 2 * open_faces();
}

void BoundaryFill::add_sums(const Warehouse& state, std::span<ExactSum> sums) const {
  std::vector<FaceSum> faces(open_faces_.size());
  for (const Side side : all_sides) {
    const std::size_t n = index_of(side);
    const auto needs = [](const GhostRule& r) { return r.open_face >= 0; };
    if (std::none_of(rules_[n].begin(), rules_[n].end(), needs)) continue;
    const int d = direction_of(side);
    const auto found = std::find(slots_.directions.begin(), slots_.directions.end(), d);
    const std::size_t component = found - slots_.directions.begin();
    const int layer = is_plus(side) ? level_->domain.upper[d] - 1 : level_->domain.lower[d];
    for (int box = 0; box < static_cast<int>(state.local_boxes().size()); ++box) {
      IndexBox cells = state.local_boxes()[box].cells;
      cells.lower[d] = std::max(cells.lower[d], layer);
      cells.upper[d] = std::min(cells.upper[d], layer + 1);
      if (cells.empty()) continue;
      const BoundaryViews v = views(state, box);
      for_each_cell(cells, [&](IntVec3 cell) {
        const int face = rule(side, cell).open_face;
        if (face < 0) return;
        FaceSum& sum = faces[face];
        ++sum.cells;
        sum.velocity.add(v.momentum[component](cell) / v.density(cell));
      });
    }
  }
  for (int face = 0; face < open_faces(); ++face) {
    faces[face].add_to(sums, 2 * open_faces_[face]);
    faces[face].add_to(sums, sums_of_directions + 2 * face);
  }
}

std::vector<std::optional<Vec3>> BoundaryFill::carriers(std::span<const double> sums) const {
  std::vector<std::optional<Vec3>> carriers;
  if (sums.empty()) return carriers;
  const auto mean = [&](int first) {
    return sums[first] > 0 ? std::optional(sums[first + 1] / sums[first]) : std::nullopt;
  };
  Vec3 across;
  for (int d = 0; d < 3; ++d) across[d] = mean(2 * d).value_or(0.0);
  for (int face = 0; face < open_faces(); ++face) {
    carriers.emplace_back();
    const auto own = mean(sums_of_directions + 2 * face);
    if (!own) continue;
    carriers.back() = across;
    (*carriers.back())[open_faces_[face]] = *own;
  }
  return carriers;
}

}  // namespace sluice::ice
