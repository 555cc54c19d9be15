// Which mass of each material with scalars passes the faces of a mixture.
//
// Where both cells of a face have the same pure neighbourhood it is the total flux, of that
// material alone; elsewhere that of each material (mixture/remap_fluxes.cpp).
#include "ice/mixture/variables.hpp"
#include "ice/scalars/variables.hpp"

namespace sluice::ice::scalars {

void add_carriers(TaskList& list, const SchemeVariables& v, const SchemeOptions& o, int effect) {
  if (!o.mixture) return;
  static const char* names[] = {"mass with scalars of axis 0", "mass with scalars of axis 1",
                                "mass with scalars of axis 2"};
  for (int axis = 0; axis < o.axes.count; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    TaskBuilder task = list.task(names[axis], effect);
    const In flux = task.read(v.flux[a]), materials = task.read(v.material_flux[a]);
    const In pure = task.read(v.pure, Stencil::along(o.axes.direction[axis], 1, 0));
    const Out out = task.write(v.scalars.carrier[a]);
    task.kernel([=, carried = v.scalars.materials](const Row& row) {
      const int n = row.count();
      const double* __restrict below = row(pure, 0, axis, -1);
      const double* __restrict above = row(pure);
      const double* __restrict total = row(flux, 0);
      for (std::size_t k = 0; k < carried.size(); ++k) {
        const double m = carried[k];
        const double* __restrict own =
            row(materials, mixture::component(carried[k], mixture::of_mass));
        double* __restrict to = row(out, static_cast<int>(k));
        for (int i = 0; i < n; ++i) {
          const double alone = above[i] == m ? total[i] : 0.0;
          to[i] = below[i] == above[i] && above[i] >= 0.0 ? alone : own[i];
        }
      }
    });
  }
}

}  // namespace sluice::ice::scalars
