#include "framework/archive/compare/compare_means.hpp"

#include <fmt/format.h>

#include "framework/archive/compare/coarse_means.hpp"
#include "framework/archive/compare/field_pairs.hpp"

namespace sluice {
namespace {

void compare_pair(const ArchiveStep& a, const ArchiveStep& b, const PairedFields& pair,
                  StepLog& log) {
  const CompositeField first(a, pair.of_a), second(b, pair.of_b);
  FieldDifference found;
  found.means = true;
  Difference where = difference_in(first.info());
  const MeansCount count = visit_coarse_means(
      first, second, [&](const MeanPlace& place, const double* x, const double* y) {
        where.level = place.level->index;
        where.index = place.index;
        where.of_second = !place.of_first;
        for (where.component = 0; where.component < where.components; ++where.component)
          log.compare_values(where, x[where.component], y[where.component], found);
      });
  if (count.left_out > 0)
    log.note(
        fmt::format("{} of material {}: places are left out ({} at step {}), where one archive "
                    "has no value or only a part of the coarser cell",
                    where.label, where.material, count.left_out, a.info().step));
  log.keep(found);
}

}  // namespace

void compare_means(const ArchiveStep& a, const ArchiveStep& b, const CompareOptions& options,
                   StepLog& log) {
  const Level &coarse_a = a.grid().levels.front(), &coarse_b = b.grid().levels.front();
  require_common_domain(coarse_a, coarse_b);
  require_common_domain(coarse_b, coarse_a);
  log.note(
      fmt::format("the grids differ (spacing {} with {} levels and {} with {}): means on the "
                  "coarser one are compared",
                  triple_text(coarse_a.spacing), a.grid().levels.size(),
                  triple_text(coarse_b.spacing), b.grid().levels.size()));
  for (const PairedFields& pair : pair_fields(a, b, options.labels, options.names))
    if (pair.of_b.empty())
      log.only_one("only the first has " + pair.of_a.front().name);
    else
      compare_pair(a, b, pair, log);
  for (const PairedFields& pair : pair_fields(b, a, options.labels, options.names))
    if (pair.of_b.empty()) log.only_one("only the second has " + pair.of_a.front().name);
  if (!a.particle_fields().empty() || !b.particle_fields().empty())
    log.note("particles are not compared: each resolution has its own");
}

}  // namespace sluice
