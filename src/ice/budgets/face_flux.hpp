// What passes through a face in a step, of either scheme, as amounts per volume of a cell.
//
//   mass F, momentum F U + l p_f n - l t, total energy l p_f u_f + F |U|^2/2 + G - l t . u + l q,
// l = dt/dx, t the viscous stress, u the velocity between the two cells, q the flux of heat. Shear
// along strong shocks (step/shock_shear.hpp) passes like l t.
// Positive along the axis; kg/m^3, kg/(m^2 s) and J/m^3.
#pragma once
#include "ice/fluid/face_mean.hpp"
#include "ice/fluid/limiters.hpp"
#include "ice/step/variables.hpp"

namespace sluice::ice {

struct FaceFluxInput {
  std::array<VariableId, 3> flux, face_velocity, face_pressure, stress, heat_flux;
  VariableId velocity, front_viscosity;
  std::array<VariableId, 3> material_flux, material_velocity;  // of a mixture
  VariableId pure;                                             // likewise
  std::array<VariableId, 3> covered;                           // by solids
  VariableId shear, shear_marks, rho;                          // along strong shocks

  static FaceFluxInput of(const SchemeVariables& v) {
    return {.flux = v.flux,
            .face_velocity = v.face_velocity,
            .face_pressure = v.face_pressure,
            .stress = v.stress,
            .heat_flux = v.heat_flux,
            .velocity = v.velocity,
            .front_viscosity = v.front_viscosity,
            .material_flux = v.material_flux,
            .material_velocity = v.material_velocity,
            .pure = v.pure,
            .covered = v.walls.covered,
            .shear = v.shear,
            .shear_marks = v.shear_marks,
            .rho = v.rho};
  }
};

struct FaceFluxHandles {
  In flux, face_velocity, face_pressure, stress, velocity, viscosity, heat_flux;
  In materials, pure;      // of a mixture
  In material_velocities;  // where each material has its own
  In covered;              // share of the face that solids cover
  In shear, sheared, rho;  // along strong shocks
};

// Low and high faces of the cells of a row.
inline FaceFluxHandles read_face_fluxes(TaskBuilder& task, const FaceFluxInput& v,
                                        const SchemeOptions& o, int axis) {
  const int direction = o.grid.axes.direction[axis];
  const Stencil both = Stencil::along(direction, 0, 1);
  FaceFluxHandles h;
  h.flux = task.read(v.flux[axis], both);
  h.face_velocity = task.read(v.face_velocity[axis], both);
  h.face_pressure = task.read(v.face_pressure[axis], both);
  if (o.grid.has_cut_cells) h.covered = task.read(v.covered[axis], both);
  if (o.materials.mixture) {
    h.materials = task.read(v.material_flux[axis], both);
    h.pure = task.read(v.pure, Stencil::along(direction, 1, 1));
    if (o.materials.multi_velocity)
      h.material_velocities = task.read(v.material_velocity[axis], both);
  }
  if (o.transport.conducting) h.heat_flux = task.read(v.heat_flux[axis], both);
  if (o.scheme.shears_shocks) {
    h.shear = task.read(v.shear, both);
    h.sheared = task.read(v.shear_marks, both);
    h.rho = task.read(v.rho, Stencil::along(direction, 1, 1));
  }
  if (o.scheme.shears_shocks || o.transport.viscous)
    h.velocity = task.read(v.velocity, Stencil::along(direction, 1, 1));
  if (!o.transport.viscous) return h;
  h.stress = task.read(v.stress[axis], both);
  if (o.friction_tilts())
    h.viscosity = task.read(v.front_viscosity, Stencil::along(direction, 1, 1));
  return h;
}

// Velocity of the fluid on a face on which friction works, component c, m/s.
inline double rubbed_velocity(const Row& row, const FaceFluxHandles& h, const SchemeOptions& o,
                              int axis, int shift, int i, int c) {
  const double a = row(h.velocity, c, axis, shift - 1)[i], b = row(h.velocity, c, axis, shift)[i];
  const double mean = 0.5 * (a + b);
  if (!o.friction_tilts()) return mean;
  return mean + velocity_tilt(row(h.viscosity, 0, axis, shift - 1)[i],
                              row(h.viscosity, 0, axis, shift)[i]) *
                    (b - a);
}

struct FaceFlux {
  double mass = 0, energy = 0;
  double momentum[3] = {0, 0, 0};  // by component
  double impulse[3] = {0, 0, 0};   // the part of momentum that is no advection
};

// The material that both cells of a face and all around them hold alone; -1: there are several.
inline int alone_at_face(const Row& row, const FaceFluxHandles& h, const SchemeOptions& o, int axis,
                         int shift, int i) {
  if (!o.materials.mixture) return o.materials.index;
  const double below = row(h.pure, 0, axis, shift - 1)[i], above = row(h.pure, 0, axis, shift)[i];
  return below == above && below >= 0.0 ? static_cast<int>(above) : -1;
}

// What materials with velocities of their own carry along component c: momentum sum F_m U_m and
// twice the kinetic energy, sum F_m U_m^2, both per volume of a cell.
struct SeparateVelocityFlux {
  double momentum = 0, square = 0;
};
inline SeparateVelocityFlux carried_apart(const Row& row, const FaceFluxHandles& h,
                                          const SchemeOptions& o, int axis, int shift, int i,
                                          int c) {
  SeparateVelocityFlux sum;
  for (int m = 0; m < static_cast<int>(o.materials.fluids.size()); ++m) {
    const double F = row(h.materials, 3 * m + 1, axis, shift)[i];
    const double U = row(h.material_velocities, m * o.grid.components + c, axis, shift)[i];
    sum.momentum += F * U;
    sum.square += F * U * U;
  }
  return sum;
}

// The low (shift 0) or high (shift 1) faces of the cells of a row. What is the same for all of them
// is found once.
class FaceFluxRows {
 public:
  FaceFluxRows(const Row& row, const FaceFluxHandles& h, const SchemeOptions& o, int axis,
               int shift)
      : row_(&row),
        h_(&h),
        o_(&o),
        axis_(axis),
        shift_(shift),
        l_(row.step().dt / row.step().spacing[o.grid.axes.direction[axis]]) {
    const auto faces = [&](In in, int c = 0) { return row(in, c, axis, shift); };
    mass_ = faces(h.flux, 0);
    energy_ = faces(h.flux, 1);
    velocity_ = faces(h.face_velocity);
    pressure_ = faces(h.face_pressure);
    if (o.transport.conducting) heat_ = faces(h.heat_flux);
    if (o.grid.has_cut_cells) covered_ = faces(h.covered);
    if (o.scheme.shears_shocks) {
      shear_ = faces(h.shear, axis);
      sheared_ = faces(h.sheared);
      rho_[0] = row(h.rho, 0, axis, shift - 1);
      rho_[1] = faces(h.rho);
    }
    for (int c = 0; c < o.grid.components; ++c) {
      carried_[c] = faces(h.flux, 2 + c);
      if (o.transport.viscous) stress_[c] = faces(h.stress, c);
    }
  }

