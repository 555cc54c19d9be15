#include "framework/run/analysis/analysis_nodes.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "framework/deck/faults.hpp"
#include "framework/run/component/grid_fields.hpp"

namespace sluice {
namespace {

// Outputs of a level take what the fields have.
void copy(const GridFields& fields, Warehouse& outputs) {
  const std::vector<GridBox>& boxes = outputs.local_boxes();
  for (const FieldPiece& piece : fields.pieces()) {
    // Nodes on the high sides of the domain lie in the ghost layer.
    const int slot =
        outputs.add({piece.label, piece.material, component_count(piece.label.info().type), 1});
    const auto box = std::find_if(boxes.begin(), boxes.end(),
                                  [&](const GridBox& b) { return b.id == piece.box_id; });
    const RealView to = outputs.view(slot, piece.component, static_cast<int>(box - boxes.begin()));
    for_each_cell(piece.cells, [&](IntVec3 at) { to(at) = piece.view(at); });
  }
}

}  // namespace

bool is_of_nodes(const Hierarchy& hierarchy, Label label) {
  const ParticleMethod* method = hierarchy.component().particles();
  if (method == nullptr) return false;
  const std::vector<Label> labels = method->grid_labels();
  return std::find(labels.begin(), labels.end(), label) != labels.end();
}

AnalysedQuantity node_quantity(const Hierarchy& hierarchy, const AnalysedVariable& v, Label label) {
  const ParticleMethod& method = *hierarchy.component().particles();
  std::vector<int> materials;
  for (std::size_t k = 0; k < method.kinds().size(); ++k)
    if (method.in_stages(static_cast<int>(k))) materials.push_back(method.kinds()[k].material);
  if (std::find(materials.begin(), materials.end(), v.material) == materials.end())
    throw DeckError(
        v.where,
        fmt::format("<analyze label=\"{}\">: it does not exist for material {}, but for {}",
                    v.label, v.material, fmt::join(materials, ", ")),
        "select one with matl");
  return {label, v.material, component_count(label.info().type)};
}

void store_node_quantities(Hierarchy& hierarchy, const std::vector<AnalysedQuantity>& quantities) {
  std::vector<Label> labels;
  for (const AnalysedQuantity& q : quantities)
    if (is_of_nodes(hierarchy, q.label) &&
        std::find(labels.begin(), labels.end(), q.label) == labels.end())
      labels.push_back(q.label);
  if (labels.empty()) return;
  hierarchy.settle_particles();
  const std::vector<GridFields> fields =
      hierarchy.particle_fields(labels, [&](Label label, int material, int) {
        return std::any_of(quantities.begin(), quantities.end(), [&](const AnalysedQuantity& q) {
          return q.label == label && q.material == material;
        });
      });
  for (std::size_t l = 0; l < fields.size(); ++l)
    copy(fields[l], hierarchy.level(static_cast<int>(l)).outputs());
}

}  // namespace sluice
