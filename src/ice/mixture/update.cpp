// Step 9 with several materials: new masses, volumes and energies; one pressure; rates.
//
//   M_m' = M_m + sum_d (FM- - FM+)     V_m' = V_m J r_m + sum_d (FV- - FV+)   (r_m: lagrangian.cpp)
//   E_m' = E_mL + sum_d (G_m- - G_m+) + k M_m'/rho'
//   k = sum_d (F- |U- - v|^2 - F+ |U+ - v|^2)/2 - rho' |m'/rho' - v|^2/2
// the kinetic energy that the remap loses goes to the materials by mass. A material that ended with
// no mass is gone: what is left of its energy goes into k. Then sources act (sources/sources.hpp),
// then one pressure and heat between the materials (cell_closure.hpp).
// Cells of pure neighbourhood run the rows of one material. With a gas that is a mixture one
// pressure waits for its new fraction: one_pressure.cpp.
#include <algorithm>

#include "ice/closure/cell_closure.hpp"
#include "ice/closure/ideal_relaxation.hpp"
#include "ice/closure/traces.hpp"
#include "ice/mixture/diffusion_rates.hpp"
#include "ice/mixture/tasks.hpp"
#include "ice/mixture/touched_update.hpp"
#include "ice/one_material/update_rows.hpp"
#include "ice/step/material_runs.hpp"

namespace sluice::ice::mixture {
namespace {

// What finds the pressure of a cell.
struct Laws {
  CellClosure closure;
  IdealRelaxation ideal;
};

// Cells that are not of pure neighbourhood; rows are looked up once for all of them. Here is what
// needs no momentum: made once for all counts of components.
template <int D>
class MaterialCells {
 public:
  MaterialCells(const Row& row, const UpdateState& h, const SchemeOptions& o, const Laws& laws)
      : row_(row),
        h_(h),
        o_(o),
        laws_(laws),
        materials_(static_cast<int>(h.state.size())),
        J_(row(h.stretch, 0)),
        iJ_(row(h.common.inverse_J)),
        density_(row(h.end, 0)),
        modulus_(row(h.end, 1)) {
    if (h.closes) pressure_ = row(h.pressure);
    for (int m = 0; m < materials_; ++m) {
      const MaterialState& s = h.state[m];
      Material& k = rows_[m];
      k.M = row(s.mass);
      k.V = row(s.volume);
      k.E_L = row(h.energy_L, m);
      k.strain = h.strain.index < 0 ? nullptr : row(h.strain, m);
      k.next[of_volume] = row(s.volume_new);
      k.next[of_mass] = row(s.mass_new);
      k.next[of_energy] = row(s.energy_new);
      for (const Carried q : {of_volume, of_mass, of_energy})
        for (int d = 0; d < D; ++d) {
          const In flux = h.flux[d];
          k.minus[q][d] = row(flux, component(m, q));
          k.plus[q][d] = row(flux, component(m, q), d, 1);
        }
    }
  }

  // Up to `room` cells from `first` on are there; those beyond `count` get any state.
  // `move`(first, n): the momentum of the mixture, and the energy k that it loses in `modulus`.
  template <class Move>
  void run(int first, int count, int room, Move&& move) {
    constexpr int most = IdealRelaxation::max_cells;
    const int all = o_.forces.sources == nullptr ? whole_vectors(count, room) : count;
    if (h_.closes) mark_alone(row_.part(first, all), -1);
    for (int done = 0; done < count; done += most) {
      const int some = std::min(most, count - done), whole = std::min(most, all - done);
      remap_materials(first + done, whole);
      move(first + done, whole);
      share_defect(first + done, whole);
      if (o_.forces.sources != nullptr) add_sources(row_.part(first + done, some), h_, o_);
      if (!h_.closes) continue;
      repeat_first(first + done, some, whole);
      find_pressure(first + done, some, whole);
    }
  }
  // Before the cells between: the new state is not in the cache.
  void ask_for_state(int first, int count) const {
    for (int m = 0; m < materials_; ++m)
      for (const double* next : rows_[m].next) ask_for(next + first, count);
  }
  // Of cells whose new state is there but for that.
  void relax(int first, int count) {
    constexpr int most = IdealRelaxation::max_cells;
    for (int done = 0; done < count; done += most)
      find_pressure(first + done, std::min(most, count - done), std::min(most, count - done));
  }

 private:
  struct Material {
    const double *M, *V, *E_L;  // old; after the Lagrangian phase
    const double* strain;       // r_m = V_mL/(V_m J), or null: 1
    const double *minus[3][D], *plus[3][D];
    double* next[3];
  };

