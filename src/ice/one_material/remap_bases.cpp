// Step 7 (2-D and 3-D): declaring what each cell offers to the remap; remap_base_rows.hpp.
#include "ice/one_material/remap_base_rows.hpp"
#include "ice/one_material/tasks.hpp"

namespace sluice::ice {

void add_remap_bases(TaskList& list, const RemapBasesInput& v, const SchemeOptions& o, int effect) {
  if (!o.scheme.second_order || o.grid.axes.count == 1) return;  // the base is the Lagrangian value
  TaskBuilder task = list.task("remap bases", effect);
  const RemapBaseHandles h = declare_remap_bases(task, v, o);
  const bool scaled = o.materials.fluid.gamma_law() == nullptr;
  const Vec3 gravity = o.forces.on ? o.forces.gravity : Vec3{};
  dispatch(o.grid.axes.count, o.grid.components, [&]<int D, int C>() {
    if constexpr (D > 1)
      task.kernel([=](const Row& row) {
        if (o.scheme.masked)
          base_rows<D, C, true>(row, h, o.grid.axes, gravity, scaled);
        else
          base_rows<D, C, false>(row, h, o.grid.axes, gravity, scaled);
      });
  });
}

}  // namespace sluice::ice
