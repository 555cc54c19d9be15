#include "app/accuracy/quantity.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>

#include "app/loading/archive_error.hpp"
#include "framework/base/error.hpp"

namespace sluice {
namespace {

ArchiveStep last_output(const Archive& archive) {
  if (archive.outputs().empty())
    throw InputError(fmt::format("{}: the run wrote no output", archive.folder().string()));
  return archive.read_output(archive.select_output("last"));
}

bool is_real(const FieldInfo& field) {
  return field.stored == StoredType::float64 || field.stored == StoredType::float32;
}

void add_once(std::vector<Quantity>& list, Quantity::Kind kind, const FieldInfo& field) {
  const bool known = std::any_of(list.begin(), list.end(), [&](const Quantity& q) {
    return q.kind == kind && q.name == field.name && q.material == field.material;
  });
  if (!known) list.push_back({kind, field.name, field.material, field.unit});
}

// The bins that an interval [low, high] of direction d meets, with how much of it lies in each.
template <class Share>
void for_each_bin(const Bins& bins, int d, double low, double high, Share&& share) {
  const double width = (bins.upper[d] - bins.lower[d]) / bins.count[d];
  const auto index = [&](double x) {
    const double n = std::floor((x - bins.lower[d]) / width);
    return std::clamp(static_cast<int>(n), 0, bins.count[d] - 1);
  };
  // A side on the side of a bin may lie a rounding beyond it.
  const double slack = 1e-9 * (high - low);
  const int first = index(low + slack), last = index(high - slack);
  for (int n = first; n <= last; ++n) {
    const double from = std::max(low, bins.lower[d] + n * width);
    const double to = std::min(high, bins.lower[d] + (n + 1) * width);
    share(n, n == first && n == last ? 1.0 : std::max(0.0, to - from) / (high - low));
  }
}

// Sums over weights become means.
void divide(BinnedField& field) {
  for (auto& sum : field.means)
    for (std::size_t n = 0; n < sum.size(); ++n)
      if (field.weights[n] > 0) sum[n] /= field.weights[n];
}

class CellBins {
 public:
  explicit CellBins(const Bins& bins, int components) : bins_(bins) {
    field_.means.resize(static_cast<std::size_t>(components), std::vector<double>(bins.size()));
    field_.weights.resize(bins.size());
  }

  void add(const Level& level, IntVec3 c, const DenseField& values) {
    const Vec3 middle = level.centre(c), half = level.spacing * 0.5;
    const double volume = level.cell_volume();
    const auto along = [&](int d, auto&& share) {
      for_each_bin(bins_, d, middle[d] - half[d], middle[d] + half[d], share);
    };
    along(2, [&](int k, double in_z) {
      along(1, [&](int j, double in_y) {
        along(0, [&](int i, double in_x) {
          const std::size_t n = bin(i, j, k);
          const double part = in_x * in_y * in_z * volume;
          field_.weights[n] += part;
          for (std::size_t q = 0; q < field_.means.size(); ++q)
            field_.means[q][n] += part * values.at(c, static_cast<int>(q));
        });
      });
    });
  }
  BinnedField means() && {
    divide(field_);
    return std::move(field_);
  }

 private:
  std::size_t bin(int i, int j, int k) const {
    return static_cast<std::size_t>(i) +
           static_cast<std::size_t>(bins_.count.x) *
               (static_cast<std::size_t>(j) +
                static_cast<std::size_t>(bins_.count.y) * static_cast<std::size_t>(k));
  }

