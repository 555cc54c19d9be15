#include "ice/start/formula_fill.hpp"

#include <array>
#include <optional>

#include "framework/scene/formula.hpp"

namespace sluice::ice {
namespace {

// Evaluates one formula in every cell, `offset` from its centre, into `values`.
void evaluate(const std::optional<std::string>& text, const Level& level, const IndexBox& cells,
              Vec3 offset, std::vector<double>& values) {
  if (!text) return;
  const Formula formula(*text);
  std::size_t n = 0;
  for_each_cell(cells, [&](IntVec3 c) { values[n++] = formula(level.centre(c) + offset); });
}

// Two of density, pressure and temperature give the third; of one alone the others are those of the
// geometry objects, as far as the law can have them.
void evaluate_all(const FormulaFill& f, const IceMaterial& m, const Level& level, Vec3 offset,
                  PrimitiveFill& fill) {
  const std::vector<double> before = fill.pressure;
  evaluate(f.density, level, fill.cells, offset, fill.density);
  evaluate(f.temperature, level, fill.cells, offset, fill.temperature);
  for (std::size_t d = 0; d < 3; ++d)
    evaluate(f.velocity[d], level, fill.cells, offset, fill.velocity[d]);
  if (f.density || f.temperature)
    for (std::size_t n = 0; n < fill.density.size(); ++n)
      fill.pressure[n] = m.fluid.pressure(
          fill.density[n], m.fluid.energy_from_temperature(fill.density[n], fill.temperature[n]));
  evaluate(f.pressure, level, fill.cells, offset, fill.pressure);
  if (f.pressure && f.temperature && !f.density) {
    for (std::size_t n = 0; n < fill.density.size(); ++n)
      fill.density[n] = m.fluid.density(fill.pressure[n], fill.temperature[n]);
    return;
  }
  if (!f.pressure || m.fluid.depends_on_energy()) return;
  for (std::size_t n = 0; n < fill.density.size(); ++n)
    if (fill.pressure[n] != before[n])
      fill.density[n] = m.fluid.density(fill.pressure[n], fill.temperature[n]);
}

// A place relative to the centre, and its weight; weights sum to one.
struct Point {
  Vec3 offset;
  double weight;
};

std::vector<Point> gauss_points(const Level& level) {
  constexpr std::array<double, 4> place = {-0.86113631159405258, -0.33998104358485626,
                                           0.33998104358485626, 0.86113631159405258};
  constexpr std::array<double, 4> weight = {0.17392742256872693, 0.32607257743127307,
                                            0.32607257743127307, 0.17392742256872693};
  std::vector<Point> points = {{{}, 1}};
  for (int d = 0; d < 3; ++d) {
    if (!level.active[d]) continue;
    std::vector<Point> more;
    for (const Point& p : points)
      for (std::size_t k = 0; k < place.size(); ++k) {
        more.push_back({p.offset, p.weight * weight[k]});
        more.back().offset[d] = 0.5 * place[k] * level.spacing[d];
      }
    points = std::move(more);
  }
  return points;
}

// Sums of what is conserved, of one cell.
struct Amounts {
  double mass = 0, energy = 0;
  Vec3 momentum;
};

// What was given for density and pressure, or for density and temperature, so that they determine
// the energy even of laws whose pressure knows the density alone.
double energy_of(const IceMaterial& m, const FormulaFill& f, const PrimitiveFill& fill,
                 std::size_t n) {
  return f.pressure && m.fluid.depends_on_energy()
             ? m.fluid.energy_from_pressure(fill.density[n], fill.pressure[n], fill.temperature[n])
             : m.fluid.energy_from_temperature(fill.density[n], fill.temperature[n]);
}

void add(const IceMaterial& m, const FormulaFill& f, const PrimitiveFill& fill, double weight,
         std::vector<Amounts>& sums) {
  for (std::size_t n = 0; n < sums.size(); ++n) {
    const double mass = weight * fill.density[n];
    const Vec3 u{fill.velocity[0][n], fill.velocity[1][n], fill.velocity[2][n]};
    sums[n].mass += mass;
    sums[n].momentum += mass * u;
    sums[n].energy += weight * energy_of(m, f, fill, n) + 0.5 * mass * dot(u, u);
  }
}

void put(const IceMaterial& m, const std::vector<Amounts>& sums, PrimitiveFill& fill) {
  for (std::size_t n = 0; n < sums.size(); ++n) {
    const auto& [rho, energy, momentum] = sums[n];
    const double rho_e = energy - 0.5 * dot(momentum, momentum) / rho;
    fill.density[n] = rho;
    for (int d = 0; d < 3; ++d) fill.velocity[d][n] = momentum[d] / rho;
    fill.temperature[n] = m.fluid.temperature(rho, rho_e);
    fill.pressure[n] = m.fluid.pressure(rho, rho_e);
  }
}

}  // namespace

void apply_formula(const FormulaFill& formula, const IceMaterial& m, const Level& level,
                   PrimitiveFill& fill) {
  if (!formula.over_cells) {
    evaluate_all(formula, m, level, {}, fill);
    return;
  }
  std::vector<Amounts> sums(fill.density.size());
  for (const Point& point : gauss_points(level)) {
    PrimitiveFill there = fill;
    evaluate_all(formula, m, level, point.offset, there);
    add(m, formula, there, point.weight, sums);
  }
  put(m, sums, fill);
}

}  // namespace sluice::ice
