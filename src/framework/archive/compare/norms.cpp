// Norms over coinciding points, or over means on the coarser grid, with exact sums.
#include "framework/archive/compare/norms.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "framework/archive/compare/coarse_means.hpp"
#include "framework/archive/compare/field_pairs.hpp"
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

}  // namespace

std::vector<StepPair> paired_outputs(const Archive& a, const Archive& b,
                                     const NormsOptions& options, std::vector<std::string>& notes) {
  std::vector<StepEntry> steps = a.outputs();
  if (!options.time.empty()) steps = {a.select_output(options.time)};
  if (options.time_tolerance || a.format() != b.format())
    return pair_nearest_steps(steps, b.outputs(), options.time_tolerance, notes);
  std::vector<StepPair> pairs;
  for (const StepEntry& s : steps) pairs.emplace_back(s, partner(b, s));
  return pairs;
}

namespace {

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

// sum |d| V / sum V and so on
class WeightedNorms {
 public:
  void add(double d, double volume) {
    absolute_.add(d * volume);
    square_.add(d * d * volume);
    volume_.add(volume);
    row_.linf = std::max(row_.linf, d);
    ++row_.points;
  }
  NormsRow row() const {
    NormsRow row = row_;
    row.l1 = absolute_.value() / volume_.value();
    row.l2 = std::sqrt(square_.value() / volume_.value());
    return row;
  }

 private:
  ExactSum absolute_, square_, volume_;
  NormsRow row_;
};

NormsRow named(NormsRow row, const ArchiveStep& a, const ArchiveStep& b, const FieldInfo& f,
               int level, int component) {
  row.time = a.info().time;
  row.other_time = b.info().time;
  row.level = level;
  row.material = f.material;
  const std::string word = component_name(f.components(), component);
  row.label = word.empty() ? f.name : fmt::format("{}.{}", f.name, word);
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
    rows.push_back(named(std::move(row), a, b, fa, fa.level, m));
  }
}

// Norms of means on the coarser grid.
void add_mean_rows(const ArchiveStep& a, const ArchiveStep& b, const std::vector<FieldInfo>& of_a,
                   const std::vector<FieldInfo>& of_b, NormsResult& result) {
  const CompositeField first(a, of_a), second(b, of_b);
  require_common_domain(*first.levels().front().level, *second.levels().front().level);
  std::vector<WeightedNorms> sums(static_cast<std::size_t>(first.info().components()));
  const MeansCount count = visit_coarse_means(
      first, second, [&](const MeanPlace& place, const double* x, const double* y) {
        for (std::size_t m = 0; m < sums.size(); ++m)
          sums[m].add(std::abs(x[m] - y[m]), place.level->cell_volume());
      });
  if (count.left_out > 0)
    result.notes.push_back(fmt::format(
        "{} of material {} at time {:.10g}: {} places are left out, where one archive has no value "
        "or only a part of the coarser cell",
        first.info().name, first.info().material, a.info().time, count.left_out));
  for (std::size_t m = 0; m < sums.size() && count.compared > 0; ++m)
    result.rows.push_back(
        named(sums[m].row(), a, b, first.info(), all_levels, static_cast<int>(m)));
}

}  // namespace

NormsResult difference_norms(const Archive& a, const Archive& b, const NormsOptions& options) {
  NormsResult result;
  for (const auto& [first, second] : paired_outputs(a, b, options, result.notes)) {
    const ArchiveStep sa = a.read_output(first);
    const ArchiveStep sb = b.read_output(second);
    const bool means = grids_differ(sa.grid(), sb.grid());
    for (const PairedFields& pair : pair_fields(sa, sb, options.labels, options.names)) {
      const FieldInfo& fa = pair.of_a.front();
      if (pair.of_b.empty()) {
        if (std::find(result.skipped.begin(), result.skipped.end(), fa.name) ==
            result.skipped.end())
          result.skipped.push_back(fa.name);
      } else if (means) {
        add_mean_rows(sa, sb, pair.of_a, pair.of_b, result);
      } else {
        for (const FieldInfo& f : pair.of_a)
          if (const FieldInfo* other = pair.of_second(f.level))
            add_rows(sa, sb, f, *other, result.rows);
          else
            result.skipped.push_back(fmt::format("{} on level {}", f.name, f.level));
      }
    }
  }
  if (result.rows.empty())
    throw InputError(fmt::format("{} and {} have none of the requested labels in common",
                                 a.folder().string(), b.folder().string()));
  return result;
}

}  // namespace sluice
