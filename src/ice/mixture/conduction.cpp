// Heat conduction with several materials: each has its own temperature, and touches others.
//
// Between two cells that hold the same material alone q = k (T_a - T_b)/dx, as with one material;
// elsewhere through the contacts of contacts.hpp. Walls touch every material over its share of the
// cell inside. Per face and material: what the one in the low cell gives, what the one in the high
// cell takes (positive along the axis); the flux of the face is their sum. Absent without
// conduction.
#include <algorithm>
#include <cmath>

#include "ice/closure/contacts.hpp"
#include "ice/fluid/face_mean.hpp"
#include "ice/fluid/limiters.hpp"
#include "ice/mixture/surface.hpp"
#include "ice/mixture/tasks.hpp"
#include "ice/one_material/heat_flux_rows.hpp"
#include "ice/step/laws_of_cells.hpp"
#include "ice/step/material_runs.hpp"
#include "ice/step/wall_faces.hpp"
#include "ice/transport/viscosity.hpp"

namespace sluice::ice::mixture {
namespace {

// T and rho_m cv_m of each material that conducts, where it is; where it varies its k too,
//   k_m + cp_m mu_t/Pr_t (rho_m/rho), k_m of a mixed gas that of its fraction.
void add_temperatures(TaskList& list, const HeatFluxInput& v, const SchemeOptions& o, int effect) {
  TaskBuilder task = list.task("temperature of each material", effect);
  const StateReads state = read_state(task, v.state);
  const In presence = task.read(v.presence);
  const Out temperature = task.write(v.temperature), capacity = task.write(v.heat_capacity);
  const bool varies = o.transport.conductivity_varies,
             turbulent = o.transport.models.turbulence.has_value();
  const Out own = task.write(list.temporary("density and energy of a material", turbulent ? 3 : 2));
  const LawsOfCells laws(task, list, o);
  const In eddy = turbulent ? task.read(v.eddy_viscosity) : In{};
  const In rho = turbulent ? task.read(v.rho) : In{};
  const Out conductivity = varies ? task.write(v.conductivity) : Out{};
  task.kernel([=](const Row& row) {
    // The end of the step asks for it where a material may have come in.
    for (int m = 0; varies && m < static_cast<int>(o.materials.fluids.size()); ++m)
      std::fill_n(row(conductivity, m), row.count(), 0.0);
    for_each_run(runs_of(row, presence), row.count(), [&](int first, int count, double set) {
      const Row part = row.part(first, count);
      for_each_of(as_set(set), [&](int m) {
        if (!o.conducts(m)) return;
        double* __restrict r = part(own, 0);
        double* __restrict e = part(own, 1);
        state.divide(part, m, r, e);
        double* __restrict C = part(capacity, m);
        const LawRow law = laws.of(part, m);
        law.temperature(count, r, e, part(temperature, m));
        law.heat_capacity(count, r, e, C);
        if (varies) law.conductivity(count, o.transport.conductivities[m], part(conductivity, m));
        if (turbulent) {
          const double* __restrict mu_t = part(eddy);
          const double* __restrict all = part(rho);
          double* __restrict k = part(conductivity, m);
          double* __restrict ratio = part(own, 2);
          law.heat_capacity_ratio(count, r, e, ratio);
          for (int i = 0; i < count; ++i) {
            const double scale = ratio[i] / o.transport.models.turbulence->prandtl;
            k[i] += scale * C[i] * (mu_t[i] * (r[i] / all[i]));
          }
        }
        for (int i = 0; i < count; ++i) C[i] *= r[i];
      });
    });
  });
}

struct Handles {
  In presence, pure, temperature, capacity, conductivity, surface;
  std::vector<In> volume, mass;
  Out flux, of_materials;
};

// threshold: difference of the shares of a material up to which they are the same on both sides
//   of a face; unit: 1; test: none
constexpr double round_off = 1e-13;

// Rows of one side of the faces of a row, by material.
struct SideRows {
  const double *presence, *share[max_materials], *temperature[max_materials],
      *capacity[max_materials], *conductivity[max_materials], *mass[max_materials], *jump;
};

// All that one side of a face has, gathered for one face.
struct Gathered {
  double share[max_materials], temperature[max_materials], most[max_materials],
      conductivity[max_materials], density[max_materials];
  double jump = 0;

