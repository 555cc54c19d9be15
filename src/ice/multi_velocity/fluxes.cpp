// Step 8 with velocities of their own: each material passes with its own, from its own donor.
//
//   H_m = l theta_m u_fm, the rest of it as in face_shares.cpp with the material's own Courant
//   number nu_m = l |u_fm|/J and outflow number N_m. With V_m of the donors sum H_m = l u_f; what
//   theta_m adds to that is cut, on the side that is more, so that it sums to zero.
//   U_m = base + s (1-f)/2 Q3(D u_m; f, 2), f = |F_m|/M_m, u_m the mixture's where m is absent
// Fluxes of the mixture: F = sum F_m, G = sum G_m; as velocity that of the largest |F_m|, which is
// the mixture's where one material passes.
#include <algorithm>
#include <cmath>

#include "framework/refine/coverage.hpp"
#include "ice/closure/interface_band.hpp"
#include "ice/mixture/face_donors.hpp"
#include "ice/mixture/trace_rules.hpp"
#include "ice/multi_velocity/tasks.hpp"
#include "ice/one_material/remap_flux_rows.hpp"
#include "ice/step/material_runs.hpp"
#include "ice/step/remap_bounds.hpp"

namespace sluice::ice::mixture {
namespace {

// threshold: smallest share of a donor's mass that counts as left in the correction of its kinetic
//   energy; unit: 1; test: none
constexpr double min_mass_left = 0.01;

struct Handles {
  RemapFluxHandles common;
  MaterialHandles materials;
  In pure, velocity, velocity_L, base, face_velocity, outflow;
  Out flux, material_velocity;
};

double sharp_slope(double dm, double dp, double B) {
  const double bound = smaller(B * std::fabs(dm), 2.0 * std::fabs(dp));
  return dm * dp > 0.0 ? std::copysign(bound, dm) : 0.0;
}

// One material at one face; the donor is the low cell (shift -1) or the high one (0).
struct Passing {
  int index = 0, donor = -1;
  double V = 0, M = 0;   // of the donor
  double flow = 0;       // l u_fm
  double N = 0, iN = 0;  // outflow of the donor
  double outlet = 0;     // its main one
  double cap = 0;        // of theta
  double H = 0;          // volume
  bool all = false;      // all of the donor's passes
  double FM = 0;
};

template <int D, int C>
class Faces {
 public:
  Faces(const Row& row, const Handles& h, const SchemeOptions& o, int axis)
      : row_(row),
        h_(h),
        o_(o),
        axis_(axis),
        materials_(static_cast<int>(h.materials.mass.size())),
        l_(row.step().dt / row.step().spacing[o.grid.axes.direction[axis]]),
        based_(o.scheme.second_order && D > 1) {}

  void run() {
    for (int i = 0; i < row_.count(); ++i) face(i);
  }

 private:
  double cell(In in, int c, int shift, int i) const { return row_(in, c, axis_, shift)[i]; }
  double volume(int m, int shift, int i) const { return cell(h_.materials.volume[m], 0, shift, i); }
  double mass(int m, int shift, int i) const { return cell(h_.materials.mass[m], 0, shift, i); }
  double mask(int shift, int i) const {
    return o_.scheme.masked ? cell(h_.common.mask, 0, shift, i) : 1.0;
  }
  double sign(const Passing& k) const { return k.donor == 0 ? -0.5 : 0.5; }

  void face(int i) {
    const double wanted = l_ * row_(h_.common.face_velocity)[i];
    Passing passing[max_materials];
    int count = 0;
    for (int m = 0; m < materials_; ++m) {
      for (int q = 0; q < 3; ++q) row_(h_.flux, component(m, static_cast<Carried>(q)))[i] = 0.0;
      for (int c = 0; c < C; ++c) row_(h_.material_velocity, m * C + c)[i] = 0.0;
      Passing k;
      k.index = m;
      k.flow = l_ * row_(h_.face_velocity, m)[i];
      k.donor = k.flow < 0.0 ? 0 : -1;
      k.V = volume(m, k.donor, i);
      k.M = mass(m, k.donor, i);
      if (k.M != 0.0) passing[count++] = k;
    }
    share_volume(passing, count, wanted, i);
    double F = 0, G = 0;
    const Passing* largest = nullptr;
    for (int n = 0; n < count; ++n) {
      Passing& k = passing[n];
      if (k.H == 0.0) continue;
      carry(k, i);
      F += k.FM;
      G += row_(h_.flux, component(k.index, of_energy))[i];
      if (largest == nullptr || std::fabs(k.FM) > std::fabs(largest->FM)) largest = &k;
    }
    row_(h_.common.flux, 0)[i] = F;
    row_(h_.common.flux, 1)[i] = G;
    for (int c = 0; c < C; ++c)
      row_(h_.common.flux, 2 + c)[i] =
          largest != nullptr ? row_(h_.material_velocity, largest->index * C + c)[i] : 0.0;
  }

