// From a step to the way that its values are chosen.
#include "framework/archive/extract/extract.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "framework/archive/extract/extract_parts.hpp"
#include "framework/base/error.hpp"
#include "framework/field/component_name.hpp"

namespace sluice {
namespace {

bool is_of_particles(const ArchiveStep& step, const std::string& label) {
  return std::any_of(step.particle_fields().begin(), step.particle_fields().end(),
                     [&](const FieldInfo& f) { return f.name == label; });
}

void refuse_particles_elsewhere(const ExtractOptions& o) {
  if (!o.at.empty() || o.line)
    throw InputError(fmt::format(
        "{} is a label of particles, which have values at their own places alone: choose them by "
        "number (--particle) or by a box (--from, --to)",
        o.label));
}

void refuse_numbers_of_fields(const ExtractOptions& o) {
  if (!o.particles.empty() || o.follow)
    throw InputError(fmt::format(
        "{} is a label of the grid: --particle and --follow choose values of particles", o.label));
}

}  // namespace

std::vector<std::string> value_columns(const Quantity& q, ValueType type) {
  const int count = q.count(type);
  std::vector<std::string> names;
  for (int c = 0; c < count; ++c)
    names.push_back(count == 1 ? "value" : fmt::format("value_{}", component_name(count, c)));
  return names;
}

void add_values(const Quantity& q, const double* components, int count, ValueRows& rows) {
  double numbers[9];
  q.evaluate(components, count, numbers);
  for (int c = 0; c < (q.part == Part::all ? count : 1); ++c) rows.add(numbers[c]);
}

double BoxOfPoints::distance_to(Vec3 p) const {
  double sum = 0;
  for (int d = 0; d < 3; ++d) {
    const double below = options_.from ? (*options_.from)[d] - p[d] : 0,
                 above = options_.to ? p[d] - (*options_.to)[d] : 0;
    const double outside = std::max({below, above, 0.0});
    sum += outside * outside;
  }
  return sum;
}

std::string BoxOfPoints::at(const std::string& place, Vec3 p) {
  return fmt::format("{} at ({:.17g}, {:.17g}, {:.17g})", place, p.x, p.y, p.z);
}

void Extraction::add(const ArchiveStep& step) {
  const Quantity q = find_quantity(step, options_.label);
  if (is_of_particles(step, q.label)) {
    refuse_particles_elsewhere(options_);
    missed_ = extract_particles(step, options_, q, followed_, rows_);
    return;
  }
  refuse_numbers_of_fields(options_);
  missed_ = options_.line         ? extract_line(step, options_, q, rows_)
            : options_.at.empty() ? extract_box(step, options_, q, rows_)
                                  : extract_points(step, options_, q, rows_);
}

void Extraction::finish() {
  if (rows_.rows() == 0) throw InputError(missed_);
  rows_.finish();
}

std::int64_t extract_csv(const ArchiveStep& step, const ExtractOptions& options,
                         const WriteText& write) {
  ValueRows rows;
  rows.to(TextForm::csv, write);
  Extraction extraction(options, rows);
  extraction.add(step);
  extraction.finish();
  return rows.rows();
}

}  // namespace sluice
