// Step 9 with velocities of their own: new masses, volumes, momenta and energies; the rest of the
// drag; one pressure; rates.
//
// M_m', V_m', E_m' and P' as in update.cpp with P' from sum F_m U_m. In the frame of v, the
// mixture's Lagrangian velocity, with v_m = v + w_mL:
//   q_m = sum_d [F_m- (U_m- - v_m) - F_m+ (U_m+ - v_m)],   a_m = M_m' w_mL + q_m
//   S_m' = a_m - (M_m'/rho') sum a_n
// then half a step of drag about what pressure holds against it, w'' = R + E (w' - R), R the answer
// to dm_m = -(V_m' - M_m'/rho') [l (p_f+ - p_f-) - dt f] in a whole step. Heat is what the kinetic
// energy has lost, in the frame of v, to the materials by mass:
//   k = sum_m { sum_d [F_m- |U_m- - v_m|^2 - F_m+ |U_m+ - v_m|^2]/2 + w_mL q_m + M_m' w_mL^2/2 }
//       - |sum a_m|^2/(2 rho') - sum_m M_m' w_m''^2/2
// (nothing of q_m/M_m' before the drag: of a trace it is as good as nought by nought). Cells of
// pure neighbourhood run the rows of one material.
#include "ice/closure/cell_closure.hpp"
#include "ice/closure/drag.hpp"
#include "ice/closure/traces.hpp"
#include "ice/mixture/diffusion_rates.hpp"
#include "ice/mixture/touched_update.hpp"
#include "ice/multi_velocity/tasks.hpp"
#include "ice/one_material/update_rows.hpp"
#include "ice/step/material_runs.hpp"

namespace sluice::ice::mixture {
namespace {

struct Handles : UpdateState {
  In velocity_L;
  Bonds bonds;
  std::array<In, 3> velocity, face_pressure;  // of each material; of the mixture
  FrictionOnSlip friction;
};

template <int D, int C>
class Cells {
 public:
  Cells(const Row& row, const Handles& h, const SchemeOptions& o, const Drag& drag,
        const CellClosure& closure)
      : row_(row),
        h_(h),
        o_(o),
        drag_(drag),
        closure_(closure),
        materials_(static_cast<int>(h.state.size())) {
    for (int d = 0; d < D; ++d)
      l_[d] = row.step().dt / row.step().spacing[o.grid.axes.direction[d]];
    for (int c = 0; c < C; ++c) force_[c] = row.step().dt * o.forces.driving[o.grid.direction[c]];
  }
  void run() const {
    for (int i = 0; i < row_.count(); ++i) move(i);
    if (o_.forces.sources != nullptr) add_sources(row_, h_, o_);
    relax();
  }
  // Of cells whose new state is there but for one pressure.
  void relax() const {
    for (int i = 0; i < row_.count(); ++i) relax_cell(i);
  }

 private:
  struct Face {
    double FV, FM, FE, U[C];
  };
  Face face(int m, int d, int shift, int i) const {
    const auto at = [&](In in, int c) { return row_(in, c, d, shift)[i]; };
    Face f{at(h_.flux[d], 3 * m), at(h_.flux[d], 3 * m + 1), at(h_.flux[d], 3 * m + 2), {}};
    for (int c = 0; c < C; ++c) f.U[c] = at(h_.velocity[d], m * C + c);
    return f;
  }

  // Of a material, after the remap. `a`: momentum in the frame of v; of one that is gone what it
  // leaves behind. Returns the kinetic energy in that frame that it had and was given, and the
  // internal energy of one that is gone.
  double remap(int m, int i, double& M, double& V, double& E, double* a, double* passed) const {
    const MaterialState& s = h_.state[m];
    double dV = 0, dM = 0, dE = 0, gain = 0, q[C] = {}, own[C] = {}, w[C];
    for (int c = 0; c < C; ++c) w[c] = row_(h_.velocity_L, m * C + c)[i];
    for (int d = 0; d < D; ++d) {
      const Face low = face(m, d, 0, i), high = face(m, d, 1, i);
      dV += low.FV - high.FV;
      dM += low.FM - high.FM;
      dE += low.FE - high.FE;
      double in = 0, out = 0, carried_in = 0, carried_out = 0;
      for (int c = 0; c < C; ++c) {
        const double v = row_(h_.common.velocity_L, c)[i] + w[c];
        const double low_u = low.U[c] - v, high_u = high.U[c] - v;
        q[c] += low.FM * low_u - high.FM * high_u;
        own[c] += low.FM * low.U[c] - high.FM * high.U[c];
        (c < D ? in : carried_in) += low_u * low_u;
        (c < D ? out : carried_out) += high_u * high_u;
      }
      gain += 0.5 * (low.FM * (in + carried_in) - high.FM * (out + carried_out));
    }
    for (int c = 0; c < C; ++c) passed[c] += own[c];
    const double M_before = row_(s.mass)[i], V_before = row_(s.volume)[i];
    const double V_L = V_before * row_(h_.stretch, 0)[i], E_L = row_(h_.energy_L, m)[i];
    V = V_L + dV;
    M = vapour_kept(M_before + dM, V);
    E = E_L + dE;
    double brought = 0, carried = 0;
    for (int c = 0; c < C; ++c) {
      (c < D ? brought : carried) += w[c] * (q[c] + 0.5 * M * w[c]);
      a[c] = M * w[c] + q[c];
    }
    double left_over = 0;
    if (is_gone(M, V, M_before, V_before)) {
      left_over = E;
      M = V = E = 0.0;
    } else {
      const Residue rest = drained_residue(M, V, E, M_before, V_L, E_L);
      left_over = E - rest.E;
      V = rest.V;
      E = rest.E;
    }
    return gain + (brought + carried) + left_over;
  }

