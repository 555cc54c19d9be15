#include "framework/archive/compare/observed_order.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "framework/archive/compare/coarse_means.hpp"
#include "framework/archive/compare/field_pairs.hpp"
#include "framework/base/error.hpp"
#include "framework/base/exact_sum.hpp"
#include "framework/field/component_name.hpp"

namespace sluice {
namespace {

constexpr double not_there = std::numeric_limits<double>::quiet_NaN();

const Level& coarsest_level(const Archive& archive, Grid& grid) {
  grid = archive.read(Stored::outputs, "last").grid();
  return grid.levels.front();
}

// Cell sizes along a direction; every one that is refined must be so by the same ratios.
std::array<double, 3> refined_cells(const std::array<const Level*, 3>& levels) {
  std::array<double, 3> cells{};
  for (int d = 0; d < 3; ++d) {
    const auto h = [&](int n) { return levels[static_cast<std::size_t>(n)]->spacing[d]; };
    if (levels[0]->domain.size()[d] == 1 || (h(0) == h(1) && h(1) == h(2))) continue;
    if (cells[0] > 0 && (std::abs(h(0) / h(1) * cells[1] / cells[0] - 1) > 1e-6 ||
                         std::abs(h(1) / h(2) * cells[2] / cells[1] - 1) > 1e-6))
      throw InputError("an order needs the same ratios of cell sizes along all directions");
    cells = {h(0), h(1), h(2)};
  }
  if (!(cells[0] > cells[1] * 1.000001 && cells[1] > cells[2] * 1.000001))
    throw InputError(
        fmt::format("an order needs three different resolutions: the coarsest levels have the "
                    "spacings {}, {} and {}",
                    triple_text(levels[0]->spacing), triple_text(levels[1]->spacing),
                    triple_text(levels[2]->spacing)));
  return cells;
}

// Means of another field in the cells of the coarsest.
class MeansInCells {
 public:
  MeansInCells(const CompositeField& coarsest, const CompositeField& other) {
    for (const CompositeField::OnLevel& on : coarsest.levels()) {
      levels_.push_back(on.level);
      means_.emplace_back(coarsest.info().components(),
                          std::vector<double>(on.values.present.size(), not_there));
    }
    count_ = visit_coarse_means(
        coarsest, other, [&](const MeanPlace& place, const double*, const double* mean) {
          if (!place.of_first) return;
          const auto n = static_cast<std::size_t>(
              std::find(levels_.begin(), levels_.end(), place.level) - levels_.begin());
          const std::size_t at = coarsest.levels()[n].values.offset(place.index);
          for (std::size_t m = 0; m < means_[n].size(); ++m) means_[n][m][at] = mean[m];
        });
  }
  double at(std::size_t level, std::size_t component, std::size_t place) const {
    return means_[level][component][place];
  }
  const MeansCount& count() const { return count_; }

