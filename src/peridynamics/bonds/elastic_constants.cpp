#include "peridynamics/bonds/elastic_constants.hpp"

#include <cmath>
#include <numbers>

namespace sluice::peridynamics {
namespace {

using std::numbers::pi;

// Sum over offsets of a lattice of spacing dx with a = x > 0 of f(a, r) V.
template <class F>
double sum_across_plane(const PeriScene& scene, double delta, double dx, F f) {
  const int most = static_cast<int>(std::floor(delta / dx + 0.5)) + 1;
  const int y_most = scene.dimensions > 1 ? most : 0, z_most = scene.dimensions > 2 ? most : 0;
  const double V = std::pow(dx, scene.dimensions) * scene.thickness;
  double sum = 0;
  for (int i = 1; i <= most; ++i)
    for (int j = -y_most; j <= y_most; ++j)
      for (int k = -z_most; k <= z_most; ++k) {
        const double r = dx * std::sqrt(static_cast<double>(i * i + j * j + k * k));
        sum += f(i * dx, r) * V;
      }
  return sum;
}

}  // namespace

double family_integral(const PeriScene& scene, double delta) {
  // int_0^delta omega r^d dr over delta^(d+1), times the surface of the unit ball.
  const double d = scene.dimensions;
  double radial = 1 / (d + 1);
  if (scene.influence == Influence::linear) radial = 1 / (d + 1) - 1 / (d + 2);
  if (scene.influence == Influence::inverse) radial = 1 / d;
  const double surface = scene.dimensions == 3 ? 4 * pi : scene.dimensions == 2 ? 2 * pi : 2;
  const double section = scene.dimensions == 3 ? 1 : scene.thickness;
  return surface * section * radial * std::pow(delta, d + 1);
}

double critical_bond_energy(const PeriScene& scene, const PeriMaterial& m, double dx) {
  const BondRule rule{scene.influence, scene.partial_volume};
  return m.damage.fracture_energy / sum_across_plane(scene, m.horizon, dx, [&](double a, double r) {
           return a * rule.beta(r, m.horizon, dx);
         });
}

double critical_stretch(const PeriScene& scene, const PeriMaterial& m, double dx) {
  if (m.damage.critical_stretch > 0) return m.damage.critical_stretch;
  const double G0 = m.damage.fracture_energy, k = m.bulk, mu = m.shear, delta = m.horizon;
  if (m.law == Law::lps && scene.dimensions == 3)
    return std::sqrt(G0 / ((3 * mu + std::pow(0.75, 4) * (k - 5 * mu / 3)) * delta));
  if (m.law == Law::lps)
    return std::sqrt(G0 / ((6 * mu / pi + 16 * (k - 2 * mu) / (9 * pi * pi)) * delta));
  const BondRule rule{scene.influence, scene.partial_volume};
  const double d = scene.dimensions;
  // Of the lattice where stiffness follows families, else of the integral.
  double S = family_integral(scene, delta);
  const auto weight = [&](double r) { return rule.omega(r, delta) * rule.beta(r, delta, dx); };
  if (scene.surface_weights == SurfaceWeights::volume) {
    S = 0;
    const int most = static_cast<int>(std::floor(delta / dx + 0.5)) + 1;
    const int y_most = d > 1 ? most : 0, z_most = d > 2 ? most : 0;
    for (int i = -most; i <= most; ++i)
      for (int j = -y_most; j <= y_most; ++j)
        for (int n = -z_most; n <= z_most; ++n) {
          const double r = dx * std::sqrt(static_cast<double>(i * i + j * j + n * n));
          if (r > 0) S += weight(r) * r * std::pow(dx, d) * scene.thickness;
        }
  }
  const double c = 2 * k * d * d / S;
  return std::sqrt(2 * G0 / (c * sum_across_plane(scene, delta, dx, [&](double a, double r) {
                               return a * weight(r) * r;
                             })));
}

}  // namespace sluice::peridynamics
