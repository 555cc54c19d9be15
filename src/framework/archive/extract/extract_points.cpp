// Rows at points and along lines, of each material that the label has.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "framework/archive/extract/extract_parts.hpp"
#include "framework/archive/extract/point_values.hpp"
#include "framework/archive/selection.hpp"
#include "framework/base/error.hpp"

namespace sluice {
namespace {

using Fields = std::vector<FieldInfo>;

// By level each.
std::map<int, Fields> fields_by_material(const ArchiveStep& step, const ExtractOptions& options,
                                         const Quantity& q) {
  std::map<int, Fields> found;
  for (const FieldInfo& f : select_fields(step, q.label, options.material, options.level))
    found[f.material].push_back(f);
  return found;
}

std::vector<std::string> columns_of(std::vector<std::string> columns, const Quantity& q,
                                    ValueType type) {
  for (std::string& name : value_columns(q, type)) columns.push_back(std::move(name));
  return columns;
}

std::string point_text(Vec3 p) {
  return fmt::format("({:g}, {:g}, {:g})", p.x, p.y, p.z);
}

// "[0, 1] x [0, 1] x [0, 0.1]"
std::string domain_text(const ArchiveStep& step) {
  const Level& level = step.grid().levels.front();
  std::string text;
  for (int d = 0; d < 3; ++d)
    text += fmt::format("{}[{:g}, {:g}]", d == 0 ? "" : " x ",
                        level.anchor[d] + level.domain.lower[d] * level.spacing[d],
                        level.anchor[d] + level.domain.upper[d] * level.spacing[d]);
  return text;
}

std::string nothing_at(const std::string& what, const ArchiveStep& step, const Quantity& q,
                       const ExtractOptions& options) {
  const std::string level = options.level < 0 ? "" : fmt::format(" on level {}", options.level);
  return fmt::format("{} has no value of {}{}: the domain is {}", what, q.label, level,
                     domain_text(step));
}

void add_numbers(const PointValues& values, const PointValues::Holder& h, Vec3 p,
                 const ExtractOptions& options, const Quantity& q, ValueRows& rows) {
  std::array<double, 9> components{};
  if (options.linear)
    values.linear(p, h, components.data());
  else
    values.values(h, components.data());
  add_values(q, components.data(), values.field(h).components(), rows);
  rows.end_row();
}

// Where the points are that cut a line between the places of values of the finest level, as shares
// of its length; the middles of the pieces between them.
std::vector<double> middles_of_pieces(const Level& level, Centring centring, Vec3 a, Vec3 b) {
  std::vector<double> cuts = {0, 1};
  for (int d = 0; d < 3; ++d) {
    const double shift = closing_layers(centring)[d] == 1 ? 0.5 : 0.0;
    const auto in_cells = [&](Vec3 p) { return (p[d] - level.anchor[d]) / level.spacing[d]; };
    const double from = in_cells(a) + shift, to = in_cells(b) + shift;
    if (from == to) continue;
    // Faces beyond the domain cut nothing.
    const double low = std::max(std::min(from, to), double(level.domain.lower[d]));
    const double high = std::min(std::max(from, to), double(level.domain.upper[d]) + 2 * shift);
    for (double face = std::ceil(low); face <= high; ++face)
      if (const double share = (face - from) / (to - from); share > 0 && share < 1)
        cuts.push_back(share);
  }
  std::sort(cuts.begin(), cuts.end());
  std::vector<double> middles;
  for (std::size_t n = 1; n < cuts.size(); ++n)
    if (cuts[n] - cuts[n - 1] > 1e-9) middles.push_back(0.5 * (cuts[n] + cuts[n - 1]));
  return middles;
}

std::vector<double> shares_of(const ExtractLine& line, const ArchiveStep& step,
                              const FieldInfo& finest) {
  if (line.points == 0)
    return middles_of_pieces(step.grid().levels.at(finest.level), finest.centring, line.first,
                             line.last);
  std::vector<double> shares;
  for (int n = 0; n < line.points; ++n) shares.push_back(double(n) / (line.points - 1));
  return shares;
}

Vec3 at_share(const ExtractLine& line, double share) {
  return line.first * (1 - share) + line.last * share;
}

// Where no number of points is given, one for each cell: pieces in the same cell are put together.
std::vector<double> one_per_holder(const std::vector<double>& shares, const ExtractLine& line,
                                   const PointValues& values) {
  std::vector<double> kept;
  std::optional<PointValues::Holder> last;
  double first_of_cell = 0;
  for (const double share : shares) {
    const auto holder = values.holder(at_share(line, share));
    if (!holder) {
      last.reset();
      continue;
    }
    if (last && last->field == holder->field && last->index == holder->index) {
      kept.back() = 0.5 * (first_of_cell + share);
    } else {
      kept.push_back(share);
      first_of_cell = share;
    }
    last = holder;
  }
  return kept;
}

}  // namespace

std::string extract_points(const ArchiveStep& step, const ExtractOptions& options,
                           const Quantity& q, ValueRows& rows) {
  std::string missed;
  for (const auto& [material, fields] : fields_by_material(step, options, q)) {
    const PointValues values(step, fields, options.at);
    rows.head(options.label, fields.front().unit,
              columns_of(options.linear
                             ? std::vector<std::string>{"time", "level", "material", "x", "y", "z"}
                             : std::vector<std::string>{"time", "level", "material", "i", "j", "k",
                                                        "x", "y", "z"},
                         q, fields.front().type));
    for (const Vec3& p : options.at) {
      const auto holder = values.holder(p);
      if (!holder) throw InputError(nothing_at("--at " + point_text(p), step, q, options));
      rows.add(step.info().time);
      rows.add(values.field(*holder).level);
      rows.add(material);
      for (int d = 0; d < 3 && !options.linear; ++d) rows.add(holder->index[d]);
      const Vec3 place = options.linear ? p : values.place(*holder);
      for (int d = 0; d < 3; ++d) rows.add(place[d]);
      add_numbers(values, *holder, p, options, q, rows);
    }
  }
  return missed;
}

std::string extract_line(const ArchiveStep& step, const ExtractOptions& options, const Quantity& q,
                         ValueRows& rows) {
  const ExtractLine& line = *options.line;
  const Vec3 along = line.last - line.first;
  const double length = std::sqrt(dot(along, along));
  for (const auto& [material, fields] : fields_by_material(step, options, q)) {
    std::vector<double> shares = shares_of(line, step, fields.back());
    std::vector<Vec3> points;
    for (const double share : shares) points.push_back(at_share(line, share));
    const PointValues values(step, fields, points);
    if (line.points == 0) shares = one_per_holder(shares, line, values);
    rows.head(options.label, fields.front().unit,
              columns_of({"time", "distance", "level", "material", "x", "y", "z"}, q,
                         fields.front().type));
    for (const double share : shares) {
      const Vec3 p = at_share(line, share);
      const auto holder = values.holder(p);
      if (!holder) continue;
      rows.add(step.info().time);
      rows.add(share * length);
      rows.add(values.field(*holder).level);
      rows.add(material);
      for (int d = 0; d < 3; ++d) rows.add(p[d]);
      add_numbers(values, *holder, p, options, q, rows);
    }
  }
  return nothing_at(
      fmt::format("the line from {} to {}", point_text(line.first), point_text(line.last)), step, q,
      options);
}

}  // namespace sluice
