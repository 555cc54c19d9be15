#include "framework/archive/compare/composite_field.hpp"

#include <fmt/format.h>

#include <cmath>

#include "framework/archive/selection.hpp"
#include "framework/base/error.hpp"

namespace sluice {
namespace {

constexpr double tolerance = 1e-6;  // of a fine cell

int floor_divide(int a, int b) {
  return a >= 0 ? a / b : -((b - 1 - a) / b);
}

bool is_flat(const Level& level, int d) {
  return level.domain.size()[d] == 1;
}

[[noreturn]] void refuse(const char* why, const Level& a, const Level& b) {
  throw InputError(
      fmt::format("{}: spacing {} from {} and {} from {}; means on the coarser grid need whole "
                  "numbers of cells "
                  "of one in a cell of the other",
                  why, triple_text(a.spacing), triple_text(a.anchor), triple_text(b.spacing),
                  triple_text(b.anchor)));
}

std::int64_t weight_of(const Level& level, const Level& finest, Centring centring) {
  std::int64_t weight = 1;
  const IntVec3 closing = closing_layers(centring);
  for (int d = 0; d < 3; ++d)
    if (closing[d] == 0) weight *= std::llround(level.spacing[d] / finest.spacing[d]);
  return weight;
}

}  // namespace

bool Nesting::to_coarse(IntVec3 f, Centring centring, IntVec3& coarse) const {
  const IntVec3 closing = closing_layers(centring);
  for (int d = 0; d < 3; ++d) {
    coarse[d] = floor_divide(f[d] + shift[d], ratio[d]);
    if (closing[d] == 1 && coarse[d] * ratio[d] != f[d] + shift[d]) return false;
  }
  return true;
}

IntVec3 Nesting::to_fine(IntVec3 coarse) const {
  IntVec3 fine;
  for (int d = 0; d < 3; ++d) fine[d] = coarse[d] * ratio[d] - shift[d];
  return fine;
}

Nested nest(const Level& coarse, const Level& fine, Nesting& nesting) {
  Nested nested = Nested::yes;
  for (int d = 0; d < 3; ++d) {
    if (is_flat(coarse, d) && is_flat(fine, d)) {
      nesting.ratio[d] = 1;
      nesting.shift[d] = coarse.domain.lower[d] - fine.domain.lower[d];
      continue;
    }
    const double larger = std::max(coarse.spacing[d], fine.spacing[d]);
    const double smaller = std::min(coarse.spacing[d], fine.spacing[d]);
    const double ratio = larger / smaller, whole = std::round(ratio);
    if (std::abs(ratio - whole) > 1e-9 * ratio) refuse("the cells do not nest", coarse, fine);
    if (whole > 1 && fine.spacing[d] > coarse.spacing[d]) nested = Nested::no;
    const double shift = (fine.anchor[d] - coarse.anchor[d]) / smaller;
    if (!(std::abs(shift) < 1e9) || std::abs(shift - std::round(shift)) > tolerance)
      refuse("the faces of cells do not meet", coarse, fine);
    nesting.ratio[d] = static_cast<int>(whole);
    nesting.shift[d] = static_cast<int>(std::round(shift));
  }
  return nested;
}

CompositeField::CompositeField(const ArchiveStep& step, const std::vector<FieldInfo>& fields) {
  const auto level_of = [&](const FieldInfo& f) -> const Level& {
    return step.grid().levels.at(static_cast<std::size_t>(f.level));
  };
  for (const FieldInfo& f : fields) {
    OnLevel& on = levels_.emplace_back();
    on.info = f;
    on.level = &level_of(f);
    on.values = step.read(f, intersection(step.range(f), index_range(*on.level, f.centring)));
    on.weight = weight_of(*on.level, level_of(fields.back()), f.centring);
    for (const FieldInfo& finer : fields)
      if (finer.level > f.level) nest(*on.level, level_of(finer), on.finer.emplace_back());
  }
}

bool CompositeField::covered(std::size_t level, IntVec3 c) const {
  const std::vector<Nesting>& finer = levels_[level].finer;
  for (std::size_t n = 0; n < finer.size(); ++n)
    if (levels_[level + 1 + n].values.has(finer[n].to_fine(c))) return true;
  return false;
}

}  // namespace sluice
