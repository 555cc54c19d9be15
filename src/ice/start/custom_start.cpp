// Initial states by kind, at the centre of a cell.
//
//   vortex       x_a, x_b from the origin in the plane normal to the axis (a, b follow it in cyclic
//                order), r^2 = x_a^2 + x_b^2 <= R^2, w = exp(-r^2/(2 R^2)):
//                u_a -= C x_b w/(rho R^2),  u_b += C x_a w/(rho R^2),  p = p_ref + rho C^2 w/R^2
//   pairs        n pairs that turn in turn, from side to side along b and one beside another along
//                c: the plane normal to the axis, c its periodic direction (both or none is: b, c
//                follow the axis in cyclic order). With y = (x_b - low_b)/L_b, z likewise,
//                u_b += S sin^2(pi y) cos(2 pi n z),
//                u_c -= S L_c/(2 n L_b) sin(2 pi y) sin(2 pi n z):
//                no divergence, at rest at the sides of b. The pressure stays.
//   gaussian     T += a exp(-(x - x0)^2/(2 s_x^2) - (y - y0)^2/(2 s_y^2))
//   mms_1        u = 1 - A cos x sin y,  v = 1 + A sin x cos y,
//                p = p_ref - rho A^2/4 (cos 2x + cos 2y)
//   mms_3        u = B sin(f + 2 pi/3) sin x cos y cos z,  v = B sin(f - 2 pi/3) cos x sin y cos z,
//                w = B sin f cos x cos y sin z,  B = 2/sqrt 3
//   counterflow  u = -s (x - x_m), v = s (y - y_m) about the middle of the domain,
//                p = p_ref + rho/2 (|u_ref|^2 - |u|^2)
//   log law      u = u*/k ln(h/z0) at height h above the floor, 0 below z0
//   power law    u = U min(h/H, 1)^n
//   channel      u = u*/0.4 ln(Re h/H) with h to the nearer wall, u* = mu Re/(rho H), 0 where
//                negative
//   laminar      u = dp/dx h (h - H)/(2 mu) over the height H of the domain
#include "ice/start/custom_start.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sluice::ice {
namespace {

// Corners of the domain without ghost cells.
double floor_of(const Level& level, int d) {
  return level.centre(level.domain.lower)[d] - 0.5 * level.spacing[d];
}
double ceiling_of(const Level& level, int d) {
  return floor_of(level, d) + (level.domain.upper[d] - level.domain.lower[d]) * level.spacing[d];
}

void give_pressure(CellStart& cell, double pressure) {
  cell.pressure = pressure;
  cell.pressure_given = true;
}

struct Apply {
  const CustomPlace& place;
  CellStart& cell;

