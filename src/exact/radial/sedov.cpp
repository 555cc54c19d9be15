#include "exact/radial/sedov.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "exact/base/symmetry.hpp"
#include "framework/base/error.hpp"

namespace sluice::exact {
namespace {

// Gauss-Legendre points and weights on [-1, 1], eight points.
constexpr std::array<double, 4> gauss_point = {0.1834346424956498, 0.5255324099163290,
                                               0.7966664774136267, 0.9602898564975363};
constexpr std::array<double, 4> gauss_weight = {0.3626837833783620, 0.3137066458778873,
                                                0.2223810344533745, 0.1012285362903763};

// Surface of the unit sphere; the two sides of a plane.
double unit_surface(int dimension) {
  const double pi = std::acos(-1.0);
  return dimension == 1 ? 2.0 : dimension == 2 ? 2 * pi : 4 * pi;
}

}  // namespace

SedovProfile::SedovProfile(int dimension, double gamma) : dimension_(dimension), gamma_(gamma) {
  const double g = gamma, j = dimension;
  // Standard case: V behind the shock below V*, Kamm and Timmes eq. 18; exponents singular at 2.
  if (!(g > 1) || !(4 / ((j + 2) * (g + 1)) < 2 / ((g - 1) * j + 2)) || std::abs(g - 2) < 1e-4) {
    throw InputError(fmt::format(
        "Sedov blast in {} dimensions: gamma is {}, allowed is 1 < gamma{} except 2 itself",
        dimension, gamma, dimension == 3 ? " < 7 (a void opens at the centre beyond)" : ""));
  }
  const double a = j + 2, denominator = 2 * (g - 1) + j;
  a0_ = 2 / a;
  a2_ = -(g - 1) / denominator;
  a1_ = a * g / (2 + j * (g - 1)) * (2 * j * (2 - g) / (g * a * a) - a2_);
  a3_ = j / denominator;
  a4_ = a * a1_ / (2 - g);  // a (j) a1 / (j (2 - g))
  a5_ = -2 / (2 - g);
  alpha_ = energy_integral();
}

// The profile at x2 = (g+1)/(g-1) ((j+2) g V/2 - 1), from 0 at the centre to 1 at the shock.
SedovProfile::Scaled SedovProfile::at_log_x2(double log_x2, double& log_lambda) const {
  const double g = gamma_, j = dimension_, a = j + 2;
  const double b = (g + 1) / (g - 1);
  const double cv = 1 + std::exp(log_x2) / b;  // c V, c = a g / 2
  const double v = 2 * cv / (a * g);
  const double x1 = 0.25 * a * (g + 1) * v;
  const double e = 0.5 * (2 + j * (g - 1));
  const double x3 = a * (g + 1) / (a * (g + 1) - 4 * e) * (1 - e * v);
  const double x4 = b * (1 - cv / g);
  log_lambda = -a0_ * std::log(x1) - a2_ * log_x2 - a1_ * std::log(x3);
  Scaled out{};
  out.velocity = x1 * std::exp(log_lambda);
  out.density = std::exp(a3_ * log_x2 + a4_ * std::log(x3) + a5_ * std::log(x4));
  out.pressure =
      std::exp(a0_ * j * std::log(x1) + (a4_ - 2 * a1_) * std::log(x3) + (1 + a5_) * std::log(x4));
  return out;
}

SedovProfile::Scaled SedovProfile::at(double lambda) const {
  if (lambda >= 1) return {1, 1, 1};
  double found = 0;
  if (lambda <= 0) {
    Scaled centre = at_log_x2(-700, found);
    centre.density = centre.velocity = 0;
    return centre;
  }
  const double wanted = std::log(lambda);
  double low = -700, high = 0;  // lambda rises with x2
  Scaled out{};
  for (int i = 0; i < 200; ++i) {
    const double middle = 0.5 * (low + high);
    if (middle == low || middle == high) break;
    out = at_log_x2(middle, found);
    (found < wanted ? low : high) = middle;
  }
  return out;
}

// alpha = E / (rho0 R^(j+2) / t^2) with kinetic and internal energy of the profile.
double SedovProfile::energy_integral() const {
  const double g = gamma_, j = dimension_;
  const double shock_speed = 2 / (j + 2);  // in units of R/t
  const double u2 = 2 / (g + 1) * shock_speed, rho2 = (g + 1) / (g - 1);
  const double p2 = 2 / (g + 1) * shock_speed * shock_speed;
  const int panels = 200;
  double sum = 0;
  for (int panel = 0; panel < panels; ++panel) {
    for (int point = 0; point < 8; ++point) {
      const double s = point < 4 ? -gauss_point[point] : gauss_point[point - 4];
      const double weight = gauss_weight[point % 4] / (2 * panels);
      const double lambda = (panel + 0.5 * (1 + s)) / panels;
      const Scaled scaled = at(lambda);
      const double u = u2 * scaled.velocity;
      const double energy = 0.5 * rho2 * scaled.density * u * u + p2 * scaled.pressure / (g - 1);
      sum += weight * energy * std::pow(lambda, j - 1);
    }
  }
  return unit_surface(dimension_) * sum;
}

Sedov::Sedov(Blast blast) : blast_(blast), profile_(blast.dimension, blast.gamma) {}

double Sedov::shock_radius(double t) const {
  return std::pow(blast_.energy * t * t / (profile_.alpha() * blast_.density),
                  1.0 / (blast_.dimension + 2));
}

double Sedov::shock_speed(double t) const {
  return 2 * shock_radius(t) / ((blast_.dimension + 2) * t);
}

State Sedov::at(Vec3 x, double t) const {
  const RadialPoint point = radial_point(x - blast_.origin, blast_.dimension, blast_.axis);
  const double g = blast_.gamma;
  const double radius = t > 0 ? shock_radius(t) : 0;
  if (point.r >= radius) return {blast_.density, {}, blast_.pressure, g};
  const double speed = shock_speed(t);
  const SedovProfile::Scaled scaled = profile_.at(point.r / radius);
  State out;
  out.gamma = g;
  out.density = blast_.density * (g + 1) / (g - 1) * scaled.density;
  out.velocity = point.outward * (2 / (g + 1) * speed * scaled.velocity);
  out.pressure = 2 / (g + 1) * blast_.density * speed * speed * scaled.pressure;
  return out;
}

}  // namespace sluice::exact