  // Mass, volume and energy of each material after the remap, without k, and the density. A loop
  // for each: together they have more rows than there are registers for.
  [[gnu::noinline]] void remap_materials(int first, int n) const {
    const double* __restrict J = J_ + first;
    for (int m = 0; m < materials_; ++m) {
      const Material& k = rows_[m];
      const double* __restrict V = k.V + first;
      const double* __restrict M = k.M + first;
      const double* __restrict E_L = k.E_L + first;
      if (k.strain == nullptr) {
        gain(k, of_volume, first, n, [=](int i) { return V[i] * J[i]; });
      } else {
        const double* __restrict r = k.strain + first;
        gain(k, of_volume, first, n, [=](int i) { return V[i] * J[i] * r[i]; });
      }
      gain(k, of_mass, first, n, [=](int i) { return M[i]; });
      gain(k, of_energy, first, n, [=](int i) { return E_L[i]; });
    }
    double* __restrict density = density_ + first;
    for (int m = 0; m < materials_; ++m) {
      const double* __restrict M = rows_[m].next[of_mass] + first;
#pragma GCC ivdep
      for (int i = 0; i < n; ++i) density[i] = (m == 0 ? 0.0 : density[i]) + M[i];
    }
  }

  // `kept`(i): what cell `first` + i has without what passes its faces.
  template <class Kept>
  static void gain(const Material& k, Carried q, int first, int n, Kept kept) {
    const double *minus[D], *plus[D];
    for (int d = 0; d < D; ++d) {
      minus[d] = k.minus[q][d] + first;
      plus[d] = k.plus[q][d] + first;
    }
    double* __restrict next = k.next[q] + first;
#pragma GCC ivdep
    for (int i = 0; i < n; ++i) {
      double sum = 0;
      for (int d = 0; d < D; ++d) sum += minus[d][i] - plus[d][i];
      next[i] = kept(i) + sum;
    }
  }

  // k by mass, with what materials leave that are gone.
  [[gnu::noinline]] void share_defect(int first, int n) const {
    for (int m = 0; m < materials_; ++m)
      drains(rows_[m], first, n) ? take_gone<true>(rows_[m], first, n)
                                 : take_gone<false>(rows_[m], first, n);
    double* __restrict defect = modulus_ + first;
    const double* __restrict density = density_ + first;
#pragma GCC ivdep
    for (int i = 0; i < n; ++i) defect[i] = defect[i] / density[i];
    for (int m = 0; m < materials_; ++m) {
      const double* __restrict M = rows_[m].next[of_mass] + first;
      double* __restrict E = rows_[m].next[of_energy] + first;
#pragma GCC ivdep
      for (int i = 0; i < n; ++i) E[i] += defect[i] * M[i];
    }
  }

  // May some cell be drained of a material (drained_residue).
  static bool drains(const Material& k, int first, int n) {
    const double* __restrict M_before = k.M + first;
    const double* __restrict M = k.next[of_mass] + first;
    int some = 0;
#pragma GCC ivdep
    for (int i = 0; i < n; ++i) some |= int{M[i] < 2.0 * drained * M_before[i]};
    return some != 0;
  }

  // Where nothing of a material is left, all of it goes.
  template <bool Drained>
  void take_gone(const Material& k, int first, int n) const {
    const double* __restrict M_before = k.M + first;
    const double* __restrict V_before = k.V + first;
    const double* __restrict E_L = k.E_L + first;
    const double* __restrict J = J_ + first;
    const double* r = k.strain == nullptr ? nullptr : k.strain + first;
    double* __restrict defect = modulus_ + first;
    double* __restrict M = k.next[of_mass] + first;
    double* __restrict V = k.next[of_volume] + first;
    double* __restrict E = k.next[of_energy] + first;
    // Apart: in one loop the choices would become branches.
#pragma GCC ivdep
    for (int i = 0; i < n; ++i) M[i] = vapour_kept(M[i], V[i]);
#pragma GCC ivdep
    for (int i = 0; i < n; ++i) {
      const double volume = V[i], energy = E[i], mass = M[i];
      const bool gone = is_gone(mass, volume, M_before[i], V_before[i]);
      Residue rest{volume, energy};
      if constexpr (Drained) {
        const double V_L = r == nullptr ? V_before[i] * J[i] : V_before[i] * J[i] * r[i];
        rest = drained_residue(mass, volume, energy, M_before[i], V_L, E_L[i]);
      }
      defect[i] += gone ? energy : energy - rest.E;
      M[i] = gone ? 0.0 : mass;
      V[i] = gone ? 0.0 : rest.V;
      E[i] = gone ? 0.0 : rest.E;
    }
  }

  // What nobody asked for might not be the state of a gas.
  [[gnu::noinline]] void repeat_first(int first, int n, int whole) const {
    for (int m = 0; m < materials_; ++m)
      for (double* next : rows_[m].next) {
        double* __restrict to = next + first;
        const double value = to[0];
#pragma GCC ivdep
        for (int i = 0; i < whole; ++i) to[i] = i < n ? to[i] : value;
      }
  }