  // The new state before sources.
  void move(int i) const {
    double M[max_materials], V[max_materials], E[max_materials];
    double a[max_materials][C], passed[C] = {}, rho = 0, k = 0;
    for (int m = 0; m < materials_; ++m) {
      k += remap(m, i, M[m], V[m], E[m], a[m], passed);
      rho += M[m];
    }
    for (int c = 0; c < C; ++c)
      row_(h_.common.next.momentum, c)[i] =
          (row_(h_.common.momentum, c)[i] - row_(h_.common.impulse, c)[i]) + passed[c];
    DragCell present;
    present.total = rho;
    h_.bonds.put(row_, i, present);
    for (int m = 0; m < materials_; ++m) {
      if (M[m] == 0.0) continue;
      present.index[present.count] = m;
      present.M[present.count] = M[m];
      present.V[present.count] = larger(V[m], 0.0);
      ++present.count;
    }
    k -= kinetic_energy(a, rho) + finish_drag(present, a, i);
    for (int m = 0; m < materials_; ++m) {
      const MaterialState& s = h_.state[m];
      row_(s.mass_new)[i] = M[m];
      row_(s.volume_new)[i] = V[m];
      row_(s.energy_new)[i] = E[m] + k / rho * M[m];
    }
    row_(h_.end, 0)[i] = rho;
  }
  void relax_cell(int i) const {
    double M[max_materials], V[max_materials], E[max_materials];
    DragCell present;
    present.total = row_(h_.end, 0)[i];
    for (int m = 0; m < materials_; ++m) {
      const MaterialState& s = h_.state[m];
      M[m] = row_(s.mass_new)[i];
      V[m] = row_(s.volume_new)[i];
      E[m] = row_(s.energy_new)[i];
      if (M[m] == 0.0) continue;
      present.index[present.count] = m;
      present.M[present.count++] = M[m];
    }
    close(M, V, E, present.total, i);
    rates(present, V, i);
  }

  // Of the mixture, in the frame of v, with what materials leave behind when they go.
  double kinetic_energy(const double (*a)[C], double rho) const {
    double sum = 0, carried = 0;
    for (int c = 0; c < C; ++c) {
      double total = 0;
      for (int m = 0; m < materials_; ++m) total += a[m][c];
      (c < D ? sum : carried) += total * total;
    }
    return 0.5 * (sum + carried) / rho;
  }
  // Slip of those present, written; its kinetic energy.
  double finish_drag(DragCell& cell, const double (*a)[C], int i) const {
    for (const Out slip : h_.slip_new)
      for (int c = 0; c < C; ++c) row_(slip, c)[i] = 0.0;
    if (cell.count < 2) return 0.0;  // its momentum in the frame of v is the mixture's
    bind(cell, a);
    double kept = 0, carried = 0;
    double w[C][max_materials], R[C][max_materials], total[C] = {};
    respond(cell, i, R);
    for (int c = 0; c < C; ++c) {
      for (int n = 0; n < cell.count; ++n) total[c] += a[cell.index[n]][c];
      for (int n = 0; n < cell.count; ++n)
        w[c][n] = a[cell.index[n]][c] / cell.M[n] - total[c] / cell.total - R[c][n];
    }
    drag_.decay(cell, row_.step().dt, 0.5, C, w);
    for (int c = 0; c < C; ++c) {
      for (int n = 0; n < cell.count; ++n) {
        w[c][n] += R[c][n];
        row_(h_.slip_new[cell.index[n]], c)[i] = cell.M[n] * w[c][n];
      }
      (c < D ? kept : carried) += Drag::energy(cell, w[c]);
    }
    return kept + carried;
  }
  void bind(DragCell& cell, const double (*a)[C]) const {
    double total[D] = {};
    for (int d = 0; d < D; ++d)
      for (int n = 0; n < cell.count; ++n) total[d] += a[cell.index[n]][d];
    for (int n = 0; n < cell.count; ++n) {
      double courant = 0;
      for (int d = 0; d < D; ++d)
        courant = larger(
            courant, l_[d] * std::fabs(a[cell.index[n]][d] / cell.M[n] - total[d] / cell.total));
      cell.bind[n] = binding(cell, n, courant);
    }
  }
  void respond(const DragCell& cell, int i, ByMaterial* R) const {
    double push[C][max_materials];
    for (int c = 0; c < C; ++c) {
      double pressed = -force_[c];
      if (c < D) {
        const In pressure = h_.face_pressure[c];
        pressed += l_[c] * (row_(pressure, 0, c, 1)[i] - row_(pressure)[i]);
      }
      Drag::push(cell, pressed, push[c]);
      h_.friction.add(row_, cell, c, i, push[c]);
    }
    drag_.respond(cell, row_.step().dt, 1.0, C, push, R);
  }

