// Wave amplitudes in the cells next to open faces.
#include "ice/outputs/wave_labels.hpp"

#include "ice/boundary/boundary_fill.hpp"

namespace sluice::ice {
namespace {

struct Handles {
  In rho, u, p, c;
};

// Differences across a face, from the cell's state.
struct Wave {
  double rho, c, un, rho_n, p_n, un_n, t1_n, t2_n;

  double amplitude(int number) const {
    switch (number) {
      case 1:
        return 0.5 * (un - c) * (p_n - rho * c * un_n);
      case 2:
        return un * (rho_n - p_n / (c * c));
      case 3:
        return un * t1_n;
      case 4:
        return un * t2_n;
      default:
        return 0.5 * (un + c) * (p_n + rho * c * un_n);
    }
  }
};

Wave wave_of(const Row& row, const Handles& h, int axis, int d, bool plus, int i, double dx) {
  const int step = plus ? 1 : -1;
  const double scale = step / dx;
  const auto across = [&](In in, int component) {
    return scale * (row(in, component, axis, step)[i] - row(in, component)[i]);
  };
  Wave w;
  w.rho = row(h.rho)[i];
  w.c = row(h.c)[i];
  w.un = row(h.u, d)[i];
  w.rho_n = across(h.rho, 0);
  w.p_n = across(h.p, 0);
  w.un_n = across(h.u, d);
  w.t1_n = across(h.u, (d + 1) % 3);
  w.t2_n = across(h.u, (d + 2) % 3);
  return w;
}

}  // namespace

void declare_wave_amplitudes(QuantityList& quantities, const WaveInputs& inputs) {
  const SchemeOptions& o = quantities.options();
  for (int number = 1; number <= 5; ++number) {
    const Label label = labels().wave_amplitude[number - 1];
    const VariableId v = quantities.fresh(label, 0);
    TaskBuilder t = quantities.task(label, 0);
    const Handles h = {t.read(inputs.rho, Stencil::box(1)),
                       t.read(inputs.velocity, Stencil::box(1)),
                       t.read(inputs.pressure, Stencil::box(1)), t.read(inputs.sound_speed)};
    const Out out = t.write(v);
    t.kernel([=, axes = o.grid.axes, domain = o.grid.domain,
              boundary = o.grid.boundary](const Row& row) {
      const int n = row.count(), along = axes.direction[0];
      for (int d = 0; d < 3; ++d)
        for (int i = 0; i < n; ++i) row(out, d)[i] = 0.0;
      for (int axis = 0; axis < axes.count; ++axis) {
        const int d = axes.direction[axis];
        const double dx = row.step().spacing[d];
        for (const bool plus : {false, true}) {
          const Side side = side_of(d, plus);
          const int wanted = plus ? domain.upper[d] - 1 : domain.lower[d];
          if (!boundary->has_waves(side)) continue;
          for (int i = 0; i < n; ++i) {
            IntVec3 cell = row.cell();
            cell[along] += i;
            if (cell[d] != wanted || !boundary->lets_waves_out(side, cell)) continue;
            row(out, d)[i] = wave_of(row, h, axis, d, plus, i, dx).amplitude(number);
          }
        }
      }
    });
  }
}

}  // namespace sluice::ice
