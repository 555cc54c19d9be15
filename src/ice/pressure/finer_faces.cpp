#include "ice/pressure/finer_faces.hpp"

#include <cstring>

#include "framework/base/communicator.hpp"
#include "framework/grid/cell_map.hpp"
#include "framework/run/levels/level_solver.hpp"
#include "ice/fluid/labels.hpp"
#include "ice/pressure/pressure_system.hpp"

namespace sluice::ice::pressure {
namespace {

// A coarse face, by the coarse cell above it, and the means over its fine faces.
struct FaceMean {
  IntVec3 cell;
  int direction;
  double velocity, pressure;
};

// The fine faces of a coarse face of one side of a box are all the box's.
void add_means_of_side(const LevelSolver& finer, const CellMap& map, int box, const IndexBox& cells,
                       int d, bool plus, std::vector<FaceMean>& means) {
  const Level& level = finer.level();
  const IntVec3 ratio = level.ratio;
  const Warehouse& stored = finer.outputs();
  const auto u = stored.view(slot_of(stored, labels().face_velocity[d]), 0, box);
  const auto p = stored.view(slot_of(stored, labels().face_pressure[d]), 0, box);
  IndexBox layer = cells;  // of cells below whose low faces lie on the side
  layer.lower[d] = plus ? cells.upper[d] : cells.lower[d];
  layer.upper[d] = layer.lower[d] + 1;
  IntVec3 across = ratio;
  across[d] = 1;
  for (int k = layer.lower.z; k < layer.upper.z; k += across.z)
    for (int j = layer.lower.y; j < layer.upper.y; j += across.y)
      for (int i = layer.lower.x; i < layer.upper.x; i += across.x) {
        const IntVec3 face{i, j, k};
        IntVec3 outside = face;
        if (!plus) --outside[d];
        if (map.has(outside) || !map.in_domain(outside)) continue;
        FaceMean mean{map.image(face), d, 0.0, 0.0};
        for (int e = 0; e < 3; ++e) mean.cell[e] = mean.cell[e] / ratio[e];
        for_each_cell({face, face + across}, [&](IntVec3 f) {
          mean.velocity += u(f);
          mean.pressure += p(f);
        });
        const double count = static_cast<double>(across.x) * across.y * across.z;
        mean.velocity /= count;
        mean.pressure /= count;
        means.push_back(mean);
      }
}

std::vector<FaceMean> gather_from_ranks(const std::vector<FaceMean>& own) {
  if (world().size() == 1) return own;
  std::string bytes(own.size() * sizeof(FaceMean), '\0');
  std::memcpy(bytes.data(), own.data(), bytes.size());
  std::vector<FaceMean> all;
  for (const std::string& text : world().gather_to_all(bytes)) {
    const std::size_t before = all.size();
    all.resize(before + text.size() / sizeof(FaceMean));
    std::memcpy(all.data() + before, text.data(), text.size());
  }
  return all;
}

}  // namespace

void take_finer_faces(LevelSolver& coarser, LevelSolver& finer) {
  // Before faces were stored for the first time nothing asks for them.
  for (int d = 0; d < 3; ++d)
    if (finer.level().active[d] && slot_of(finer.outputs(), labels().face_pressure[d]) < 0) return;
  const CellMap fine_map(finer.level()), coarse_map(coarser.level());
  std::vector<FaceMean> means;
  const std::vector<GridBox>& boxes = finer.state().local_boxes();
  for (int b = 0; b < static_cast<int>(boxes.size()); ++b)
    for (int d = 0; d < 3; ++d)
      if (finer.level().active[d])
        for (const bool plus : {false, true})
          add_means_of_side(finer, fine_map, b, boxes[b].cells, d, plus, means);
  Warehouse& state = coarser.state();
  const auto put = [&](Label label, IntVec3 cell, double value) {
    const int slot = slot_of(state, label);
    for (int b = 0; b < static_cast<int>(state.local_boxes().size()); ++b)
      if (state.local_boxes()[b].cells.contains(cell)) state.view(slot, 0, b)(cell) = value;
  };
  for (const FaceMean& mean : gather_from_ranks(means)) {
    const IntVec3 cell = coarse_map.image(mean.cell);
    put(labels().finer_face_velocity[mean.direction], cell, mean.velocity);
    put(labels().finer_face_pressure[mean.direction], cell, mean.pressure);
  }
  for (int d = 0; d < 3; ++d)
    if (coarser.level().active[d]) {
      coarser.fill_work_ghosts(labels().finer_face_velocity[d]);
      coarser.fill_work_ghosts(labels().finer_face_pressure[d]);
    }
}

}  // namespace sluice::ice::pressure