  void close(double* M, double* V, double* E, double rho, int i) const {
    const Equilibration::Result result =
        closure_.close({M, V, E}, rho, row_.step().dt, surface_of(row_, h_, o_, i));
    tell_faults(row_, o_.grid.axes, i, rho, row_(h_.common.inverse_J)[i], result, E);
    row_(h_.end, 1)[i] = result.modulus;
    row_(h_.pressure)[i] = result.pressure;
    for (int m = 0; m < materials_; ++m) {
      const MaterialState& s = h_.state[m];
      row_(s.volume_new)[i] = V[m];
      row_(s.energy_new)[i] = E[m];
    }
  }
  // Each material's own speed, and sound as fast as without drag.
  void rates(DragCell& cell, const double* V, int i) const {
    if (cell.count < 2) return;
    const RateConstants x = rate_constants(o_, row_.step());
    for (int n = 0; n < cell.count; ++n) cell.V[n] = V[cell.index[n]];
    const double sound = std::sqrt(row_(h_.end, 1)[i] * Drag::inverse_inertia(cell));
    for (int n = 0; n < cell.count; ++n) {
      const Out slip = h_.slip_new[cell.index[n]];
      double deck = 0, flow = 0, fastest = 0, sum = 0;
      for (int d = 0; d < D; ++d) {
        const double u = std::fabs(row_(h_.common.next.momentum, d)[i] / cell.total +
                                   row_(slip, d)[i] / cell.M[n]);
        deck = larger(deck, (u + x.sound_speed_factor * sound) * x.inverse_dx[d]);
        fastest = larger(fastest, (u + sound) * x.inverse_dx[d]);
        sum += (u + sound) * x.inverse_dx[d];
        flow += u * x.inverse_dx[d];
      }
      if (!x.conservative) row_.reductions().maximum(StepSlots::deck_rate, ordered_bits(deck));
      row_.reductions().maximum(StepSlots::flow_rate, ordered_bits(flow));
      fastest = larger(fastest, x.sum_share * sum);
      row_.reductions().maximum(StepSlots::sound_rate, ordered_bits(fastest));
    }
  }

  const Row& row_;
  const Handles& h_;
  const SchemeOptions& o_;
  const Drag& drag_;
  const CellClosure& closure_;
  int materials_;
  double l_[D], force_[C];
};

Handles declare(TaskBuilder& task, const SlipUpdateInput& v, const SchemeOptions& o) {
  Handles h;
  declare_update(task, v.update, o, h);
  declare_cut_cells(task, v.update.cut_cells, o, h.cut);
  h.velocity_L = task.read(v.velocity_L);
  h.bonds = read_bonds(task, v.bonds, o);
  h.friction = read_friction(task, v.stress, o);
  for (int axis = 0; axis < o.grid.axes.count; ++axis) {
    const Stencil both = Stencil::along(o.grid.axes.direction[axis], 0, 1);
    h.velocity[axis] = task.read(v.material_velocity[axis], both);
    h.face_pressure[axis] = task.read(v.face_pressure[axis], both);
  }
  return h;
}

}  // namespace

void add_slip_update(TaskList& list, const SlipUpdateInput& v, const SchemeOptions& o, int effect) {
  TaskBuilder task = list.task("update", effect);
  const Handles h = declare(task, v, o);
  const std::vector<SchemeOptions> of_material = options_of_materials(o);
  dispatch(o.grid.axes.count, o.grid.components, [&]<int D, int C>() {
    task.kernel([=,
                 closure = CellClosure(o.materials.fluids, o.materials.heat_exchange,
                                       o.materials.multi_velocity_exchange),
                 drag = Drag(o.materials.drag, o.materials.multi_velocity_exchange),
                 diffusion = DiffusionRates(o)](const Row& row) {
      const auto update = [&](int first, int count, double pure) {
        const Row part = row.part(first, count);
        const Cells<D, C> cells(part, h, o, drag, closure);
        if (pure < 0.0) {
          mark_alone(part, -1);
          return cells.run();
        }
        const auto m = static_cast<std::size_t>(pure);
        if (update_alone<D, C>(part, h, of_material[m], static_cast<int>(m))) cells.relax();
      };
      if (h.cut.any) {
        for_each_run(runs_of(row, h.pure), row.count(), [&](int from, int number, double pure) {
          for_each_full(row(h.cut.cells), from, number,
                        [&](int first, int count) { update(first, count, pure); });
        });
        return end_step_next_to_solids<D, C>(row, h, o, diffusion);
      }
      for_each_run(runs_of(row, h.pure), row.count(), update);
      rates_of_mixture<D>(row, h.common.next, o, row(h.end, 1));
      if (diffusion.on()) diffusion_rates_of_row(row, h, diffusion);
    });
  });
}

}  // namespace sluice::ice::mixture
