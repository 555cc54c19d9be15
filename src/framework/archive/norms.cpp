// Norms over coinciding points, with exact sums.
#include "framework/archive/norms.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "framework/base/error.hpp"
#include "framework/base/exact_sum.hpp"

namespace sluice {
namespace {

const StepEntry& partner(const Archive& b, const StepEntry& a, double tolerance) {
  for (const StepEntry& s : b.outputs())
    if (std::abs(s.time - a.time) <= tolerance * std::max(std::abs(s.time), std::abs(a.time)))
      return s;
  throw InputError(fmt::format("{} has no output at time {:.17g} (step {} of the first archive)",
                               b.folder().string(), a.time, a.step));
}

// By how many indices the second level's numbering is shifted; their points must coincide.
IntVec3 index_shift(const Level& a, const Level& b) {
  IntVec3 shift;
  for (int d = 0; d < 3; ++d) {
    if (std::abs(a.spacing[d] - b.spacing[d]) > 1e-10 * a.spacing[d])
      throw InputError(fmt::format("level {}: the points do not coincide: spacing {} and {}",
                                   a.index, triple_text(a.spacing), triple_text(b.spacing)));
    const double cells = (a.anchor[d] - b.anchor[d]) / a.spacing[d];
    if (!(std::abs(cells) < 1e9) || std::abs(cells - std::round(cells)) > 1e-6)
      throw InputError(fmt::format("level {}: the points do not coincide: anchor {} and {}",
                                   a.index, triple_text(a.anchor), triple_text(b.anchor)));
    shift[d] = static_cast<int>(std::round(cells));
  }
  return shift;
}

NormsRow norms_of(const DenseField& x, const DenseField& y, IntVec3 shift, int m) {
  NormsRow row;
  ExactSum absolute, square;
  for_each_cell(x.cells, [&](IntVec3 c) {
    if (!x.has(c)) return;
    const double d = std::abs(x.at(c, m) - y.at(c + shift, m));
    absolute.add(d);
    square.add(d * d);
    row.linf = std::isnan(d) || std::isnan(row.linf) ? d + row.linf : std::max(row.linf, d);
    ++row.points;
  });
  const auto n = static_cast<double>(row.points);
  row.l1 = absolute.value() / n;
  row.l2 = std::sqrt(square.value() / n);
  return row;
}

void add_rows(const ArchiveStep& a, const ArchiveStep& b, const FieldInfo& fa, const FieldInfo& fb,
              std::vector<NormsRow>& rows) {
  constexpr const char* axes[] = {".x", ".y", ".z"};
  const std::size_t l = fa.level;
  if (l >= b.grid().levels.size())
    throw InputError(fmt::format("the second archive has no level {}", fa.level));
  const IntVec3 shift = index_shift(a.grid().levels.at(l), b.grid().levels[l]);
  const DenseField x = a.read(fa);
  const DenseField y = b.read(fb, x.cells.shifted(shift));
  for_each_cell(x.cells, [&](IntVec3 c) {
    if (x.has(c) && !y.has(c + shift))
      throw InputError(
          fmt::format("the points do not coincide: {} of the second archive has no value on level "
                      "{} at [{}, {}, "
                      "{}]",
                      fa.name, fa.level, c.x + shift.x, c.y + shift.y, c.z + shift.z));
  });
  for (int m = 0; m < fa.components(); ++m) {
    NormsRow row = norms_of(x, y, shift, m);
    row.time = a.info().time;
    row.level = fa.level;
    row.material = fa.material;
    row.label = fa.name + (fa.components() > 1 ? axes[m] : "");
    rows.push_back(std::move(row));
  }
}

}  // namespace

NormsResult difference_norms(const Archive& a, const Archive& b, const NormsOptions& options) {
  std::vector<StepEntry> steps = a.outputs();
  if (!options.time.empty()) steps = {a.select_output(options.time)};
  NormsResult result;
  for (const StepEntry& entry : steps) {
    const ArchiveStep sa = a.read_output(entry);
    const ArchiveStep sb = b.read_output(partner(b, entry, options.time_tolerance));
    for (const FieldInfo& fa : sa.fields()) {
      if (!options.labels.selects(fa.name)) continue;
      const FieldInfo* fb = sb.find(fa.name, fa.material, fa.level);
      if (fb && fb->type == fa.type && fb->centring == fa.centring)
        add_rows(sa, sb, fa, *fb, result.rows);
      else if (std::find(result.skipped.begin(), result.skipped.end(), fa.name) ==
               result.skipped.end())
        result.skipped.push_back(fa.name);
    }
  }
  if (result.rows.empty())
    throw InputError(fmt::format("{} and {} have none of the requested labels in common",
                                 a.folder().string(), b.folder().string()));
  return result;
}

}  // namespace sluice
