// Step 8 with several materials: which volume, mass and energy of each pass a face.
//
// Where a face lies between two cells of pure neighbourhood, the rows of one material
// (one_material/remap_flux_rows.hpp); elsewhere, with the donor's values, H = l u_f, nu = |H|/J,
// s = sign(H), N the outflow Courant number, B = 2/max(N,.05):
//   1. theta_m = V_m + s (1-nu)/2 S, S = sign min(B |dm|, 2 |dp|) (0 at extrema) near an interface,
//      where one of five cells has V_m < .01 or > .99, else Q3(dm, dp; nu, B);
//      0 <= theta_m <= min(1, V_m/max(N,1e-12)): never more than the cell holds
//   2. sum_m theta_m = 1: divided by the sum where it is more, filled up to the caps where less
//   3. traces: what would enter a cell without the material below 1e-16 stays (1e-2 of the most
//      around, where that is less); where the face is the donor's only outlet and would leave a
//      trace, it takes all, to the bit; a front waits for its donor to be filled, the last cell of
//      a trail leaves as densely as what goes ahead (face_shares.cpp)
//   4. rho_m = rho_mL + s (1-nu)/2 Q3(D rho_m; B)/J, eps_m likewise with bound 2, differences only
//      where V_m > 1e-10 in donor, upwind and downwind cell; both bounded by the share
//      phi = N theta_m/V_m of the material that leaves: q = (1-phi)/max(phi,.05),
//      |rho_m/rho_mL - 1| <= min(.9, .5 q), |eps_m - eps_mL| <= min(.9, .5 q) (p_m + pi_m)/G_m
//      A gas that is a mixture has rho_mL and eps_mL where its fraction is not the same around:
//      with the donor's fraction they keep pressure and temperature.
//   5. FV = H theta, FM = FV rho_m (rounded: whole_masses.hpp), FE = FV eps_m; F = sum FM; U, f, K
//      of the mixture as for one material with its energy scale; G_m = FE + FM K, G = sum G_m.
#include <algorithm>

#include "ice/mixture/face_donors.hpp"
#include "ice/mixture/tasks.hpp"
#include "ice/one_material/remap_flux_rows.hpp"
#include "ice/step/laws_of_cells.hpp"
#include "ice/step/material_runs.hpp"
#include "ice/step/remap_bounds.hpp"

namespace sluice::ice::mixture {
namespace {

struct Handles {
  RemapFluxHandles common;
  MaterialHandles materials;
  In pure;
  Out flux;  // of each material
};

constexpr int of_mixed_gas = 2;  // beside 0 and 1 of other ideal gases and of further laws

// Faces beside cells that are not of pure neighbourhood; rows are looked up once for all of them.
template <int D, int C>
class MixedFaces {
 public:
  MixedFaces(const Row& row, const Handles& h, const SchemeOptions& o, int axis, double l)
      : materials_(row, h.common, h.materials, h.flux, o, axis, l),
        second_(o.scheme.second_order),
        masked_(o.scheme.masked),
        l_(l) {
    const auto cells = [&](In in, int c = 0) { return pair_of(row, in, c, axis); };
    const bool based = o.scheme.second_order && D > 1;
    w_ = cells(h.common.inverse_rho);
    rho_L_ = cells(h.common.rho_L);
    scale_ = cells(h.common.energy_scale);
    if (o.scheme.masked) mask_ = cells(h.common.mask);
    for (int c = 0; c < C; ++c) {
      if (o.scheme.second_order) V_[c] = around(row, h.common.velocity, c, axis);
      v_[c] = cells(h.common.velocity_L, c);
      base_[c] = based ? cells(h.common.base, 2 + c) : v_[c];
      U_[c] = row(h.common.flux, 2 + c);
    }
    uf_ = row(h.common.face_velocity);
    F_ = row(h.common.flux, 0);
    G_ = row(h.common.flux, 1);
  }

  // Up to `most` faces from `first` on are there; those beyond `count` keep what they have.
  void run(int first, int count, int most) {
    constexpr int vector = 8;  // what whole_vectors adds at most, and rows have beyond their end
    const int whole = whole_vectors(count, most), beyond = first + count;
    double kept[2 + C][vector];
    for (int r = 0; r < 2 + C; ++r) std::copy_n(total_row(r) + beyond, vector, kept[r]);
    run_chunks(first, whole);
    for (int r = 0; r < 2 + C; ++r) std::copy_n(kept[r], vector, total_row(r) + beyond);
  }

 private:
  double* total_row(int r) const { return r == 0 ? F_ : r == 1 ? G_ : U_[r - 2]; }

  void run_chunks(int first, int count) {
    constexpr int most = MaterialFaces::max_faces;
    for (int done = 0; done < count; done += most) {
      const int some = std::min(most, count - done);
      const std::uint64_t set = materials_.carry(first + done, some);
      if (!second_)
        total_of<false, false>(first + done, some, set);
      else if (masked_)
        total_of<true, true>(first + done, some, set);
      else
        total_of<true, false>(first + done, some, set);
    }
  }

  // Rows of the mixture, and the velocity with which it passes.
  template <bool Second, bool Masked>
  struct Mixture {
    Pair w, rho_L, scale, mask;
    Around V[C];
    Pair v[C], base[C];
    double* U[C];

    Mixture(const MixedFaces& faces, int first)
        : w(faces.w_.from(first)),
          rho_L(faces.rho_L_.from(first)),
          scale(faces.scale_.from(first)),
          mask(Masked ? faces.mask_.from(first) : w) {
      for (int c = 0; c < C; ++c) {
        if (Second) V[c] = faces.V_[c].from(first);
        v[c] = faces.v_[c].from(first);
        base[c] = faces.base_[c].from(first);
        U[c] = faces.U_[c] + first;
      }
    }

