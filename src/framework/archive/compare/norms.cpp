// Norms over coinciding points, with exact sums.
#include "framework/archive/compare/norms.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "framework/archive/compare/step_pairs.hpp"
#include "framework/base/error.hpp"
#include "framework/base/exact_sum.hpp"
#include "framework/field/component_name.hpp"

namespace sluice {
namespace {

constexpr double same_time = 1e-9;  // relative

const StepEntry& partner(const Archive& b, const StepEntry& a) {
  for (const StepEntry& s : b.outputs())
    if (std::abs(s.time - a.time) <= same_time * std::max(std::abs(s.time), std::abs(a.time)))
      return s;
  throw InputError(
      fmt::format("{} has no output at time {:.17g} (step {} of the first archive); "
                  "--time-tolerance pairs outputs of nearest times",
                  b.folder().string(), a.time, a.step));
}

std::vector<StepPair> pairs_of(const Archive& a, const Archive& b, const NormsOptions& options,
                               std::vector<std::string>& notes) {
  std::vector<StepEntry> steps = a.outputs();
  if (!options.time.empty()) steps = {a.select_output(options.time)};
  if (options.time_tolerance || a.format() != b.format())
    return pair_nearest_steps(steps, b.outputs(), options.time_tolerance, notes);
  std::vector<StepPair> pairs;
  for (const StepEntry& s : steps) pairs.emplace_back(s, partner(b, s));
  return pairs;
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
    if (!x.has(c) || !y.has(c + shift)) return;
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
  const bool across = a.storage().format != b.storage().format;
  const std::size_t l = fa.level;
  if (l >= b.grid().levels.size())
    throw InputError(fmt::format("the second archive has no level {}", fa.level));
  const IntVec3 shift = index_shift(a.grid().levels.at(l), b.grid().levels[l]);
  const DenseField x = a.read(fa);
  const DenseField y = b.read(fb, x.cells.shifted(shift));
  for_each_cell(x.cells, [&](IntVec3 c) {
    if (x.has(c) && !y.has(c + shift) && !across)
      throw InputError(
          fmt::format("the points do not coincide: {} of the second archive has no value on level "
                      "{} at [{}, {}, "
                      "{}]",
                      fa.name, fa.level, c.x + shift.x, c.y + shift.y, c.z + shift.z));
  });
  for (int m = 0; m < fa.components(); ++m) {
    NormsRow row = norms_of(x, y, shift, m);
    if (row.points == 0) return;
    row.time = a.info().time;
    row.other_time = b.info().time;
    row.level = fa.level;
    row.material = fa.material;
    const std::string component = component_name(fa.components(), m);
    row.label = component.empty() ? fa.name : fmt::format("{}.{}", fa.name, component);
    rows.push_back(std::move(row));
  }
}

}  // namespace

namespace {

const FieldInfo* counterpart(const ArchiveStep& a, const ArchiveStep& b, const FieldInfo& f,
                             const std::vector<LabelName>& names) {
  if (a.storage().format == b.storage().format) return b.find(f.name, f.material, f.level);
  for (const std::string& name : names_elsewhere(f.name, names))
    if (const FieldInfo* other = b.find(name, f.material, f.level)) return other;
  return nullptr;
}

}  // namespace

NormsResult difference_norms(const Archive& a, const Archive& b, const NormsOptions& options) {
  NormsResult result;
  for (const auto& [first, second] : pairs_of(a, b, options, result.notes)) {
    const ArchiveStep sa = a.read_output(first);
    const ArchiveStep sb = b.read_output(second);
    for (const FieldInfo& fa : sa.fields()) {
      if (!options.labels.selects(fa.name)) continue;
      const FieldInfo* fb = counterpart(sa, sb, fa, options.names);
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
