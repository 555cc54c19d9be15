#include "mpmice/burn/burning_outputs.hpp"

#include <algorithm>
#include <cmath>

#include "framework/base/reduction.hpp"
#include "framework/run/levels/level_solver.hpp"
#include "ice/fluid/labels.hpp"

namespace sluice::mpmice {

template <int D>
std::vector<BurningField> saved_fields(const BurningStep<D>& step, const models::SolidBurn& burn) {
  const Warehouse& state = step.scope.levels.front()->state();
  std::vector<BurningField> fields = burning_fields(burn);
  std::erase_if(fields, [&](const BurningField& f) { return state.find(f.kept, burn.solid) < 0; });
  return fields;
}

template <int D>
double count_pieces(const BurningStep<D>& step, const std::vector<BurningPiece>& pieces,
                    CellSums<D>& counts) {
  counts.begin(step.frame().cells, 1);
  for (const BurningPiece& piece : pieces) ++counts.lane(0)[piece.cell];
  counts.sum_over_ranks(*step.scope.ranks);
  return most_of(counts, *step.scope.ranks);
}

template <int D>
void mean_of_pieces(const BurningStep<D>& step, const std::vector<BurningPiece>& pieces,
                    const Column& values, const CellSums<D>& counts, double most, Column& mean) {
  double largest = 1e-300;
  for (const double value : values) largest = std::max(largest, std::fabs(value));
  Reduction all;
  const auto slot = all.add_maximum(largest);
  step.scope.ranks->reduce(all);
  largest = all.maximum(slot);
  CellSums<D> sums;
  sums.begin(step.frame().cells, 1);
  for (std::size_t n = 0; n < pieces.size(); ++n)
    sums.lane(0)[pieces[n].cell] += to_sum(values[n] / largest / most);
  sums.sum_over_ranks(*step.scope.ranks);
  for (std::size_t i = 0; i < mean.size(); ++i)
    if (counts.lane(0)[i] > 0)
      mean[i] = from_sum(sums.lane(0)[i]) * largest * most / static_cast<double>(counts.lane(0)[i]);
}

template <int D>
void keep_in_cells(const BurningStep<D>& step, Label kept, int solid, const Column& values) {
  Warehouse& next = step.scope.levels.front()->attempted();
  const int slot = next.find(kept, solid);
  for (int b = 0; b < static_cast<int>(next.local_boxes().size()); ++b) {
    const RealView to = next.view(slot, 0, b);
    step.frame().for_each_held(next.local_boxes()[static_cast<std::size_t>(b)].cells,
                               [&](IntVec3 c, std::size_t i) {
                                 if (values[i] != 0) to(c) = values[i];
                               });
  }
}

template <int D>
void store_burning_surfaces(const BurningStep<D>& step, const models::SolidBurn& burn,
                            const std::vector<BurningField>& fields,
                            const std::vector<BurningPiece>& pieces) {
  CellSums<D> counts;
  const double most = count_pieces(step, pieces, counts);
  for (const BurningField& field : fields) {
    Column mean(step.near.size(), 0.0), values;
    if (field.value == BurningValue::burns) {
      for (std::size_t i = 0; i < mean.size(); ++i) mean[i] = counts.lane(0)[i] > 0 ? 1 : 0;
    } else {
      for (const BurningPiece& piece : pieces) {
        const models::SurfaceHistory& surface = step.sets.all()[piece.set].surface[piece.particle];
        values.push_back(field.value == BurningValue::gradient ? surface.gradient
                                                               : surface.temperature);
      }
      mean_of_pieces(step, pieces, values, counts, most, mean);
    }
    keep_in_cells(step, field.kept, burn.solid, mean);
  }
}

template <int D>
void store_given_mass(const BurningStep<D>& step, const std::vector<Column>& given,
                      const std::vector<Column>& made) {
  const Label kept = ice::labels().kept_model_mass;
  const int solids = static_cast<int>(step.sets.kinds().size());
  const auto keep = [&](int material, const Column& mass, double sign) {
    if (mass.empty() || step.scope.levels.front()->state().find(kept, material) < 0) return;
    Column of_cells = mass;
    for (double& m : of_cells) m *= sign * step.frame().cell_volume;
    keep_in_cells(step, kept, material, of_cells);
  };
  for (std::size_t k = 0; k < given.size(); ++k) keep(static_cast<int>(k), given[k], -1);
  for (std::size_t m = 0; m < made.size(); ++m) keep(solids + static_cast<int>(m), made[m], 1);
}

#define SLUICE_IN_DIRECTIONS(D)                                                         \
  template std::vector<BurningField> saved_fields(const BurningStep<D>&,                \
                                                  const models::SolidBurn&);            \
  template double count_pieces(const BurningStep<D>&, const std::vector<BurningPiece>&, \
                               CellSums<D>&);                                           \
  template void mean_of_pieces(const BurningStep<D>&, const std::vector<BurningPiece>&, \
                               const Column&, const CellSums<D>&, double, Column&);     \
  template void keep_in_cells(const BurningStep<D>&, Label, int, const Column&);        \
  template void store_burning_surfaces(const BurningStep<D>&, const models::SolidBurn&, \
                                       const std::vector<BurningField>&,                \
                                       const std::vector<BurningPiece>&);               \
  template void store_given_mass(const BurningStep<D>&, const std::vector<Column>&,     \
                                 const std::vector<Column>&);
SLUICE_IN_DIRECTIONS(1)
SLUICE_IN_DIRECTIONS(2)
SLUICE_IN_DIRECTIONS(3)
#undef SLUICE_IN_DIRECTIONS

}  // namespace sluice::mpmice
