#include "mpm/loads/load_curves.hpp"

#include <cmath>
#include <stdexcept>

#include "mpm/loads/load_curve.hpp"

namespace sluice::mpm {

// Higham's iteration R <- (R + R^-T)/2, which doubles the digits in every pass.
std::array<double, 9> rotation_of(const std::array<double, 9>& F) {
  std::array<double, 9> R = F;
  for (int pass = 0; pass < 40; ++pass) {
    const Vec3 a{R[0], R[1], R[2]}, b{R[3], R[4], R[5]}, c{R[6], R[7], R[8]};
    const Vec3 bc = cross(b, c), ca = cross(c, a), ab = cross(a, b);
    const double det = dot(a, bc);
    const std::array<double, 9> inverse_transposed = {bc.x, bc.y, bc.z, ca.x, ca.y,
                                                      ca.z, ab.x, ab.y, ab.z};
    double change = 0;
    for (std::size_t e = 0; e < 9; ++e) {
      const double next = 0.5 * (R[e] + inverse_transposed[e] / det);
      change = std::fmax(change, std::fabs(next - R[e]));
      R[e] = next;
    }
    if (!(change > 1e-15)) break;
  }
  return R;
}

LoadCurves::LoadCurves(const MpmScene& solids) : solids_(&solids) {
  for (const LoadCurve& l : solids.loads)
    loads_.push_back({&l, LoadSurface(l, solids.axisymmetric, solids.moves_along)});
}

bool LoadCurves::concerns(const LoadCurve& curve, int material) const {
  return !curve.material || *curve.material == solids_->materials[material].index;
}

bool LoadCurves::forces(int material) const {
  for (const Load& l : loads_)
    if (l.curve->kind != LoadCurve::Kind::heat_flux && concerns(*l.curve, material)) return true;
  return false;
}

bool LoadCurves::heats(int material) const {
  for (const Load& l : loads_)
    if (l.curve->kind == LoadCurve::Kind::heat_flux && concerns(*l.curve, material)) return true;
  return false;
}

std::array<int, max_marks> LoadCurves::marks_of(int material, Vec3 x, Vec3 width, bool at_surface,
                                                const std::array<int, max_marks>& named) const {
  std::array<int, max_marks> marks{};
  std::size_t found = 0;
  for (std::size_t n = 0; n < loads_.size(); ++n) {
    const Load& load = loads_[n];
    const LoadCurve& curve = *load.curve;
    if (!concerns(curve, material)) continue;
    bool feels = false;
    if (curve.kind == LoadCurve::Kind::force) {
      feels = curve.piece->inside(x);
    } else if (curve.on_points) {
      for (const int id : named) feels |= id != 0 && id == curve.id;
    } else {
      feels = at_surface && load.surface.holds(x, width);
    }
    if (!feels) continue;
    if (found == max_marks) throw std::length_error("more than three loads act on a particle");
    marks[found++] = static_cast<int>(n) + 1;
  }
  return marks;
}

Vec3 LoadCurves::force_of(const Load& load, double value, const LoadedParticles& p,
                          std::size_t i) const {
  const LoadCurve& curve = *load.curve;
  const Vec3 x{p.x[0][i], p.x[1][i], p.x[2][i]};
  if (curve.kind == LoadCurve::Kind::force) return value * curve.force;
  if (curve.kind == LoadCurve::Kind::torque) {
    const Vec3 d = cross(load.surface.arm(x), load.surface.axis());
    const double d2 = dot(d, d);
    return d2 > 0 ? (value / d2) * d : Vec3{};
  }
  Vec3 n{};
  if (curve.on_points) {
    if (p.normal[0] != nullptr) n = {p.normal[0][i], p.normal[1][i], p.normal[2][i]};
  } else {
    n = load.surface.direction(x);
  }
  if (solids_->normal_to_surface) {
    std::array<double, 9> F;
    for (std::size_t e = 0; e < 9; ++e) F[e] = p.F[e][i];
    const std::array<double, 9> R = rotation_of(F);
    n = {R[0] * n.x + R[1] * n.y + R[2] * n.z, R[3] * n.x + R[4] * n.y + R[5] * n.z,
         R[6] * n.x + R[7] * n.y + R[8] * n.z};
  }
  return (curve.axisymmetric_end ? value * x.x * p.width[0] : value) * n;
}

void LoadCurves::add_forces(double time, const std::vector<double>& counts,
                            const LoadedParticles& p, const std::array<double*, 3>& force) const {
  // What a particle gets: of its share in the area, the torque or the force.
  std::vector<double> value(loads_.size());
  for (std::size_t n = 0; n < loads_.size(); ++n) {
    const LoadCurve& curve = *loads_[n].curve;
    value[n] = load_at(curve.points, time);
    if (curve.axisymmetric_end) continue;  // the ring of each particle is its share
    if (curve.kind == LoadCurve::Kind::pressure) value[n] *= loads_[n].surface.area();
    value[n] = counts[n] > 0 ? value[n] / counts[n] : 0;
  }
  for (const double* marks : p.marks)
    for (std::size_t i = p.begin; i < p.end; ++i) {
      if (marks[i] == 0) continue;
      const auto n = static_cast<std::size_t>(marks[i]) - 1;
      if (loads_[n].curve->kind == LoadCurve::Kind::heat_flux) continue;
      const Vec3 f = force_of(loads_[n], value[n], p, i);
      for (int d = 0; d < 3; ++d) force[d][i] += f[d];
    }
}

Vec3 LoadCurves::face_of(const LoadedParticles& p, std::size_t i) const {
  for (const double* marks : p.marks) {
    if (marks[i] == 0) continue;
    const Load& load = loads_[static_cast<std::size_t>(marks[i]) - 1];
    if (load.curve->kind == LoadCurve::Kind::heat_flux || load.curve->on_points) continue;
    return (load.curve->along_outward ? 1.0 : -1.0) *
           load.surface.direction({p.x[0][i], p.x[1][i], p.x[2][i]});
  }
  return {};
}

void LoadCurves::add_heat(double time, const std::vector<double>& counts, const LoadedParticles& p,
                          double* heat) const {
  for (const double* marks : p.marks)
    for (std::size_t i = p.begin; i < p.end; ++i) {
      if (marks[i] == 0) continue;
      const auto n = static_cast<std::size_t>(marks[i]) - 1;
      const LoadCurve& curve = *loads_[n].curve;
      if (curve.kind != LoadCurve::Kind::heat_flux || !(counts[n] > 0)) continue;
      heat[i] += load_at(curve.points, time) * loads_[n].surface.area() / counts[n];
    }
}

}  // namespace sluice::mpm
