// Step 8: declaring the remap through the faces of each axis; remap_flux_rows.hpp.
#include "ice/one_material/remap_flux_rows.hpp"

namespace sluice::ice {

void add_remap_fluxes(TaskList& list, const SchemeVariables& v, const SchemeOptions& o,
                      int effect) {
  static const char* names[] = {"remap along axis 0", "remap along axis 1", "remap along axis 2"};
  for (int axis = 0; axis < o.axes.count; ++axis) {
    const int direction = o.axes.direction[axis];
    const auto face = static_cast<std::size_t>(axis);
    const bool scaled = o.fluid.ideal() == nullptr;
    TaskBuilder task = list.task(names[axis], effect);
    RemapFluxHandles h = read_remap_inputs(task, v, o, axis);
    h.flux = task.write(v.flux[face]);
    dispatch(o.axes.count, o.components, [&]<int D, int C>() {
      task.kernel([=](const Row& row) {
        const double l = row.step().dt / row.step().spacing[direction];
        if (scaled)
          flux_row_of<D, C, true>(row, h, axis, l, o);
        else if (o.density_bound == DensityBound::as_energy)
          flux_row_of<D, C, false, DensityBound::as_energy>(row, h, axis, l, o);
        else
          flux_row_of<D, C, false>(row, h, axis, l, o);
      });
    });
  }
}

}  // namespace sluice::ice
