// <cohesive_zone> with its file of points.
#include <fmt/format.h>

#include <cmath>

#include "framework/base/data_lines.hpp"
#include "framework/deck/data_file.hpp"
#include "framework/deck/faults.hpp"
#include "framework/deck/rule_tools.hpp"
#include "framework/scene/deck_values.hpp"
#include "mpm/deck/readers.hpp"

namespace sluice::mpm {
namespace {

// Rows: place (3), area, normal (3), tangent (3), materials below and above.
std::vector<CohesivePoint> read_points(const std::string& file, const MpmScene& s) {
  std::vector<CohesivePoint> points;
  const auto count = static_cast<int>(s.materials.size());
  const std::vector<std::string> columns = {
      "x",        "y",         "z",         "area",      "normal x",       "normal y",
      "normal z", "tangent x", "tangent y", "tangent z", "material below", "material above"};
  read_table(file, columns, [&](const TableRow& v) {
    CohesivePoint p{{v[0], v[1], v[2]}, {v[4], v[5], v[6]}, {v[7], v[8], v[9]}, v[3], 0, 0};
    if (!(p.area > 0)) v.refuse(3, fmt::format("area {:g} of a cohesive point", p.area));
    const Vec3 second = cross(p.normal, p.tangent);
    if (!(dot(second, second) > 0))
      v.refuse(4, "normal and tangent of a cohesive point are parallel");
    for (const std::size_t n : {std::size_t{10}, std::size_t{11}}) {
      const double m = v[n];
      if (!(m >= 0 && m < count && m == std::floor(m)))
        v.refuse(n, fmt::format("there is no material {:g}; valid: 0 to {}", m, count - 1));
      if (s.materials[static_cast<std::size_t>(m)].rigid)
        v.refuse(n, fmt::format("material {:g} is rigid: forces do not move it", m));
    }
    p.below = static_cast<int>(v[10]);
    p.above = static_cast<int>(v[11]);
    if (p.below == p.above) v.refuse(11, "a cohesive point connects two materials, not one");
    points.push_back(p);
  });
  return points;
}

}  // namespace

void read_cohesive_zones(const DeckNode& block, MpmScene& s, std::vector<Fault>& faults) {
  for (const DeckNode* node : block.all("cohesive_zone")) {
    CohesiveZone z;
    z.where = node->where;
    z.sig_max = node->real("sig_max");
    z.tau_max = node->real("tau_max");
    z.delta_n = node->real("delta_n");
    z.delta_t = node->real("delta_t");
    z.delta_n_fail = real_or(*node, "delta_n_fail", 4 * z.delta_n);
    z.delta_t_fail = real_or(*node, "delta_t_fail", 4 * z.delta_t);
    const std::string file = data_file(node->need("cz_filename"), faults);
    if (!file.empty())
      collect(faults, node->need("cz_filename").where, [&] { z.points = read_points(file, s); });
    s.cohesive_zones.push_back(std::move(z));
  }
}

}  // namespace sluice::mpm