  // H of each: with the volume fractions of the donors, and what theta adds as far as it sums to
  // zero; then the rules of traces; the largest takes the rest.
  void share_volume(Passing* passing, int count, double wanted, int i) {
    double extra[max_materials], sum = 0;
    for (int n = 0; n < count; ++n) {
      Passing& k = passing[n];
      const bool pure = cell(h_.pure, 0, k.donor, i) >= 0.0;
      k.N = pure ? cell(h_.common.courant, 0, k.donor, i) : cell(h_.outflow, k.index, k.donor, i);
      k.iN = 1.0 / larger(k.N, min_outflow);
      k.outlet = pure ? 0.0 : cell(h_.outflow, materials_ + k.index, k.donor, i);
      k.H = k.flow * k.V;
      k.cap = waits(k, i) ? 0.0 : smaller(1.0, k.V / larger(k.N, no_outflow));
      extra[n] = k.flow * (theta(k, i) - k.V);
      sum += extra[n];
    }
    balance(passing, count, sum, extra);
    for (int n = 0; n < count; ++n)
      passing[n].H = passing[n].cap > 0.0 ? passing[n].H + extra[n] : 0.0;
    for (int n = 0; n < count; ++n) keep_trace_together(passing[n], i);
    int largest = -1;
    for (int n = 0; n < count; ++n)
      if (largest < 0 || std::fabs(passing[n].H) > std::fabs(passing[largest].H)) largest = n;
    if (largest < 0 || passing[largest].all || passing[largest].flow == 0.0) return;
    double others = 0;
    for (int n = 0; n < count; ++n) others += n == largest ? 0.0 : passing[n].H;
    passing[largest].H = wanted - others;
  }

  // Makes the sum of `extra` zero: flows along what lacks are filled up to their bounds; what then
  // is too much the other way is cut. Those that wait stay where they are.
  static void balance(const Passing* passing, int count, double sum, double* extra) {
    double rooms[max_materials], room = 0;
    for (int n = 0; n < count; ++n) {
      const Passing& k = passing[n];
      const double most = k.flow * (k.cap - k.V) - extra[n];
      rooms[n] = most * sum < 0.0 && k.flow * sum < 0.0 ? most : 0.0;
      room += rooms[n];
    }
    const double fill = room != 0.0 ? smaller(1.0, -sum / room) : 0.0;
    double left = 0, against = 0;
    for (int n = 0; n < count; ++n) left += extra[n] += fill * rooms[n];
    for (int n = 0; n < count; ++n)
      against += passing[n].cap > 0.0 && extra[n] * left > 0.0 ? extra[n] : 0.0;
    const double kept = against != 0.0 ? larger(0.0, 1.0 - left / against) : 1.0;
    for (int n = 0; n < count; ++n)
      if (passing[n].cap > 0.0 && extra[n] * left > 0.0) extra[n] *= kept;
  }

  // Where a cell has none of a material: until the donor is filled. Tiny amounts: at all but the
  // main outlet. Little of it that leaves the cells under a finer level: that level brings it. If
  // the others can make up the outflow.
  bool waits(const Passing& k, int i) const {
    const double behind = volume(k.index, k.donor == 0 ? 1 : -2, i);
    const bool unfilled = mass(k.index, k.donor == 0 ? -1 : 0, i) == 0.0 && k.V < min_fill * behind;
    const bool aside = k.V < tiny && k.outlet < 0.0 && -k.outlet > std::fabs(k.flow);
    return (unfilled || aside || leaves_cover(k, i)) && 1.0 - k.V >= k.N;
  }

  // Cells under a finer level are its averages, so that a front in them is wider than there. What
  // it sent ahead of itself would be taken back when fluxes are matched; by then the finer level,
  // whose ghost cells have seen it, may hold part of it: more than the cell could give back.
  bool leaves_cover(const Passing& k, int i) const {
    if (k.V >= interface_band || o_.budgets.coverage == nullptr || !o_.budgets.coverage->any())
      return false;
    IntVec3 donor = row_.cell();
    donor[o_.grid.axes.direction[0]] += i;
    IntVec3 receiver = donor;
    (k.donor == 0 ? receiver : donor)[o_.grid.axes.direction[axis_]] -= 1;
    return o_.budgets.coverage->is_covered_around(row_.box(), donor) &&
           !o_.budgets.coverage->is_covered_around(row_.box(), receiver);
  }

