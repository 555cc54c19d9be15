// Finding the surface, and what a gas that slips along it changes in the friction on faces.
//
//   t_c' = t_c [(1 - s) + s/(1 + mu/(h dx))]     c along the face, s the area of the contact,
// mu the viscosity of the face and h what passes for a unit of slip: the slip length is mu/h.
#include "ice/mixture/surface.hpp"

#include <algorithm>
#include <cmath>

#include "ice/closure/interface_band.hpp"
#include "ice/fluid/face_mean.hpp"
#include "ice/fluid/limiters.hpp"
#include "ice/step/material_runs.hpp"

namespace sluice::ice::mixture {
namespace {

struct Handles {
  In pure, gas, solid, mass, energy;
  Out surface;
};

class SurfaceCells {
 public:
  SurfaceCells(const Row& row, const Handles& h, const SchemeOptions& o)
      : row_(row),
        h_(h),
        o_(o),
        fluid_(o.materials.fluids[o.materials.multi_velocity_exchange->fluid]) {}

  void run(int first, int count) const {
    for (int i = first; i < first + count; ++i) cell(i);
  }

 private:
  double at(In in, int axis, int shift, int i) const { return row_(in, 0, axis, shift)[i]; }

  void cell(int i) const {
    const double gas = at(h_.gas, 0, 0, i), solid = at(h_.solid, 0, 0, i);
    const double own = shared_part(gas, solid);
    double vector[3] = {0, 0, 0}, squared = 0, jump = 0;
    for (int a = 0; a < o_.grid.axes.count; ++a) {
      const double inverse_dx = 1.0 / row_.step().spacing[o_.grid.axes.direction[a]];
      double least = solid, most = solid, part[2];
      for (const int side : {0, 1}) {
        const int shift = side == 0 ? -1 : 1;
        const double other_gas = at(h_.gas, a, shift, i), other = at(h_.solid, a, shift, i);
        least = smaller(least, other);
        most = larger(most, other);
        const double shared = shared_part(other_gas, other), sum = own + shared;
        const double of_face = larger(own, shared) * (sum > 0.0 ? own / sum : 0.0);
        part[side] = of_face * (side == 0 ? other - solid : solid - other);
      }
      jump = larger(jump, most - least);
      vector[a] = (part[0] + part[1]) * inverse_dx;
      squared += vector[a] * vector[a];
    }
    write(i, gas, std::sqrt(squared), vector, jump);
  }
  void write(int i, double gas, double area, const double* vector, double jump) const {
    const auto to = [&](int part) -> double& { return row_(h_.surface, part)[i]; };
    double momentum = 0, heat = 0;
    if (gas > 0.0) {
      const double rho = row_(h_.mass)[i] / gas, e = row_(h_.energy)[i] / gas;
      const double T = fluid_.temperature(rho, e);
      momentum = o_.materials.multi_velocity_exchange->momentum_transfer(fluid_, rho, T);
      heat = o_.materials.multi_velocity_exchange->heat_transfer(fluid_, rho, T,
                                                                 fluid_.heat_capacity(rho, e));
    }
    const double share = std::clamp((jump - loose_jump) / (tight_jump - loose_jump), 0.0, 1.0);
    to(SurfaceParts::share) = area > 0.0 ? share : 0.0;
    to(SurfaceParts::momentum) = area * momentum;
    to(SurfaceParts::heat) = area * heat;
    to(SurfaceParts::momentum_per_area) = momentum;
    to(SurfaceParts::heat_per_area) = heat;
    for (int a = 0; a < o_.grid.axes.count; ++a)
      to(SurfaceParts::normal + a) = area > 0.0 ? vector[a] / area : 0.0;
  }

  const Row& row_;
  const Handles& h_;
  const SchemeOptions& o_;
  const Fluid& fluid_;
};

}  // namespace

double FaceOfSurface::contact() const {
  const double g = gas[0] - gas[1], s = solid[0] - solid[1];
  return g * s < 0.0 ? smaller(std::fabs(g), std::fabs(s)) : 0.0;
}
double FaceOfSurface::left_to_face() const {
  return 1.0 - larger(shared_part(gas[0], solid[0]), shared_part(gas[1], solid[1]));
}

void add_surface(TaskList& list, const SurfaceInput& v, const SchemeOptions& o, int effect) {
  if (!o.materials.multi_velocity_exchange) return;
  TaskBuilder task = list.task("surface along which gas slips", effect);
  const std::size_t gas = o.materials.multi_velocity_exchange->fluid;
  const std::size_t solid = o.materials.multi_velocity_exchange->solid;
  Handles h;
  h.pure = task.read(v.pure);
  h.gas = task.read(v.state.volume[gas], Stencil::box(1));
  h.solid = task.read(v.state.volume[solid], Stencil::box(1));
  h.mass = task.read(v.state.mass[gas]);
  h.energy = task.read(v.state.energy[gas]);
  h.surface = task.write(v.surface);
  task.kernel([=](const Row& row) {
    for_each_run(runs_of(row, h.pure), row.count(), [&](int first, int count, double alone) {
      if (alone < 0.0) return SurfaceCells(row, h, o).run(first, count);
      for (int part = 0; part < SurfaceParts::count(o.grid.axes.count); ++part)
        std::fill_n(row(h.surface, part) + first, count, 0.0);
    });
  });
}

void add_slip_of_friction(TaskList& list, const FrictionInput& v, const SchemeOptions& o,
                          const std::array<VariableId, 3>& raw, int effect) {
  const auto of = [](int material) { return static_cast<std::size_t>(material); };
  for (int axis = 0; axis < o.grid.axes.count; ++axis) {
    static const char* names[] = {"slip on axis 0", "slip on axis 1", "slip on axis 2"};
    TaskBuilder task = list.task(names[axis], effect);
    const Stencil both = Stencil::along(o.grid.axes.direction[axis], 1, 0);
    const In stress = task.read(raw[of(axis)]), viscosity = task.read(v.mixture.viscosity, both);
    const In gas =
        task.read(v.of_each.state.volume[of(o.materials.multi_velocity_exchange->fluid)], both);
    const In solid =
        task.read(v.of_each.state.volume[of(o.materials.multi_velocity_exchange->solid)], both);
    const In surface = task.read(v.surface, both);
    const Out slipping = task.write(v.mixture.stress[of(axis)]);
    task.kernel([=, components = o.grid.components](const Row& row) {
      const auto low = [&](In in, int c = 0) { return row(in, c, axis, -1); };
      const double dx = row.step().spacing[o.grid.axes.direction[axis]];
      constexpr int transfer = SurfaceParts::momentum_per_area;
      for (int c = 0; c < components; ++c) {
        const double* t = row(stress, c);
        double* to = row(slipping, c);
        std::copy_n(t, row.count(), to);
        if (c == axis) continue;
        for (int i = 0; i < row.count(); ++i) {
          const FaceOfSurface face{{low(gas)[i], row(gas)[i]},
                                   {low(solid)[i], row(solid)[i]},
                                   {low(surface, transfer)[i], row(surface, transfer)[i]}};
          const double s = face.contact();
          if (!(s > 0.0)) continue;
          const double mu = harmonic_mean(low(viscosity)[i], row(viscosity)[i]);
          to[i] = t[i] * ((1.0 - s) + s * face.passes(dx, mu));
        }
      }
    });
  }
}

}  // namespace sluice::ice::mixture