  ContactSide side() const { return {share, temperature, most, conductivity, density, jump}; }
};

class FaceHeat {
 public:
  FaceHeat(const SchemeOptions& o, const Handles& h, int axis)
      : o_(o),
        h_(h),
        axis_(axis),
        contacts_(static_cast<int>(o.materials.fluids.size()), o.materials.heat_exchange,
                  o.materials.multi_velocity_exchange, o.materials.convective) {}

  void run(const Row& row) const {
    const RunRow a = runs_of(row, h_.presence, axis_, -1), b = runs_of(row, h_.presence);
    for_each_face_run(a, b, row.count(), [&](int first, int count, double set) {
      const Row part = row.part(first, count);
      if (set > 0.0 && is_single(set))
        one_material(part, first_of(set));
      else
        contacts(part);
    });
    walls(row);
  }

 private:
  double dx(const Row& row) const { return row.step().spacing[o_.grid.axes.direction[axis_]]; }
  int materials() const { return static_cast<int>(o_.materials.fluids.size()); }
  double k(int m) const { return o_.transport.conductivities[m]; }

  void one_material(const Row& row, int m) const {
    const int n = row.count();
    double* q = row(h_.flux);
    const double *Ta = row(h_.temperature, m, axis_, -1), *Tb = row(h_.temperature, m);
    if (o_.transport.conductivity_varies)
      heat_flux_row(n, row(h_.conductivity, m, axis_, -1), row(h_.conductivity, m), Ta, Tb,
                    1.0 / dx(row), q);
    else if (k(m) > 0.0)
      heat_flux_row(n, k(m), Ta, Tb, 1.0 / dx(row), q);
    else
      std::fill_n(q, n, 0.0);
    const RunRow pure_a = runs_of(row, h_.pure, axis_, -1), pure_b = runs_of(row, h_.pure);
    for_each_face_run(pure_a, pure_b, n, [&](int first, int count, double alone) {
      if (alone >= 0.0) return;
      const Row part = row.part(first, count);
      for (int c = 0; c < 2 * materials(); ++c) {
        double* to = part(h_.of_materials, c);
        for (int i = 0; i < count; ++i) to[i] = c / 2 == m ? q[first + i] : 0.0;
      }
    });
  }

  // Of the low (shift -1) or high (0) cells of the faces.
  SideRows side(const Row& row, int shift) const {
    SideRows s;
    s.presence = row(h_.presence, 0, axis_, shift);
    s.jump = o_.materials.multi_velocity_exchange
                 ? row(h_.surface, SurfaceParts::heat_per_area, axis_, shift)
                 : nullptr;
    for (int m = 0; m < materials(); ++m) {
      s.share[m] = row(h_.volume[m], 0, axis_, shift);
      s.temperature[m] = row(h_.temperature, m, axis_, shift);
      s.capacity[m] = row(h_.capacity, m, axis_, shift);
      s.conductivity[m] =
          o_.transport.conductivity_varies ? row(h_.conductivity, m, axis_, shift) : nullptr;
      s.mass[m] = h_.mass.empty() ? nullptr : row(h_.mass[m], 0, axis_, shift);
    }
    return s;
  }
  // The most k for each unit of rho cv.
  double bound(const Row& row) const {
    double inverse_dx2 = 0;
    for (int a = 0; a < o_.grid.axes.count; ++a) {
      const double inverse = 1.0 / row.step().spacing[o_.grid.axes.direction[a]];
      inverse_dx2 += inverse * inverse;
    }
    return 1.0 / (2.0 * row.step().dt * inverse_dx2);
  }
  void gather(const SideRows& s, double bound, int i, Gathered& g) const {
    const auto set = as_set(s.presence[i]);
    if (s.jump != nullptr) g.jump = s.jump[i];
    for (int m = 0; m < materials(); ++m) {
      const bool present = (set >> m & 1) != 0;
      g.share[m] = present ? s.share[m][i] : 0.0;
      g.conductivity[m] = 0.0;
      if (!present || !o_.conducts(m)) continue;
      g.conductivity[m] = o_.transport.conductivity_varies ? s.conductivity[m][i] : k(m);
      g.temperature[m] = s.temperature[m][i];
      if (s.mass[m] != nullptr) g.density[m] = s.mass[m][i] / s.share[m][i];
      // The little that limits no step keeps half of what it has for the work that it does.
      const double kept = g.share[m] < min_limiting_share ? 0.5 : 1.0;
      g.most[m] = s.capacity[m][i] * bound * kept;
    }
  }

