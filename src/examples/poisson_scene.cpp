// Tags and boundary values of the Poisson examples.
#include "examples/poisson_scene.hpp"

#include <fmt/format.h>

#include "framework/deck/faults.hpp"
#include "framework/grid/nodes.hpp"
#include "framework/run/component/plain_component.hpp"

namespace sluice::examples {
namespace {

// The value that the deck gives phi on a whole side.
double side_value(const Scene& scene, Side side, std::vector<Fault>& faults) {
  const std::vector<BoundaryRegion>& regions = scene.boundary.side(side).regions;
  const BoundaryRegion& whole = regions.front();
  if (regions.size() > 1)
    add_error(faults, regions[1].where,
              fmt::format("{} takes one value on a whole side", scene.component),
              fmt::format("write <Face side=\"{}\">", name_of(side)));
  const Condition* phi = whole.find("Phi", 0);
  if (phi == nullptr) {
    add_warning(faults, whole.where.line > 0 ? whole.where : scene.grid_settings.where,
                fmt::format("side {} has no condition for Phi: 0 is used", name_of(side)),
                "write <BCType id=\"0\" label=\"Phi\" var=\"Dirichlet\"><value>0</value></BCType>");
    return 0;
  }
  if (phi->kind != ConditionKind::dirichlet || !phi->has_value || phi->is_vector ||
      !phi->text.empty())
    add_error(faults, phi->where, "the condition for Phi must be its value on the side",
              "write var=\"Dirichlet\" and a number as <value>");
  return phi->value;
}

}  // namespace

void add_poisson_tags(Schema& schema) {
  schema.add(
      tag("Poisson", "Laplace's equation by sweeps of Jacobi's method, on nodes")
          .with_children({tag("delt", "length of a step").once().real().above(0).unit("time"),
                          tag("maxresidual",
                              "sweeps of a step end when the sum of the squared changes is below "
                              "this value; poisson1 and benchmark make one sweep per step")
                              .once()
                              .real()
                              .above(0)}));
}

PoissonScene read_poisson(const Deck& deck, const Scene& scene, std::vector<Fault>& faults) {
  PoissonScene read;
  const DeckNode* block = need_block(deck, scene, "Poisson", faults);
  if (block == nullptr) return read;
  read.dt = block->real("delt");
  read.max_residual = block->real("maxresidual");
  for (const Side side : all_sides)
    if (ends_at(scene.grid.levels.front(), side))
      read.side_value[index_of(side)] = side_value(scene, side, faults);
  return read;
}

}  // namespace sluice::examples