  const Bins& bins_;
  BinnedField field_;
};

BinnedField binned_cells(const ArchiveStep& step, const Quantity& q, const Bins& bins) {
  const Grid& grid = step.grid();
  const FieldInfo* coarsest = step.find(q.name, q.material, 0);
  CellBins sums(bins, coarsest == nullptr ? 1 : coarsest->components());
  for (std::size_t level = 0; level < grid.levels.size(); ++level) {
    const FieldInfo* field = step.find(q.name, q.material, static_cast<int>(level));
    if (field == nullptr) continue;
    const DenseField values = step.read(*field);
    for (const GridBox& box : grid.levels[level].boxes)
      for_each_cell(box.cells, [&](IntVec3 c) {
        if (values.has(c) && !covered(grid, level, c)) sums.add(grid.levels[level], c, values);
      });
  }
  return std::move(sums).means();
}

// Where the particles of an output were at the start, if it tells: moved bodies then have the same
// particles in the same bins.
std::vector<std::vector<double>> reference_places(const ArchiveStep& step, const FieldInfo& places,
                                                  int material, int level) {
  auto x = step.read_particles(places);
  const FieldInfo* moved = step.find_particles("p.displacement", material, level);
  if (moved == nullptr) return x;
  const auto u = step.read_particles(*moved);
  for (std::size_t d = 0; d < x.size(); ++d)
    for (std::size_t p = 0; p < x[d].size(); ++p) x[d][p] -= u[d][p];
  return x;
}

BinnedField binned_particles(const ArchiveStep& step, const Quantity& q, const Bins& bins) {
  BinnedField field;
  field.weights.resize(bins.size());
  const Vec3 size = bins.upper - bins.lower;
  for (int level = 0; level < static_cast<int>(step.grid().levels.size()); ++level) {
    const FieldInfo* values = step.find_particles(q.name, q.material, level);
    const FieldInfo* places = step.find_particles("p.x", q.material, level);
    if (values == nullptr || places == nullptr) continue;
    const FieldInfo* mass = step.find_particles("p.mass", q.material, level);
    const auto f = step.read_particles(*values);
    const auto x = reference_places(step, *places, q.material, level);
    const auto m =
        mass == nullptr ? std::vector<std::vector<double>>{} : step.read_particles(*mass);
    field.means.resize(f.size(), std::vector<double>(bins.size()));
    for (std::size_t p = 0; p < x[0].size(); ++p) {
      std::size_t n = 0;
      for (int d = 2; d >= 0; --d) {
        const auto count = static_cast<double>(bins.count[d]);
        const double at = (x[static_cast<std::size_t>(d)][p] - bins.lower[d]) / size[d] * count;
        n = n * static_cast<std::size_t>(bins.count[d]) +
            static_cast<std::size_t>(std::clamp(std::floor(at), 0.0, count - 1));
      }
      const double weight = m.empty() ? 1 : m[0][p];
      field.weights[n] += weight;
      for (std::size_t c = 0; c < f.size(); ++c) field.means[c][n] += weight * f[c][p];
    }
  }
  divide(field);
  return field;
}

double at_time(const History& h, std::size_t component, double t) {
  const auto& x = h.times;
  const auto above = std::lower_bound(x.begin(), x.end(), t);
  if (above == x.begin()) return h.values[component].front();
  if (above == x.end()) return h.values[component].back();
  const auto n = static_cast<std::size_t>(above - x.begin());
  const double share = (t - x[n - 1]) / (x[n] - x[n - 1]);
  return h.values[component][n - 1] + share * (h.values[component][n] - h.values[component][n - 1]);
}

}  // namespace

std::string Quantity::text() const {
  return kind == Kind::history ? name : fmt::format("{} of material {}", name, material);
}

std::vector<Quantity> quantities_of(const Archive& archive) {
  const ArchiveStep step = last_output(archive);
  std::vector<Quantity> list;
  for (const FieldInfo& field : step.fields())
    if (field.centring == Centring::cell && is_real(field))
      add_once(list, Quantity::Kind::cells, field);
  for (const FieldInfo& field : step.particle_fields())
    if (is_real(field) && field.name != "p.x") add_once(list, Quantity::Kind::particles, field);
  for (const HistoryEntry& entry : archive.index().histories)
    list.push_back({Quantity::Kind::history, entry.file, 0, ""});
  return list;
}

Bins bins_of(const ArchiveStep& step) {
  const Level& level = step.grid().levels.front();
  const IndexBox& cells = level.domain;
  const Vec3 half = level.spacing * 0.5;
  return {level.centre(cells.lower) - half, level.centre(cells.upper - IntVec3::all(1)) + half,
          cells.size()};
}

BinnedField binned(const ArchiveStep& step, const Quantity& quantity, const Bins& bins) {
  return quantity.kind == Quantity::Kind::particles ? binned_particles(step, quantity, bins)
                                                    : binned_cells(step, quantity, bins);
}

History read_history(const Archive& archive, const Quantity& quantity) {
  const auto path = archive.folder() / quantity.name;
  std::ifstream file(path);
  if (!file) throw InputError(fmt::format("{}: the history cannot be read", path.string()));
  History history;
  int number = 0;
  for (std::string line; std::getline(file, line);) {
    ++number;
    std::istringstream words(line);
    std::vector<double> row;
    for (double value = 0; words >> value;) row.push_back(value);
    // time, then one value or three; a number of the step may stand before.
    const std::size_t components = row.size() >= 4 ? 3 : 1;
    if (row.size() < 1 + components)
      throw InputError(
          fmt::format("{}:{}: expected time and value, found '{}'", path.string(), number, line));
    history.times.push_back(row[row.size() - components - 1]);
    history.values.resize(components);
    for (std::size_t c = 0; c < components; ++c)
      history.values[c].push_back(row[row.size() - components + c]);
  }
  return history;
}

MeanDifference mean_difference(const BinnedField& a, const BinnedField& b) {
  MeanDifference mean;
  if (a.means.size() != b.means.size()) return mean;
  double count = 0;
  for (std::size_t n = 0; n < a.weights.size(); ++n) {
    if (!(a.weights[n] > 0 && b.weights[n] > 0)) continue;
    ++count;
    for (std::size_t c = 0; c < a.means.size(); ++c) {
      mean.difference += std::fabs(a.means[c][n] - b.means[c][n]);
      mean.size += std::fabs(b.means[c][n]);
    }
  }
  if (count > 0) {
    mean.difference /= count;
    mean.size /= count;
  }
  return mean;
}

MeanDifference mean_difference(const History& a, const History& b) {
  MeanDifference mean;
  if (a.times.size() < 2 || b.times.size() < 2) return mean;
  const double from = std::max(a.times.front(), b.times.front());
  const double to = std::min(a.times.back(), b.times.back());
  double length = 0;
  for (std::size_t n = 1; n < a.times.size(); ++n) {
    const double left = std::max(a.times[n - 1], from), right = std::min(a.times[n], to);
    if (!(right > left)) continue;
    length += right - left;
    const double middle = 0.5 * (left + right);
    for (std::size_t c = 0; c < std::min(a.values.size(), b.values.size()); ++c) {
      const double of_b = at_time(b, c, middle);
      mean.difference += (right - left) * std::fabs(at_time(a, c, middle) - of_b);
      mean.size += (right - left) * std::fabs(of_b);
    }
  }
  if (length > 0) {
    mean.difference /= length;
    mean.size /= length;
  }
  return mean;
}

MeanDifference mean_difference(const Archive& coarse, const Archive& fine,
                               const Quantity& quantity) {
  if (quantity.kind == Quantity::Kind::history)
    return mean_difference(read_history(coarse, quantity), read_history(fine, quantity));
  const ArchiveStep a = last_output(coarse), b = last_output(fine);
  const double ta = a.info().time, tb = b.info().time;
  if (!(std::fabs(ta - tb) <= 1e-9 * std::fabs(tb)))
    throw InputError(fmt::format(
        "{}: its last output is at time {:g}, that of a coarser run at {:g}: give the deck a "
        "maxTime instead of a number of steps, and an outputInterval instead of a number of steps",
        fine.folder().string(), tb, ta));
  const Bins bins = bins_of(a);
  return mean_difference(binned(a, quantity, bins), binned(b, quantity, bins));
}

}  // namespace sluice
