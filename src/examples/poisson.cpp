// Laplace's equation on nodes.
#include "examples/poisson.hpp"

#include <algorithm>

#include "framework/grid/nodes.hpp"
#include "framework/refine/face_table.hpp"
#include "framework/scene/deck_values.hpp"

namespace sluice::examples {

PoissonLabels claim_poisson_labels() {
  return {claim_label({"phi", ValueType::real, Centring::node, "1",
                       "solution of Laplace's equation (poisson1 to poisson3, benchmark)"}),
          claim_label({"residual", ValueType::real, Centring::reduction, "1",
                       "sum over the inner nodes of the squared change of phi in a sweep "
                       "(poisson1 to poisson3, benchmark)"})};
}

namespace {

// Of both neighbours along an axis.
std::array<double, 3> weights_of(const Level& grid, const Axes& axes) {
  std::array<double, 3> weight{};
  double sum = 0;
  for (int a = 0; a < axes.count; ++a) {
    const double dx = grid.spacing[axes.direction[a]];
    weight[a] = 1 / (dx * dx);
    sum += 2 / (dx * dx);
  }
  for (double& w : weight) w /= sum;
  return weight;
}

}  // namespace

Poisson::Poisson(const Scene& scene, const PoissonScene& settings)
    : PlainComponent(scene, scene.component, "Jacobi's method"), settings_(settings) {}

// One ghost layer: the neighbours of a box's own nodes, and the nodes that close the domain.
std::vector<SlotInfo> Poisson::slots() const {
  return {{labels_.phi, 0, 1, 1}};
}

// Nodes on sides are the boundary's.
void Poisson::initialise(Warehouse& state) const {
  fill_state(state, 0.0);
}

// The nodes on the sides: the low ones are nodes of a box, the high ones ghosts. An edge belongs to
// the last of its sides; no stencil reads it.
void Poisson::fill_boundary(Warehouse& state, double /*time*/, std::span<const double> /*sums*/,
                            const ThreadTeam& /*team*/) const {
  for (int b = 0; b < static_cast<int>(state.local_boxes().size()); ++b) {
    const RealView phi = state.view(0, 0, b);
    for (const Side side : all_sides)
      if (ends_at(state.level(), side))
        fill(phi, side_nodes(state.level(), side, phi.box), settings_.side_value[index_of(side)]);
  }
}

void Poisson::declare(TaskList& list, const StepVariant& variant) const {
  const Level& grid = level(variant.level);
  const Axes axes = active_axes(grid);
  const IndexBox inner = inner_nodes(grid);
  const std::array<double, 3> weight = weights_of(grid, axes);
  TaskBuilder sweep = list.task("Jacobi sweep", equation);
  const In phi = sweep.read(list.old_state(labels_.phi, 0, 1), Stencil::box(1));
  const Out next = sweep.write(list.new_state(labels_.phi, 0, 1));
  const auto relax = [=, of_nodes = residual_](const Row& row, RowPart part) {
    double* to = row(next);
    for (int i = part.begin; i < part.end; ++i) to[i] = 0;
    for (int a = 0; a < axes.count; ++a) {
      const double w = weight[a];
      const double *below = row(phi, 0, a, -1), *above = row(phi, 0, a, 1);
#pragma GCC ivdep
      for (int i = part.begin; i < part.end; ++i) to[i] += w * (below[i] + above[i]);
    }
    // Exact sums: the same bits however the nodes are shared out.
    ExactSum& residual = row.reductions().sum(of_nodes);
    const double* from = row(phi);
    for (int i = part.begin; i < part.end; ++i) residual.add((to[i] - from[i]) * (to[i] - from[i]));
  };
  // Nodes on sides, and those that a finer level owns, keep their value.
  const LevelCoverage* coverage = variant.coverage;
  if (coverage != nullptr) sweep.needs_box();
  sweep.kernel([=](const Row& row) {
    std::copy_n(row(phi), row.count(), row(next));
    const RowPart part = part_in(row, inner, axes.direction[0]);
    if (coverage == nullptr) return relax(row, part);
    const int first = row.cell()[axes.direction[0]];
    for (const LevelCoverage::Segment& s : coverage->uncovered_in_row(row.box(), row.cell()))
      relax(row,
            {std::max(part.begin, s.first - first), std::min(part.end, s.first + s.count - first)});
  });
}

StepLimit Poisson::limit(const std::vector<double>& /*maxima*/) const {
  return {settings_.dt, "deck: delt"};
}

double Poisson::history_value(Label label, const Totals& totals) const {
  if (label != labels_.residual) return PlainComponent::history_value(label, totals);
  return totals.sweep_sums.empty() ? 0.0 : residual_.of(totals.sweep_sums).front();
}

std::unique_ptr<Component> make_poisson(const Deck& deck, const Scene& scene,
                                        std::vector<Fault>& faults) {
  const PoissonScene settings = read_poisson(deck, scene, faults);
  need_one_level(scene, faults);
  if (any_error(faults)) return nullptr;
  return std::make_unique<Poisson>(scene, settings);
}

}  // namespace sluice::examples
