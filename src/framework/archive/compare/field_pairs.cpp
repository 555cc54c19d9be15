#include "framework/archive/compare/field_pairs.hpp"

#include <algorithm>
#include <cmath>

#include "framework/archive/compare/composite_field.hpp"

namespace sluice {
namespace {

std::vector<FieldInfo> fields_named(const ArchiveStep& step, const std::string& name,
                                    const FieldInfo& like) {
  std::vector<FieldInfo> found;
  for (const FieldInfo& f : step.fields())
    if (f.name == name && f.material == like.material && f.type == like.type &&
        f.centring == like.centring)
      found.push_back(f);
  return found;
}

bool same_spacing(const Level& a, const Level& b) {
  for (int d = 0; d < 3; ++d)
    if (std::abs(a.spacing[d] - b.spacing[d]) > 1e-10 * a.spacing[d]) return false;
  return true;
}

// Whether the boxes of b, in the numbering of a, hold all cells of a.
bool holds_cells(const Level& a, const Level& b) {
  IntVec3 shift;
  for (int d = 0; d < 3; ++d)
    shift[d] = static_cast<int>(std::round((b.anchor[d] - a.anchor[d]) / a.spacing[d]));
  std::int64_t common = 0;
  for (const GridBox& p : a.boxes)
    for (const GridBox& q : b.boxes)
      common += intersection(p.cells, q.cells.shifted(shift)).volume();
  return common == a.cell_count();
}

}  // namespace

const FieldInfo* PairedFields::of_second(int level) const {
  for (const FieldInfo& f : of_b)
    if (f.level == level) return &f;
  return nullptr;
}

std::vector<PairedFields> pair_fields(const ArchiveStep& a, const ArchiveStep& b,
                                      const LabelFilter& labels,
                                      const std::vector<LabelName>& names) {
  const bool across = a.storage().format != b.storage().format;
  std::vector<PairedFields> pairs;
  for (const FieldInfo& f : a.fields()) {
    if (!labels.selects(f.name)) continue;
    const bool again = !pairs.empty() && pairs.back().of_a.front().name == f.name &&
                       pairs.back().of_a.front().material == f.material;
    if (again) {
      pairs.back().of_a.push_back(f);
      continue;
    }
    PairedFields& pair = pairs.emplace_back();
    pair.of_a.push_back(f);
    for (const std::string& name :
         across ? names_elsewhere(f.name, names) : std::vector<std::string>{f.name})
      if (pair.of_b.empty()) pair.of_b = fields_named(b, name, f);
  }
  return pairs;
}

bool grids_differ(const Grid& a, const Grid& b) {
  for (std::size_t l = 0; l < a.levels.size(); ++l) {
    if (l >= b.levels.size() || !same_spacing(a.levels[l], b.levels[l])) return true;
    if (l > 0 && !holds_cells(a.levels[l], b.levels[l])) return true;
  }
  return false;
}

}  // namespace sluice