  double theta(const Passing& k, int i) const {
    const int m = k.index;
    const bool left = k.donor == 0;
    double value = based_ ? cell(h_.materials.base, component(m, of_volume), k.donor, i) : k.V;
    if (o_.scheme.second_order) {
      const double V[6] = {volume(m, -3, i), volume(m, -2, i), volume(m, -1, i),
                           volume(m, 0, i),  volume(m, 1, i),  volume(m, 2, i)};
      const double dm = left ? V[4] - V[3] : V[2] - V[1], dp = V[3] - V[2];
      const double nu = std::fabs(k.flow) * cell(h_.common.inverse_J, 0, k.donor, i);
      const double B = 2.0 * k.iN;
      const auto [least, most] = std::minmax_element(V + (left ? 1 : 0), V + (left ? 6 : 5));
      const bool interface = *least < interface_band || *most > 1.0 - interface_band;
      const double slope = interface ? sharp_slope(dm, dp, B) : upwind_slope(dm, dp, nu, B);
      value += sign(k) * larger(1.0 - nu, 0.0) * mask(k.donor, i) * slope;
    }
    return smaller(larger(value, 0.0), k.cap);
  }

  void keep_trace_together(Passing& k, int i) const {
    if (k.V == 1.0) return;  // the donor has one material
    const double receiver = mass(k.index, k.donor == 0 ? -1 : 0, i);
    if (receiver == 0.0 && std::fabs(k.H) < min_entry) k.H = 0.0;
    const double V_L = k.V * cell(h_.materials.stretch, 0, k.donor, i);
    const double flow = std::fabs(k.flow);
    const bool only_outlet = k.outlet == flow || (k.V < tiny && k.outlet == -flow);
    if (k.H == 0.0 || !only_outlet) return;
    if (V_L - std::fabs(k.H) > larger(min_entry, min_rest * V_L)) return;
    k.H = std::copysign(V_L, k.H);
    k.all = true;
  }

  // Mass, energy and velocity of what passes; as in face_shares.cpp and remap_fluxes.cpp.
  void carry(Passing& k, int i) {
    const int m = k.index, at = k.donor;
    const MaterialHandles& x = h_.materials;
    const double iJ = cell(h_.common.inverse_J, 0, at, i);
    const double rho_L = per_volume(x.mass, m, at, i) * iJ;
    const double e_L = cell(x.specific_energy_L, m, at, i), sc = cell(x.scale, m, at, i);
    double rho = based_ ? cell(x.base, component(m, of_mass), at, i) : rho_L;
    double eps = based_ ? cell(x.base, component(m, of_energy), at, i) : e_L;
    const bool full = o_.scheme.second_order && volume(m, -1, i) > min_sloped &&
                      volume(m, 0, i) > min_sloped && volume(m, at == 0 ? 1 : -2, i) > min_sloped;
    if (full) {
      const double nu = std::fabs(k.flow) * iJ;
      const double weight = sign(k) * larger(1.0 - nu, 0.0) * iJ * mask(at, i);
      rho += weight * slope(x.mass, m, at, nu, 2.0 * k.iN, i);
      eps += weight * slope(x.energy, m, at, nu, 2.0, i);
    }
    const double share = k.H / k.flow;
    const double phi = k.N * share / k.V;
    const double q = smaller(face_drop, 0.5 * larger(0.0, 1.0 - phi) / larger(phi, min_outflow));
    const bool one = k.V == 1.0;
    const double N = smaller(k.N, 1.0);
    rho = smaller(larger(rho, rho_L * (one ? face_floor : 1.0 - q)),
                  rho_L * (one ? (density_gone + density_left * N) * k.iN : 1.0 + q));
    eps = smaller(larger(eps, e_L - (one ? face_drop : q) * sc),
                  e_L + (one ? (energy_gone + energy_left * N) * k.iN - 1.0 : q) * sc);
    k.FM = k.all ? std::copysign(k.M, k.H) : k.H * rho;
    const double energy_L = cell(x.energy_L, m, at, i);
    const double FE = k.all ? std::copysign(1.0, k.H) * energy_L : k.H * eps;
    row_(h_.flux, component(m, of_volume))[i] = k.H;
    row_(h_.flux, component(m, of_mass))[i] = k.FM;
    row_(h_.flux, component(m, of_energy))[i] = FE + k.FM * carry_velocity(k, rho_L, sc, i);
  }
  // What a material has per own volume.
  double per_volume(const std::vector<In>& state, int m, int shift, int i) const {
    return cell(state[m], 0, shift, i) * per_own_volume(volume(m, shift, i));
  }
  double slope(const std::vector<In>& state, int m, int at, double nu, double B, int i) const {
    const auto value = [&](int shift) { return per_volume(state, m, shift, i); };
    const double middle = value(0) - value(-1);
    return upwind_slope(at == 0 ? value(1) - value(0) : value(-1) - value(-2), middle, nu, B);
  }

