#include "mpm/loads/cohesive_law.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sluice::mpm {
namespace {

Vec3 unit(Vec3 v) {
  return (1 / std::sqrt(dot(v, v))) * v;
}

double normal_work(const CohesiveZone& z) {
  return std::numbers::e * z.sig_max * z.delta_n;
}
double tangential_work(const CohesiveZone& z) {
  return std::sqrt(0.5 * std::numbers::e) * z.tau_max * z.delta_t;
}

}  // namespace

CohesiveFrame cohesive_frame(Vec3 normal, Vec3 tangent) {
  const Vec3 n = unit(normal);
  const Vec3 t = unit(tangent - dot(tangent, n) * n);
  return {n, t, cross(t, n)};
}

Vec3 cohesive_traction(const CohesiveZone& z, const CohesiveFrame& f, Vec3 separation) {
  const double phi = normal_work(z), q = tangential_work(z) / phi;
  const double n = dot(separation, f.normal) / z.delta_n;
  const double a = dot(separation, f.first) / z.delta_t;
  const double b = dot(separation, f.second) / z.delta_t;
  const double fall = std::exp(-n), ea = std::exp(-a * a), eb = std::exp(-b * b);
  const double normal = phi / z.delta_n * fall * n * (ea + (1 - q) * (1 - ea));
  const double shear = 2 * q * phi / z.delta_t * (1 + n) * fall;
  return normal * f.normal + (shear * a * ea) * f.first + (shear * b * eb) * f.second;
}

bool cohesive_failure(const CohesiveZone& z, const CohesiveFrame& f, Vec3 separation) {
  return dot(separation, f.normal) > z.delta_n_fail ||
         std::fabs(dot(separation, f.first)) > z.delta_t_fail ||
         std::fabs(dot(separation, f.second)) > z.delta_t_fail;
}

double cohesive_stiffness(const CohesiveZone& z) {
  return std::max(normal_work(z) / (z.delta_n * z.delta_n),
                  2 * tangential_work(z) / (z.delta_t * z.delta_t));
}

}  // namespace sluice::mpm