  // Of cell i.
  FaceFlux operator()(int i) const {
    const SchemeOptions& o = *o_;
    const double F = mass_[i], pf = pressure_[i];
    FaceFlux flux;
    flux.mass = F;
    double FU2 = 0, friction = 0;
    const bool apart = o.materials.multi_velocity && o.materials.mixture &&
                       alone_at_face(*row_, *h_, o, axis_, shift_, i) < 0;
    for (int c = 0; c < o.grid.components; ++c) {
      // The flux holds U, or F U in the classic form.
      const double carried = carried_[c][i];
      double FU = o.scheme.internal_energy_form ? carried : F * carried;
      const double U = !o.scheme.internal_energy_form ? carried : F != 0.0 ? carried / F : 0.0;
      if (apart) {
        const SeparateVelocityFlux sum = carried_apart(*row_, *h_, o, axis_, shift_, i, c);
        FU = sum.momentum;
        FU2 += sum.square;
      } else {
        FU2 += FU * U;
      }
      double impulse = c == axis_ ? l_ * pf : 0.0;
      if (covered_ != nullptr) impulse *= 1.0 - covered_[i];  // the rest presses on the solid
      if (o.transport.viscous) {
        const double t = stress_[c][i];
        impulse -= l_ * t;
        friction += l_ * t * rubbed_velocity(*row_, *h_, o, axis_, shift_, i, c);
      }
      flux.impulse[c] = impulse;
      flux.momentum[c] = FU + impulse;
    }
    flux.energy = l_ * pf * velocity_[i] + 0.5 * FU2 + energy_[i] - friction;
    if (o.transport.conducting) flux.energy += l_ * heat_[i];
    if (sheared_ != nullptr && sheared_[i] != 0.0 && shear_[i] != 0.0) add_shear(i, flux);
    return flux;
  }

 private:
  void add_shear(int i, FaceFlux& flux) const {
    const double k = shear_[i] * smaller(rho_[0][i], rho_[1][i]);
    double work = 0;  // of all components first: the order of two does not show in the bits
    for (int c = 0; c < o_->grid.components; ++c) {
      if (c == axis_) continue;
      const double a = (*row_)(h_->velocity, c, axis_, shift_ - 1)[i];
      const double b = (*row_)(h_->velocity, c, axis_, shift_)[i];
      const double q = k * (b - a);
      flux.impulse[c] -= q;
      flux.momentum[c] -= q;
      work += q * (0.5 * (a + b));
    }
    flux.energy -= work;
  }

  const Row* row_;
  const FaceFluxHandles* h_;
  const SchemeOptions* o_;
  int axis_, shift_;
  double l_;
  const double *mass_, *energy_, *velocity_, *pressure_, *heat_ = nullptr, *covered_ = nullptr;
  const double *carried_[3] = {}, *stress_[3] = {}, *shear_ = nullptr, *sheared_ = nullptr;
  const double* rho_[2] = {};
};

// What passes of one material, per volume of a cell: volume, mass, energy (with its share of the
// kinetic correction). The graph of one material alone knows that nothing of the others passes.
struct MaterialFlux {
  double volume = 0, mass = 0, energy = 0;
  double momentum[3] = {0, 0, 0};  // by component, where each material has its own velocity
};

inline MaterialFlux material_flux(const Row& row, const FaceFluxHandles& h, const SchemeOptions& o,
                                  int axis, int shift, int i, int material) {
  const auto face = [&](In in, int c) { return row(in, c, axis, shift)[i]; };
  const int alone = alone_at_face(row, h, o, axis, shift, i);
  MaterialFlux flux;
  if (alone < 0) {
    const int c = 3 * material;
    flux = {face(h.materials, c), face(h.materials, c + 1), face(h.materials, c + 2), {}};
    if (o.materials.multi_velocity)
      for (int n = 0; n < o.grid.components; ++n)
        flux.momentum[n] =
            flux.mass * face(h.material_velocities, material * o.grid.components + n);
    return flux;
  }
  if (material != alone) return flux;
  const double l = row.step().dt / row.step().spacing[o.grid.axes.direction[axis]];
  flux = {l * face(h.face_velocity, 0), face(h.flux, 0), face(h.flux, 1), {}};
  for (int n = 0; n < o.grid.components; ++n) flux.momentum[n] = flux.mass * face(h.flux, 2 + n);
  return flux;
}

}  // namespace sluice::ice