  void operator()(const Vortices& vortices) const {
    for (const Vortex& v : vortices.list) {
      const int a = (v.axis + 1) % 3, b = (v.axis + 2) % 3;
      const double xa = cell.centre[a] - v.origin[a], xb = cell.centre[b] - v.origin[b];
      const double r2 = xa * xa + xb * xb, R2 = v.radius * v.radius;
      if (!(r2 <= R2)) continue;
      const double w = std::exp(-0.5 * r2 / R2), turn = v.strength * w / (cell.density * R2);
      cell.velocity[a] -= turn * xb;
      cell.velocity[b] += turn * xa;
      give_pressure(cell,
                    place.reference_pressure + cell.density * v.strength * v.strength / R2 * w);
    }
    if (!cell.pressure_given) give_pressure(cell, place.reference_pressure);
  }
  void operator()(const VortexPairs& v) const {
    const auto [b, c] = directions_of(v, place.coarsest);
    const double long_b = length(b), long_c = length(c), pi = std::numbers::pi;
    const double y = height(b) / long_b, turn = 2.0 * pi * v.pairs * height(c) / long_c;
    const double across = std::sin(pi * y);
    cell.velocity[b] += v.strength * across * across * std::cos(turn);
    cell.velocity[c] -=
        v.strength * long_c / (2.0 * v.pairs * long_b) * std::sin(2.0 * pi * y) * std::sin(turn);
  }
  void operator()(const GaussianTemperature& g) const {
    const double x = (cell.centre.x - g.origin.x) / g.spread_x;
    const double y = (cell.centre.y - g.origin.y) / g.spread_y;
    cell.temperature += g.amplitude * std::exp(-0.5 * (x * x + y * y));
  }
  void operator()(const ManufacturedVortices& m) const {
    const double x = cell.centre.x, y = cell.centre.y, A = m.amplitude;
    cell.velocity.x = 1.0 - A * std::cos(x) * std::sin(y);
    cell.velocity.y = 1.0 + A * std::sin(x) * std::cos(y);
    give_pressure(cell, place.reference_pressure -
                            0.25 * cell.density * A * A * (std::cos(2.0 * x) + std::cos(2.0 * y)));
  }
  void operator()(const ManufacturedCells& m) const {
    const Vec3 x = cell.centre;
    const double third = 2.0 * std::numbers::pi / 3.0, B = 2.0 / std::numbers::sqrt3;
    cell.velocity = {B * std::sin(m.angle + third) * std::sin(x.x) * std::cos(x.y) * std::cos(x.z),
                     B * std::sin(m.angle - third) * std::cos(x.x) * std::sin(x.y) * std::cos(x.z),
                     B * std::sin(m.angle) * std::cos(x.x) * std::cos(x.y) * std::sin(x.z)};
  }
  Vec3 counter_velocity(const Counterflow& c, Vec3 at) const {
    Vec3 middle{};
    for (int d = 0; d < 2; ++d)
      middle[d] = 0.5 * (floor_of(place.coarsest, d) + ceiling_of(place.coarsest, d));
    return {-c.strain_rate * (at.x - middle.x), c.strain_rate * (at.y - middle.y), 0.0};
  }
  void operator()(const Counterflow& c) const {
    const Vec3 u = counter_velocity(c, cell.centre);
    const Vec3 reference = counter_velocity(c, place.coarsest.centre(c.reference_cell));
    cell.velocity.x = u.x;
    cell.velocity.y = u.y;
    give_pressure(
        cell, place.reference_pressure + 0.5 * cell.density *
                                             (reference.x * reference.x +
                                              reference.y * reference.y - (u.x * u.x + u.y * u.y)));
  }
  double height(int vertical) const {
    return cell.centre[vertical] - floor_of(place.coarsest, vertical);
  }
  double length(int d) const { return ceiling_of(place.coarsest, d) - floor_of(place.coarsest, d); }
  void operator()(const LogLawProfile& p) const {
    const double share = height(p.vertical) / p.roughness;
    cell.velocity[p.flow] =
        share > 1.0 ? p.friction_velocity / p.von_karman * std::log(share) : 0.0;
  }
  void operator()(const PowerLawProfile& p) const {
    const double share = std::clamp(height(p.vertical) / p.height, 0.0, 1.0);
    for (int d = 0; d < 3; ++d) cell.velocity[d] = p.velocity[d] * std::pow(share, p.exponent);
  }
  void operator()(const ChannelProfile& p) const {
    const double low = p.floor.value_or(floor_of(place.coarsest, p.vertical));
    const double high = p.ceiling.value_or(ceiling_of(place.coarsest, p.vertical));
    const double x = cell.centre[p.vertical];
    const double wall_units = p.reynolds * std::min(x - low, high - x) / p.half_height;
    const double friction = cell.viscosity * p.reynolds / (cell.density * p.half_height);
    cell.velocity[p.flow] = wall_units > 1.0 ? friction / 0.4 * std::log(wall_units) : 0.0;
  }
  void operator()(const LaminarChannel& p) const {
    const double h = height(p.vertical);
    const double total = length(p.vertical);
    cell.velocity[p.vertical == 0 ? 1 : 0] =
        0.5 * p.pressure_gradient * h * (h - total) / cell.viscosity;
  }
};

}  // namespace

void apply(const CustomStart& start, const CustomPlace& place, CellStart& cell) {
  std::visit(Apply{place, cell}, start);
}

}  // namespace sluice::ice
