#include "mpm/step/columns.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "framework/geometry/point_file.hpp"
#include "mpm/step/labels.hpp"

namespace sluice::mpm {
namespace {

// Is it saved, or followed by an analysis.
bool is_wanted(const Scene& scene, const char* name) {
  const auto is_it = [&](const auto& request) { return request.label == name; };
  return std::any_of(scene.output.saves.begin(), scene.output.saves.end(), is_it) ||
         std::any_of(scene.analysis.modules.begin(), scene.analysis.modules.end(),
                     [&](const AnalysisModule& m) {
                       return std::any_of(m.variables.begin(), m.variables.end(), is_it);
                     });
}

// Do the point files of a material have a column.
bool file_gives(const SolidMaterial& material, const char* name) {
  return std::any_of(material.forms().begin(), material.forms().end(), [&](const SeedObject& o) {
    const auto* points = dynamic_cast<const PointFilePiece*>(o.piece.get());
    return points != nullptr && points->file().vectors.contains(name);
  });
}

// Half widths of the particles of an object in cells.
std::array<double, 3> half_of(const SeedObject& o) {
  std::array<double, 3> half{};
  for (int d = 0; d < 3; ++d)
    half[static_cast<std::size_t>(d)] =
        0.5 * std::fabs(o.map[static_cast<std::size_t>(4 * d)]) / o.per_cell[d];
  return half;
}

// The labels of what a law remembers: its own where that has as many components (six of a symmetric
// tensor), else one for each, numbered from 1.
std::vector<Label> labels_of(const HistoryColumn& h) {
  const LabelInfo info = h.label.info();
  if (h.components == component_count(info.type) ||
      (h.components == 6 && info.type == ValueType::tensor))
    return {h.label};
  std::vector<Label> labels;
  for (int c = 1; c <= h.components; ++c)
    labels.push_back(
        declare_label({info.name + "_" + std::to_string(c), ValueType::real, Centring::particle,
                       info.unit, info.definition + ", component " + std::to_string(c)}));
  return labels;
}

// Do all particles have the widths of the first object's.
bool alike(const SolidMaterial& material) {
  return std::all_of(material.forms().begin(), material.forms().end(), [&](const SeedObject& o) {
    return o.filling_levels == 1 && !o.cut_cells && o.piece->points() == nullptr &&
           half_of(o) == half_of(material.forms().front());
  });
}

}  // namespace

bool files_give_velocities(const MpmScene& solids) {
  return std::any_of(solids.materials.begin(), solids.materials.end(),
                     [](const SolidMaterial& m) { return file_gives(m, "p.velocity"); });
}

// Table: a row for each column, with the scenes that need it.
Carried carried_by(const Scene& scene, const MpmScene& solids, const SolidMaterial& material) {
  Carried c;
  int next = 0;
  const auto add = [&](Label label, bool advanced, bool symmetric = false) {
    const int first = next;
    c.attributes.emplace_back(label, advanced, symmetric);
    next += c.attributes.back().columns();
    return first;
  };
  const SolidLabels& l = solid_labels();
  c.columns.velocity = add(l.velocity, true);
  if (solids.implicit) c.columns.acceleration = add(l.acceleration, true);
  c.columns.mass = add(l.mass, false);
  c.columns.volume_0 = add(l.volume_0, false);
  c.columns.volume = add(l.volume, true);
  c.columns.F = add(l.F, true);
  c.columns.stress = add(l.stress, true, true);
  c.columns.energy = add(l.energy, true);
  c.columns.temperature = add(l.temperature, true);
  if (solids.scalar_diffusion) c.columns.concentration = add(l.concentration, true);
  if (solids.transfer == Transfer::apic || solids.transfer == Transfer::affine ||
      solids.gradient_enhanced)
    c.columns.affine = add(l.affine, true);
  if (solids.midpoint() && !material.rigid) c.columns.spin = add(l.spin, true);
  if (!material.forms().empty()) c.half = c.half_at_rest = half_of(material.forms().front());
  const bool by_width = solids.basis == Basis::gimp || solids.basis == Basis::cpgimp;
  if (by_width && (solids.refine_particles || !alike(material)))
    c.columns.half = add(l.half, false);
  if (solids.basis == Basis::quadratic) c.half = {0.5, 0.5, 0.5};
  for (double& half : c.half) half = std::min(half, 0.5);
  if (by_corners(solids.basis) || is_wanted(scene, "p.size") || is_wanted(scene, "p.scalefactor") ||
      solids.refine_particles || solids.granular)
    c.columns.size = add(l.size, false);
  if (solids.refine_particles) c.columns.split = add(l.split, false);
  if (solids.carries_corners()) {
    c.columns.corner_count = 1 << scene.grid.levels.front().active_count();
    for (int k = 0; k < c.columns.corner_count; ++k) {
      const int first = add(l.corner[static_cast<std::size_t>(k)], true);
      if (k == 0) c.columns.corners = first;
    }
    c.columns.outer = add(l.outer, false);
  }
  if (material.burns) c.filled = add(l.filled, false);
  if (material.has_surface_history) {
    c.surface = add(l.surface_temperature, false);
    add(l.surface_gradient, false);
  }
  if (material.awaits_flames) {
    c.flame = add(l.flame_kind, false);
    for (const Label label : {l.flame_come, l.flame_time, l.flame_way}) add(label, false);
  }
  if (solids.total_lagrangian) c.columns.reference = add(l.reference, false);
  if (is_wanted(scene, "p.displacement") || is_wanted(scene, "g.displacement") ||
      !solids.manufactured.empty())
    c.columns.displacement = add(l.displacement, true);
  if (solids.with_colour || !solids.insert_file.empty()) c.columns.colour = add(l.colour, false);
  const bool loaded = solids.use_loads && !solids.loads.empty();
  if (loaded) c.columns.marks = add(l.marks, false);
  if (file_gives(material, "p.externalforce")) c.columns.given_force = add(l.given_force, false);
  if (loaded && file_gives(material, "p.normal")) c.columns.normal = add(l.normal, false);
  if (is_wanted(scene, "p.externalforce")) c.columns.outside_force = add(l.outside_force, true);
  if (is_wanted(scene, "p.externalHeatRate")) c.columns.heat_source = add(l.heat_source, true);
  if (is_wanted(scene, "p.dTdt") || is_wanted(scene, "p.dTdt+") || is_wanted(scene, "g.dTdt"))
    c.columns.heating = add(l.heating, true);
  if (solids.viscous() || (solids.artificial_viscosity && is_wanted(scene, "p.q")))
    c.columns.viscous = add(l.viscous, true);
  if (material.lost_energy_heats) {
    c.columns.lost_energy = add(l.lost_energy, true);
    c.columns.lost_heat = add(l.lost_heat, true);
    c.columns.open_energy = add(l.open_energy, true);
    c.columns.loss_temperature = add(l.loss_temperature, true);
    if (c.columns.viscous >= 0) c.columns.viscous_heat = add(l.viscous_heat, true);
  }
  if (material.water) {
    c.columns.water_mass = add(l.water_mass, false);
    c.columns.water_velocity = add(l.water_velocity, true);
    c.columns.pore_pressure = add(l.pore_pressure, true);
    if (is_wanted(scene, "p.porepressureFilter"))
      c.columns.filtered_pressure = add(l.filtered_pressure, true);
  }
  c.columns.history = next;
  for (const HistoryColumn& h : material.law->history())
    for (const Label label : labels_of(h)) add(label, true, h.components == 6 && label == h.label);
  c.history_columns = next - c.columns.history;
  return c;
}

int column_of(const Carried& carried, std::string_view label) {
  int column = 0;
  for (const ParticleAttribute& a : carried.attributes) {
    if (a.label.name() == label) return column;
    column += a.columns();
  }
  return -1;
}

std::array<const double*, 3> places_of(const ParticleSet& set, const Columns& c) {
  if (c.reference >= 0) return read_columns<3>(set, c.reference);
  return {set.coordinate(0), set.coordinate(1), set.coordinate(2)};
}

ParticleShape shape_of(const ParticleSet& set, const Columns& c) {
  return {read_columns<3>(set, c.half), read_columns<9>(set, c.F), read_columns<9>(set, c.size),
          corners_of(set, c)};
}

CornerColumns corners_of(const ParticleSet& set, const Columns& c) {
  CornerColumns to{};
  for (int n = 0; n < 3 * c.corner_count; ++n)
    to[static_cast<std::size_t>(n)] = set.column(static_cast<std::size_t>(c.corners + n));
  return to;
}

DerivedAttribute scale_factor(const Columns& columns, Vec3 spacing) {
  return {solid_labels().scale_factor,
          [columns, spacing](const ParticleSet& set, std::vector<std::vector<double>>& to) {
            const ParticleShape shape = shape_of(set, columns);
            for (std::size_t e = 0; e < 9; ++e)
              for (std::size_t p = 0; p < set.size(); ++p) {
                double sum = 0;
                for (std::size_t k = 0; k < 3; ++k)
                  sum += shape.F[e / 3 * 3 + k][p] * spacing[static_cast<int>(k)] *
                         shape.edges[3 * k + e % 3][p];
                to[e][p] = sum;
              }
          }};
}

DerivedAttribute rate_of_format(const Columns& columns) {
  const auto from = static_cast<std::size_t>(columns.heating);
  return {solid_labels().rate_of_format,
          [from](const ParticleSet& set, std::vector<std::vector<double>>& to) {
            std::copy_n(set.column(from), set.size(), to[0].begin());
          }};
}

}  // namespace sluice::mpm