    // Writes U where the mass `flow` passes; the correction K of the kinetic energy.
    [[gnu::always_inline]] double carry(int i, bool left, double flow) const {
      const double f = smaller(std::fabs(flow) * w.at(i, left), max_mass_passing);
      const double m = Masked ? mask.at(i, left) : 1.0;
      double d2 = 0, carried = 0;
#pragma GCC unroll 3
      for (int c = 0; c < C; ++c) {
        const double before = v[c].at(i, left);
        double u = base[c].at(i, left);
        if constexpr (Second)
          u += (left ? -0.5 : 0.5) * (1.0 - f) * m * donor_slope(V[c], i, left, f, 2.0);
        U[c][i] = u;
        (c < D ? d2 : carried) += (u - before) * (u - before);
      }
      if constexpr (C > D) d2 += carried;
      const double rL = rho_L.at(i, left);
      return -0.5 * (d2 * d2 * rL) / ((1.0 - f) * (d2 * rL + 0.25 * scale.at(i, left)));
    }
  };

  // Total mass and energy flux. N: materials of which something may pass, 0: more; their energy
  // fluxes get their parts of K.
  template <int N, bool Second, bool Masked>
  void total(int first, int n, std::uint64_t set) {
    const double* FM[N > 0 ? N : max_materials];
    double* FE[N > 0 ? N : max_materials];
    int count = 0;
    for_each_of(set, [&](int m) {
      FM[count] = materials_.flux(m, of_mass) + first;
      FE[count++] = materials_.flux(m, of_energy) + first;
    });
    if constexpr (N > 0) count = N;
    double* F = F_ + first;
    double* G = G_ + first;
    const double l = l_;
    const double* uf = uf_ + first;
    const Mixture<Second, Masked> mixture(*this, first);
#pragma GCC ivdep
    for (int i = 0; i < n; ++i) {
      double flow = 0, sum = 0;
#pragma GCC unroll 3
      for (int k = 0; k < count; ++k) flow += FM[k][i];
      F[i] = flow;
      const double K = mixture.carry(i, l * uf[i] < 0.0, flow);
#pragma GCC unroll 3
      for (int k = 0; k < count; ++k) {
        const double energy = FE[k][i] + FM[k][i] * K;
        FE[k][i] = energy;
        sum += energy;
      }
      G[i] = sum;
    }
  }

  template <bool Second, bool Masked>
  void total_of(int first, int n, std::uint64_t set) {
    switch (std::popcount(set)) {
      case 1:
        return total<1, Second, Masked>(first, n, set);
      case 2:
        return total<2, Second, Masked>(first, n, set);
      case 3:
        return total<3, Second, Masked>(first, n, set);
      default:
        return total<0, Second, Masked>(first, n, set);
    }
  }

  MaterialFaces materials_;
  bool second_, masked_;
  double l_;
  const double* uf_;
  Pair w_, rho_L_, scale_, mask_{};
  Around V_[C];
  Pair v_[C], base_[C];
  double *F_, *G_, *U_[C];
};

}  // namespace

void add_remap_fluxes(TaskList& list, const RemapFluxInput& v, const SchemeOptions& o, int effect) {
  for (int axis = 0; axis < o.grid.axes.count; ++axis) add_remap_flux(list, v, o, effect, axis);
}

void add_remap_flux(TaskList& list, const RemapFluxInput& v, const SchemeOptions& o, int effect,
                    int axis) {
  static const char* names[] = {"remap along axis 0", "remap along axis 1", "remap along axis 2"};
  const int direction = o.grid.axes.direction[axis];
  TaskBuilder task = list.task(names[axis], effect);
  Handles h;
  h.common = read_remap_inputs(task, v.mixture, o, axis);
  h.common.flux = task.write(v.mixture.flux[axis]);
  h.materials = read_materials(task, v.materials, o, axis);
  read_blends(task, v.blend, axis, o, h.materials);
  h.pure = task.read(v.materials.pure, Stencil::along(direction, 1, 0));
  h.flux = task.write(v.flux[axis]);
  dispatch(o.grid.axes.count, o.grid.components, [&]<int D, int C>() {
    task.kernel([=](const Row& row) {
      const double l = row.step().dt / row.step().spacing[direction];
      const auto runs = [&](auto&& f) {
        for_each_face_run(runs_of(row, h.pure, axis, -1), runs_of(row, h.pure), row.count(), f);
      };
      const auto kind = [&](std::size_t m) {
        return is_mixed(o, m) ? of_mixed_gas : int{o.materials.fluids[m].gamma_law() == nullptr};
      };
      const auto pure_faces = [&](int first, int count, int of) {
        const Row part = row.part(first, count);
        const RemapLaw law = of == of_mixed_gas ? RemapLaw::ideal_by_energy
                             : of != 0          ? RemapLaw::scaled
                                                : RemapLaw::ideal;
        flux_row_of<D, C>(part, h.common, axis, l, o, law);
      };
      if (!for_each_pure_piece(runs, kind, pure_faces)) return;
      // Only now: room for so many materials, even in an optional, is 9 kB to clear in every row.
      MixedFaces<D, C> mixed(row, h, o, axis, l);
      runs([&](int first, int count, double pure) {
        if (pure < 0) mixed.run(first, count, row.count() - first);
      });
    });
  });
}

}  // namespace sluice::ice::mixture