  // In `whole` cells, of which `n` are asked for.
  [[gnu::noinline]] void find_pressure(int first, int n, int whole) {
    if (laws_.ideal.applies() && !laws_.closure.exchanges_heat() && is_sound(first, n, whole)) {
      GasRows gases[max_materials];
      for (int m = 0; m < materials_; ++m) {
        double* const* next = rows_[m].next;
        gases[m] = {next[of_mass] + first, next[of_volume] + first, next[of_energy] + first};
      }
      if (laws_.ideal.relax(whole, gases, pressure_ + first, modulus_ + first)) return;
    }
    const ClosingCells cells(row_, h_, o_);
    for (int i = first; i < first + n; ++i) cells.close(i, laws_.closure);
  }

  bool is_sound(int first, int n, int whole) const {
    const double *density = density_ + first, *iJ = iJ_ + first;
    int sound = 1;
#pragma GCC ivdep
    for (int i = 0; i < whole; ++i)
      sound &= int{i >= n} | (int{density[i] > 0.0} & int{density[i] < infinity} &
                              int{iJ[i] > 0.0} & int{iJ[i] < infinity});
    return sound != 0;
  }

  const Row& row_;
  const UpdateState& h_;
  const SchemeOptions& o_;
  const Laws& laws_;
  int materials_;
  const double *J_, *iJ_;
  double *density_, *modulus_, *pressure_ = nullptr;
  Material rows_[max_materials];
};

template <int D, int C>
class MixedCells : public MaterialCells<D> {
 public:
  MixedCells(const Row& row, const UpdateState& h, const SchemeOptions& o, const Laws& laws)
      : MaterialCells<D>(row, h, o, laws),
        motion_(row, h.common),
        density_(row(h.end, 0)),
        defect_(row(h.end, 1)) {}

  void run(int first, int count, int room) {
    MaterialCells<D>::run(first, count, room, [this](int begin, int n) { move(begin, n); });
  }

 private:
  void move(int first, int n) const {
    const MotionRows<D, C> motion = motion_;
    double* defect = defect_;
    const double* rho = density_;
#pragma GCC ivdep
    for (int i = first; i < first + n; ++i)
      defect[i] = motion.heat(i, rho[i], 1.0 / rho[i], [](int) { return 0.0; });
  }

  MotionRows<D, C> motion_;
  const double* density_;
  double* defect_;
};

}  // namespace

void add_update(TaskList& list, const UpdateInput& v, const SchemeOptions& o, int effect) {
  TaskBuilder task = list.task("update", effect);
  UpdateState h;
  declare_update(task, v, o, h);
  declare_cut_cells(task, v.cut_cells, o, h.cut);
  const std::vector<SchemeOptions> of_material = options_of_materials(o);
  dispatch(o.grid.axes.count, o.grid.components, [&]<int D, int C>() {
    task.kernel([=,
                 laws = Laws{CellClosure(o.materials.fluids, o.materials.heat_exchange,
                                         o.materials.multi_velocity_exchange),
                             IdealRelaxation(o.materials.fluids)},
                 diffusion = DiffusionRates(o)](const Row& row) {
      const RunRow runs = runs_of(row, h.pure);
      const auto alone = [&](int first, int count, double pure) {  // true: one pressure is to find
        const auto m = static_cast<std::size_t>(pure);
        const Row part = row.part(first, count);
        return update_alone<D, C>(part, h, of_material[m], static_cast<int>(m)) && h.closes;
      };
      const int n = row.count();
      if (h.cut.any) {
        MixedCells<D, C> mixed(row, h, o, laws);
        for_each_run(runs, n, [&](int from, int number, double pure) {
          for_each_full(row(h.cut.cells), from, number, [&](int first, int count) {
            if (pure < 0.0)
              mixed.run(first, count, count);
            else if (alone(first, count, pure))
              mixed.relax(first, count);
          });
        });
        end_step_next_to_solids<D, C>(row, h, o, diffusion);
        return;
      }
      if (runs.key[0] >= 0.0 && is_one_run(runs, n)) {
        if (alone(0, n, runs.key[0])) MixedCells<D, C>(row, h, o, laws).relax(0, n);
      } else {
        MixedCells<D, C> mixed(row, h, o, laws);
        for_each_run(runs, n, [&](int first, int count, double pure) {
          if (pure < 0.0) mixed.ask_for_state(first, count);
        });
        for_each_run(runs, n, [&](int first, int count, double pure) {
          if (pure < 0.0)
            mixed.run(first, count, n - first);  // cells beyond come after these
          else if (alone(first, count, pure))
            mixed.relax(first, count);
        });
      }
      if (!h.closes) return;
      rates_of_mixture<D>(row, h.common.next, o, row(h.end, 1));
      if (diffusion.on()) diffusion_rates_of_row(row, h, diffusion);
    });
  });
}

}  // namespace sluice::ice::mixture