  void contacts(const Row& row) const {
    const SideRows below = side(row, -1), above = side(row, 0);
    double given[max_materials], taken[max_materials];
    const Flows flows = this->flows(row);
    const double most = bound(row), inverse = 1.0 / dx(row);
    std::fill_n(flows.flux, row.count(), 0.0);
    for (int m = 0; m < materials(); ++m)
      touch_itself(row.count(), m, {below, above, flows, most, inverse});
    Gathered low, high;
    for (int i = 0; i < row.count(); ++i) {
      if (!(flows.flux[i] > round_off)) {
        double sum = 0;
        for (int m = 0; m < materials(); ++m) sum += flows.given[m][i];
        flows.flux[i] = sum;
        continue;
      }
      gather(below, most, i, low);
      gather(above, most, i, high);
      contacts_.conduct(low.side(), high.side(), dx(row), given, taken);
      put(flows, i, given, taken);
    }
  }
  // Rows that are written.
  struct Flows {
    double *flux, *given[max_materials], *taken[max_materials];
  };
  Flows flows(const Row& row) const {
    Flows f;
    f.flux = row(h_.flux);
    for (int m = 0; m < materials(); ++m) {
      f.given[m] = row(h_.of_materials, 2 * m);
      f.taken[m] = row(h_.of_materials, 2 * m + 1);
    }
    return f;
  }
  struct Faces {
    const SideRows &below, &above;
    const Flows& flows;
    double most, inverse_dx;
  };
  // Contacts of a material with itself; how much its shares differ is added to `flux`.
  void touch_itself(int n, int m, const Faces& f) const {
    const double* __restrict sa = f.below.share[m];
    const double* __restrict sb = f.above.share[m];
    const double* __restrict Ta = f.below.temperature[m];
    const double* __restrict Tb = f.above.temperature[m];
    const double* __restrict Ca = f.below.capacity[m];
    const double* __restrict Cb = f.above.capacity[m];
    double* __restrict given = f.flows.given[m];
    double* __restrict taken = f.flows.taken[m];
    double* __restrict differ = f.flows.flux;
    const double inverse = f.inverse_dx;
    const auto mark_modified = [&](auto k_of) {  // conductivity of a face
#pragma GCC ivdep
      for (int i = 0; i < n; ++i) {
        const double common = smaller(sa[i], sb[i]);
        const double kept = f.most * (common < min_limiting_share ? 0.5 : 1.0);
        const double k_m = k_of(i);
        const double conductivity = smaller(k_m, kept * smaller(Ca[i], Cb[i]));
        const double q = common * (conductivity * ((Ta[i] - Tb[i]) * inverse));
        const bool conducts = common >= min_conducting_share && k_m > 0.0;
        given[i] = taken[i] = conducts ? q : 0.0;
        differ[i] += std::fabs(sa[i] - sb[i]);
      }
    };
    if (!o_.transport.conductivity_varies) return mark_modified([k_m = k(m)](int) { return k_m; });
    mark_modified([ka = f.below.conductivity[m], kb = f.above.conductivity[m]](int i) {
      return harmonic_mean(ka[i], kb[i]);
    });
  }
  void put(const Flows& to, int i, const double* given, const double* taken) const {
    double out = 0, in = 0;
    for (int m = 0; m < materials(); ++m) {
      to.given[m][i] = given[m];
      to.taken[m][i] = taken[m];
      out += given[m];
      in += taken[m];
    }
    to.flux[i] = 0.5 * (out + in);  // the same to round-off; of a mirror image to the bit
  }