 private:
  std::vector<const Level*> levels_;
  std::vector<std::vector<std::vector<double>>> means_;  // by level, component, place
  MeansCount count_;
};

// L1, L2 and Linf of a difference, by volume.
struct Norms {
  ExactSum absolute, square, volume;
  double largest = 0;
  void add(double d, double v) {
    absolute.add(d * v);
    square.add(d * d * v);
    volume.add(v);
    largest = std::max(largest, d);
  }
  std::array<double, 3> values() const {
    return {absolute.value() / volume.value(), std::sqrt(square.value() / volume.value()), largest};
  }
};

struct Ratios {
  double coarse, fine;  // h1/h2, h2/h3
};

NormOrder norm_order(double e12, double e23, Ratios r) {
  NormOrder found{e12, e23, order_of(e12, e23, r.coarse, r.fine), not_there};
  // h3^p / (h2^p - h3^p) = 1 / (r23^p - 1)
  if (found.order > 0) found.error = e23 / (std::pow(r.fine, found.order) - 1);
  return found;
}

OrderRow order_row(const CompositeField& field, const MeansInCells& second,
                   const MeansInCells& third, std::size_t component, Ratios ratios) {
  Norms coarse, fine;
  OrderRow row;
  for (std::size_t n = 0; n < field.levels().size(); ++n) {
    const CompositeField::OnLevel& on = field.levels()[n];
    const double volume = on.level->cell_volume();
    for (std::size_t at = 0; at < on.values.present.size(); ++at) {
      const double u2 = second.at(n, component, at), u3 = third.at(n, component, at);
      if (std::isnan(u2) || std::isnan(u3)) continue;
      coarse.add(std::abs(on.values.components[component][at] - u2), volume);
      fine.add(std::abs(u2 - u3), volume);
      ++row.points;
    }
  }
  if (row.points == 0) return row;
  for (std::size_t k = 0; k < 3; ++k)
    row.norms[k] = norm_order(coarse.values()[k], fine.values()[k], ratios);
  const std::string word = component_name(field.info().components(), static_cast<int>(component));
  row.label = word.empty() ? field.info().name : fmt::format("{}.{}", field.info().name, word);
  row.material = field.info().material;
  return row;
}

void add_step(const std::array<const ArchiveStep*, 3>& steps, const NormsOptions& options,
              Ratios ratios, OrderResult& result) {
  const auto with_second = pair_fields(*steps[0], *steps[1], options.labels, options.names);
  const auto with_third = pair_fields(*steps[0], *steps[2], options.labels, options.names);
  for (std::size_t n = 0; n < with_second.size(); ++n) {
    if (with_second[n].of_b.empty() || with_third[n].of_b.empty()) {
      result.skipped.push_back(with_second[n].of_a.front().name);
      continue;
    }
    const CompositeField first(*steps[0], with_second[n].of_a);
    const MeansInCells second(first, CompositeField(*steps[1], with_second[n].of_b));
    const MeansInCells third(first, CompositeField(*steps[2], with_third[n].of_b));
    if (const std::int64_t left = std::max(second.count().left_out, third.count().left_out))
      result.notes.push_back(fmt::format(
          "{} of material {} at time {:.10g}: {} places are left out, where one archive has no "
          "value or only a part of the coarser cell",
          first.info().name, first.info().material, steps[0]->info().time, left));
    for (int m = 0; m < first.info().components(); ++m) {
      OrderRow row = order_row(first, second, third, static_cast<std::size_t>(m), ratios);
      row.time = steps[0]->info().time;
      if (row.points > 0) result.rows.push_back(std::move(row));
    }
  }
}

}  // namespace

double order_of(double e12, double e23, double r12, double r23) {
  if (!(e12 > 0) || !(e23 > 0) || std::isinf(e12) || std::isinf(e23)) return not_there;
  // (r12^p - 1) / (1 - r23^-p), which grows with p; at 0 it is ln r12 / ln r23.
  const auto ratio = [&](double p) {
    if (std::abs(p) < 1e-9) return std::log(r12) / std::log(r23);
    return std::expm1(p * std::log(r12)) / -std::expm1(-p * std::log(r23));
  };
  double low = -30, high = 30;
  if (e12 / e23 <= ratio(low) || e12 / e23 >= ratio(high)) return not_there;
  for (int n = 0; n < 200 && high - low > 1e-13; ++n) {
    const double middle = 0.5 * (low + high);
    (ratio(middle) < e12 / e23 ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

OrderResult observed_orders(const std::array<const Archive*, 3>& archives,
                            const NormsOptions& options) {
  OrderResult result;
  std::array<Grid, 3> grids;
  std::array<const Level*, 3> levels{};
  for (std::size_t n = 0; n < 3; ++n) levels[n] = &coarsest_level(*archives[n], grids[n]);
  result.sorted = {0, 1, 2};
  std::stable_sort(result.sorted.begin(), result.sorted.end(), [&](std::size_t a, std::size_t b) {
    return levels[a]->cell_volume() > levels[b]->cell_volume();
  });
  const auto [a, b, c] = result.sorted;
  result.cells = refined_cells({levels[a], levels[b], levels[c]});
  for (const std::size_t n : {b, c}) require_common_domain(*levels[a], *levels[n]);
  const Ratios ratios{result.cells[0] / result.cells[1], result.cells[1] / result.cells[2]};
  const auto to_second = paired_outputs(*archives[a], *archives[b], options, result.notes);
  const auto to_third = paired_outputs(*archives[a], *archives[c], options, result.notes);
  for (const auto& [x, y] : to_second)
    for (const auto& [other, z] : to_third) {
      if (other.step != x.step) continue;
      const ArchiveStep first = archives[a]->read_output(x), second = archives[b]->read_output(y),
                        third = archives[c]->read_output(z);
      add_step({&first, &second, &third}, options, ratios, result);
    }
  std::sort(result.skipped.begin(), result.skipped.end());
  result.skipped.erase(std::unique(result.skipped.begin(), result.skipped.end()),
                       result.skipped.end());
  if (result.rows.empty())
    throw InputError("the three archives have none of the requested labels in common");
  return result;
}

}  // namespace sluice