  // U of a material; the correction of its kinetic energy, at most half of what the material holds:
  // what it loses on the way heats its donor.
  double carry_velocity(const Passing& k, double rho_L, double scale, int i) {
    const int m = k.index, at = k.donor;
    const bool pure = cell(h_.pure, 0, at, i) >= 0.0;
    const double f = k.all ? 1.0 : smaller(std::fabs(k.FM) / k.M, max_mass_passing);
    double d2 = 0, carried = 0;
    for (int c = 0; c < C; ++c) {
      const double before =
          cell(h_.common.velocity_L, c, at, i) + cell(h_.velocity_L, m * C + c, at, i);
      double U = before;
      if (based_) U = pure ? cell(h_.common.base, 2 + c, at, i) : cell(h_.base, m * C + c, at, i);
      if (o_.scheme.second_order) {
        const auto u = [&](int shift) { return cell(h_.velocity, m * C + c, shift, i); };
        const double dm = at == 0 ? u(1) - u(0) : u(-1) - u(-2);
        U += sign(k) * (1.0 - f) * mask(at, i) * upwind_slope(dm, u(0) - u(-1), f, 2.0);
      }
      row_(h_.material_velocity, m * C + c)[i] = U;
      (c < D ? d2 : carried) += (U - before) * (U - before);
    }
    d2 += carried;
    const double correction =
        -0.5 * (d2 * d2 * rho_L) / (larger(1.0 - f, min_mass_left) * (d2 * rho_L + 0.25 * scale));
    return larger(correction, -0.5 * scale / rho_L);
  }

  const Row& row_;
  const Handles& h_;
  const SchemeOptions& o_;
  int axis_, materials_;
  double l_;
  bool based_;
};

}  // namespace

void add_slip_fluxes(TaskList& list, const SlipFluxInput& v, const SchemeOptions& o, int effect) {
  for (int axis = 0; axis < o.grid.axes.count; ++axis) add_slip_flux(list, v, o, effect, axis);
}

void add_slip_flux(TaskList& list, const SlipFluxInput& v, const SchemeOptions& o, int effect,
                   int axis) {
  static const char* names[] = {"remap along axis 0", "remap along axis 1", "remap along axis 2"};
  const int direction = o.grid.axes.direction[axis];
  const Stencil both = Stencil::along(direction, 1, 0), four = Stencil::along(direction, 2, 1);
  TaskBuilder task = list.task(names[axis], effect);
  Handles h;
  h.common = read_remap_inputs(task, v.mixture, o, axis);
  h.common.flux = task.write(v.mixture.flux[axis]);
  h.materials = read_materials(task, v.materials, o, axis);
  h.pure = h.materials.pure;
  h.velocity = task.read(v.velocity, four);
  h.velocity_L = task.read(v.velocity_L, both);
  if (o.scheme.second_order && o.grid.axes.count > 1) h.base = task.read(v.base[axis], both);
  h.face_velocity = task.read(v.face_velocity[axis]);
  h.outflow = task.read(v.outflow, both);
  h.flux = task.write(v.flux[axis]);
  h.material_velocity = task.write(v.material_velocity[axis]);
  dispatch(o.grid.axes.count, o.grid.components, [&]<int D, int C>() {
    task.kernel([=](const Row& row) {
      const double l = row.step().dt / row.step().spacing[direction];
      for_each_face_run(runs_of(row, h.pure, axis, -1), runs_of(row, h.pure), row.count(),
                        [&](int first, int count, double pure) {
                          const Row part = row.part(first, count);
                          if (pure < 0) return Faces<D, C>(part, h, o, axis).run();
                          const auto m = static_cast<std::size_t>(pure);
                          const bool ideal = o.materials.fluids[m].gamma_law() != nullptr;
                          flux_row_of<D, C>(part, h.common, axis, l, o,
                                            ideal ? RemapLaw::ideal : RemapLaw::scaled);
                        });
    });
  });
}

}  // namespace sluice::ice::mixture