  void walls(const Row& row) const {
    const double length = dx(row), inverse = 1.0 / length;
    for_each_wall_face(row, o_, axis_, [&](int i, bool plus) {
      IntVec3 cell = row.cell();
      cell[o_.grid.axes.direction[0]] += i;
      const SideRows inside = side(row, plus ? -1 : 0);
      const auto set = as_set(inside.presence[i]);
      Gathered g;
      gather(inside, bound(row), i, g);
      double q[max_materials];
      for (int m = 0; m < materials(); ++m) {
        q[m] = 0.0;
        if ((set >> m & 1) == 0 || !(k(m) > 0.0)) continue;
        const WallHeat& wall =
            o_.grid.boundary->wall_heat(side_of(o_.grid.axes.direction[axis_], plus), cell, m);
        const bool alone = is_single(static_cast<double>(set));
        const double k_m = conductivity_on_wall(row, m, i);
        const double conductivity = alone ? k_m : smaller(k_m, g.most[m]);
        const double outward =
            g.share[m] * heat_to_wall(wall, conductivity, g.temperature[m], length, inverse);
        q[m] = plus ? outward : -outward;
      }
      put(flows(row), i, q, q);
    });
  }

  // Subgrid motion ends at walls.
  double conductivity_on_wall(const Row& row, int m, int i) const {
    if (!is_mixed(o_, m)) return k(m);
    return harmonic_mean(row(h_.conductivity, m, axis_, -1)[i], row(h_.conductivity, m)[i]);
  }

  SchemeOptions o_;
  Handles h_;
  int axis_;
  HeatContacts contacts_;
};

}  // namespace

void add_heat_flux(TaskList& list, const HeatFluxInput& v, const SchemeOptions& o, int effect) {
  if (!o.transport.conducting) return;
  add_temperatures(list, v, o, effect);
  static const char* names[] = {"heat through contacts on axis 0",
                                "heat through contacts on axis 1",
                                "heat through contacts on axis 2"};
  for (int axis = 0; axis < o.grid.axes.count; ++axis) {
    TaskBuilder task = list.task(names[axis], effect);
    const Stencil both = Stencil::along(o.grid.axes.direction[axis], 1, 0);
    Handles h;
    h.presence = task.read(v.presence, both);
    h.pure = task.read(v.pure, both);
    h.temperature = task.read(v.temperature, both);
    h.capacity = task.read(v.heat_capacity, both);
    if (o.materials.multi_velocity_exchange) h.surface = task.read(v.surface, both);
    if (o.transport.conductivity_varies) h.conductivity = task.read(v.conductivity, both);
    for (const VariableId volume : v.state.volume) h.volume.push_back(task.read(volume, both));
    for (std::size_t m = 0; m < v.state.mass.size() && o.materials.heat_exchange.varies(); ++m)
      h.mass.push_back(task.read(v.state.mass[m], both));
    h.flux = task.write(v.heat_flux[axis]);
    h.of_materials = task.write(v.of_materials[axis]);
    task.kernel([heat = FaceHeat(o, h, axis)](const Row& row) { heat.run(row); });
  }
}

}  // namespace sluice::ice::mixture
