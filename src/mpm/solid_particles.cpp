#include "mpm/solid_particles.hpp"

#include <algorithm>
#include <cmath>

#include "framework/geometry/sampling.hpp"
#include "framework/run/levels/particle_cloud.hpp"
#include "models/burn/unsteady_burn.hpp"
#include "mpm/outputs/mean_pressure.hpp"
#include "mpm/outputs/node_fields.hpp"
#include "mpm/outputs/thermal_volume.hpp"
#include "mpm/shape/weights.hpp"
#include "mpm/step/carry_corners.hpp"
#include "mpm/step/cohesive_zones.hpp"
#include "mpm/step/labels.hpp"
#include "mpm/step/law_batch.hpp"
#include "mpm/step/outside_forces.hpp"
#include "mpm/step/pore_water.hpp"
#include "mpm/step/rates.hpp"
#include "mpm/step/solid_step.hpp"

namespace sluice::mpm {
namespace {

double optional(const std::vector<double>& column, std::size_t p) {
  return column.empty() ? 0.0 : column[p];
}

// Layers of cells across z, y or x: what is seeded at once takes no more memory than it need.
std::vector<IndexBox> layers_of(const IndexBox& cells) {
  constexpr std::int64_t enough = 65536;  // cells
  const IntVec3 size = cells.size();
  const int along = size.z > 1 ? 2 : size.y > 1 ? 1 : 0;
  const std::int64_t across = std::max<std::int64_t>(1, cells.volume() / std::max(1, size[along]));
  const int thick = static_cast<int>(std::max<std::int64_t>(1, enough / across));
  std::vector<IndexBox> layers;
  for (int low = cells.lower[along]; low < cells.upper[along]; low += thick) {
    IndexBox& layer = layers.emplace_back(cells);
    layer.lower[along] = low;
    layer.upper[along] = std::min(low + thick, cells.upper[along]);
  }
  return layers;
}

// Of implicit steps: no particle goes farther than 0.8 cells.
double rate_of_displacements(const Level& level, const ParticleSet& set, const Carried& carried) {
  constexpr double max_cells = 0.8;
  double rate = 0;
  for (int d = 0; d < 3; ++d) {
    if (!level.active[d]) continue;
    for (const double v : set.attribute_values(carried.columns.velocity + d))
      rate = std::max(rate, std::fabs(v) / (max_cells * level.spacing[d]));
  }
  return rate;
}

// p.xx: with a grid that stays where it was, the format's p.x is the place at the start, and this
// the place now. Here both are the place now.
DerivedAttribute place_of_format() {
  return {solid_labels().place_of_format,
          [](const ParticleSet& set, std::vector<std::vector<double>>& to) {
            for (int d = 0; d < 3; ++d) std::copy_n(set.coordinate(d), set.size(), to[d].begin());
          }};
}

}  // namespace

SolidParticles::SolidParticles(const Scene& scene, const MpmScene& solids)
    : scene_(&scene), solids_(&solids), seeder_(solids, scene.grid), loads_(solids) {
  for (const SolidMaterial& m : solids.materials) {
    carried_.push_back(carried_by(scene, solids, m));
    ParticleKind& kind = kinds_.emplace_back();
    kind.name = m.name.empty() ? "material " + std::to_string(m.index) : m.name;
    kind.material = m.index;
    kind.attributes = carried_.back().attributes;
    if (carried_.back().columns.size >= 0)
      kind.derived.push_back(scale_factor(carried_.back().columns, scene.grid.levels[0].spacing));
    kind.derived.push_back(
        mean_pressure_of(carried_.back().columns, m.constants.reference_pressure));
    kind.derived.push_back(thermal_volume_of(carried_.back().columns, m.constants));
    if (solids.implicit) kind.derived.push_back(place_of_format());
    if (carried_.back().columns.heating >= 0)
      kind.derived.push_back(rate_of_format(carried_.back().columns));
    kind.by_blocks = true;
    if (scene.refinement.adaptive) kind.refine_distance = 0;
  }
  for (std::size_t z = 0; z < solids.cohesive_zones.size(); ++z)
    kinds_.push_back(cohesive_kind(solids, z));
}

// The loads that act on the particle just added.
void SolidParticles::mark(int kind, const Level& level, const SeededParticles& seeded,
                          std::size_t p, ParticleSet& set) const {
  const Columns& c = carried_[kind].columns;
  Vec3 width{};
  for (int d = 0; d < 3; ++d) width[d] = std::fabs(seeded.edges[4 * d][p]) * level.spacing[d];
  std::array<int, max_marks> named{};
  for (std::size_t n = 0; n < named.size(); ++n)
    if (!seeded.load_curve[n].empty()) named[n] = seeded.load_curve[n][p];
  const std::size_t last = set.size() - 1;
  const auto marks =
      loads_.marks_of(kind, set.position(last), width, seeded.surface[p] != 0, named);
  for (std::size_t n = 0; n < marks.size(); ++n) set.attribute(c.marks + n, last) = marks[n];
}

// What the deck says of the particles in these cells.
void SolidParticles::seed(int kind, const Level& level, const IndexBox& cells,
                          ParticleSet& set) const {
  SeededParticles seeded;
  seeder_.seed(kind, level, cells, {}, seeded);
  if (const std::size_t count = set.size() + seeded.count(); count > set.capacity())
    set.reserve(std::max(count, set.size() + set.size() / 4));
  for (std::size_t p = 0; p < seeded.count(); ++p) {
    set.add({seeded.x[p], seeded.y[p], seeded.z[p]}, seeded.id[p]);
    put_seeded(kind, level, seeded, p, set);
  }
}

// The columns of the particle just added.
void SolidParticles::put_seeded(int kind, const Level& level, const SeededParticles& seeded,
                                std::size_t p, ParticleSet& set) const {
  const Columns& c = carried_[kind].columns;
  const std::size_t n = set.size() - 1;
  const auto put = [&](int column, double value) {
    if (column >= 0) set.attribute(column, n) = value;
  };
  for (int d = 0; d < 3; ++d) put(c.velocity + d, level.active[d] ? seeded.velocity[d][p] : 0.0);
  put(c.mass, seeded.mass[p]);
  put(c.volume_0, seeded.volume[p]);
  put(c.volume, seeded.volume[p]);
  for (int d = 0; d < 3; ++d) put(c.F + 4 * d, 1);
  put(c.temperature, seeded.temperature[p]);
  put(c.concentration, seeded.concentration[p]);
  put(c.colour, seeded.colour[p]);
  for (int d = 0; d < 3 && c.half >= 0; ++d)
    put(c.half + d, 0.5 * std::fabs(seeded.edges[4 * d][p]));
  for (int e = 0; e < 9 && c.size >= 0; ++e) put(c.size + e, seeded.edges[e][p]);
  if (const auto& water = solids_->materials[kind].water) {
    put(c.water_mass, water->porosity * water->density * seeded.volume[p]);
    put(c.pore_pressure, water->initial_pressure);
    put(c.filtered_pressure, water->initial_pressure);
    for (int d = 0; d < 3; ++d) put(c.water_velocity + d, set.attribute(c.velocity + d, n));
  }
  if (c.marks >= 0) mark(kind, level, seeded, p, set);
  for (int d = 0; d < 3 && c.given_force >= 0; ++d)
    put(c.given_force + d, optional(seeded.external_force[d], p));
  for (int d = 0; d < 3 && c.normal >= 0; ++d) put(c.normal + d, optional(seeded.normal[d], p));
  for (int k = 0; k < c.corner_count; ++k)
    for (int d = 0; d < 3; ++d) put(c.corners + 3 * k + d, seeded.corners[p].place[k][d]);
  if (c.outer >= 0) put(c.outer, seeded.corners[p].outer);
  put(carried_[kind].filled, 1);
  if (const int surface = carried_[kind].surface; surface >= 0) {
    const models::SurfaceHistory unlit;
    put(surface, unlit.temperature);
    put(surface + 1, unlit.gradient);
  }
  for (int d = 0; d < 3 && c.reference >= 0; ++d) put(c.reference + d, set.position(n)[d]);
}

void SolidParticles::start(int kind, const Level& level, const IndexBox& cells,
                           ParticleSet& set) const {
  const std::size_t materials = solids_->materials.size();
  if (static_cast<std::size_t>(kind) >= materials) {
    start_cohesive(*solids_, kind - materials, level, cells, set);
    return;
  }
  const SolidMaterial& material = solids_->materials[kind];
  const Carried& carried = carried_[kind];
  const Columns& c = carried.columns;
  const std::size_t begin = set.size();
  for (const IndexBox& layer : layers_of(cells)) seed(kind, level, layer, set);
  if (const auto motion = manufactured_of(*solids_, material, level))
    for (std::size_t n = begin; n < set.size(); ++n) {
      const Vec3 v = motion->velocity(set.position(n), scene_->time.initial_time);
      for (int d = 0; d < 3; ++d)
        if (level.active[d]) set.attribute(c.velocity + d, n) = v[d];
    }
  double wave_speed[chunk_size], heating[chunk_size] = {};
  LawBatch columns;
  for (std::size_t at = begin; at < set.size(); at += chunk_size) {
    const int n = static_cast<int>(std::min<std::size_t>(chunk_size, set.size() - at));
    Batch& b = columns.between(set, set, carried, at, n);
    b.time = scene_->time.initial_time;
    b.wave_speed = wave_speed;
    b.heating = heating;
    for (int d = 0; d < 3; ++d) b.position[d] = set.coordinate(d) + at;
    material.law->start(b);
  }
}

std::optional<std::int64_t> SolidParticles::count_at_start(int kind, const Level& level,
                                                           const IndexBox& cells) const {
  const std::size_t material = kind;
  if (material >= solids_->materials.size()) return std::nullopt;
  std::int64_t count = 0;
  for (const SeedObject& object : solids_->materials[material].objects) {
    const CellLattice lattice{level.anchor, level.spacing};
    if (const std::vector<Vec3>* points = object.piece->points())
      count += std::count_if(points->begin(), points->end(), [&](Vec3 p) {
        return cells.contains(lattice.cell_of(applied(object.map, p) + object.shift));
      });
    else
      count += count_places(
          *object.piece, object, level,
          object.mapped ? window_of(object, level) : intersection(window_of(object, level), cells));
  }
  return count;
}

bool SolidParticles::asks_refinement(int kind, const ParticleSet& set, std::size_t n, int level,
                                     int coarse) const {
  if (level > coarse || solids_->splits.empty()) return true;
  const Columns& c = carried_[kind].columns;
  for (const SplitCriterion& s : solids_->splits) {
    if (s.kind != SplitCriterion::Kind::stress_norm || (s.material >= 0 && s.material != kind))
      continue;
    double norm = 0;  // |sigma|: off the diagonal each counts twice
    for (int e = 0; e < 6; ++e) {
      const double v = set.attribute_values(c.stress + e)[n];
      norm += (e < 3 ? 1 : 2) * v * v;
    }
    if (norm > s.value * s.value) return true;
  }
  return false;
}

void SolidParticles::follow_wrapped(int kind, const Level& level, ParticleSet& set) const {
  if (solids_->carries_corners() && kind < static_cast<int>(carried_.size()))
    wrap_corners(level, carried_[kind].columns, set);
}

// Of put_seeded(): what it leaves alone.
bool SolidParticles::starts_at_zero(int /*kind*/, Label label) const {
  const SolidLabels& l = solid_labels();
  const Label empty[] = {l.acceleration, l.energy,           l.affine,      l.spin,
                         l.split,        l.displacement,     l.viscous,     l.outside_force,
                         l.heat_source,  l.heating,          l.lost_energy, l.lost_heat,
                         l.open_energy,  l.loss_temperature, l.viscous_heat};
  return std::find(std::begin(empty), std::end(empty), label) != std::end(empty);
}

bool SolidParticles::is_absent(const std::string& name) const {
  constexpr std::string_view names[] = {
      "gradPAccNC",  // forces of a fluid act on corners of particles
      "dispNew",     // particles tell how far they have gone
      "p.surface",   // pieces know their surfaces
      // Of the format's single velocity field, which looks for surfaces.
      "p.surfgrad", "g.surf", "g.surfgrad", "g.surfnorm"};
  if (std::find(std::begin(names), std::end(names), name) != std::end(names)) return true;
  // Of the two sides of a crack.
  if (name.starts_with("g.") && (name.ends_with("F0") || name.ends_with("F1"))) return true;
  if (name == "p.xx" && solids_->implicit) return false;
  return is_label_of_laws(name) &&
         std::none_of(kinds_.begin(), kinds_.end(), [&](const ParticleKind& kind) {
           return std::any_of(kind.attributes.begin(), kind.attributes.end(),
                              [&](const ParticleAttribute& a) { return a.label.name() == name; });
         });
}

std::vector<Label> SolidParticles::grid_labels() const {
  return node_labels();
}

void SolidParticles::store_on_grid(const StageScope& scope,
                                   std::vector<GridFields>& by_level) const {
  for (std::size_t l = 0; l < by_level.size(); ++l) {
    SolidStep step(*scene_, *solids_, carried_, kinds_);
    StageScope own = scope;
    std::vector<std::vector<double>> maxima = {(*scope.maxima)[l]};
    own.levels = {scope.levels[l]};
    const Vec3 spacing = scope.levels[l]->level().spacing;
    step.spacings() = {spacing, spacing};
    own.maxima = &maxima;
    store_node_fields(*scene_, *solids_, step, own, by_level[l]);
  }
}

// The wave speed is that of a step of no length from what the particles are.
std::vector<double> SolidParticles::rates(const ParticleCloud& cloud, int l) const {
  std::vector<double> all(rate_count(carried_.size()) + solids_->loads.size());
  std::vector<KindRates> by_kind(carried_.size());
  for (std::size_t k = 0; k < carried_.size(); ++k) {
    const ParticleStore& store = cloud.store(static_cast<int>(k));
    const Columns& c = carried_[k].columns;
    for (int b = 0; b < store.box_count(l); ++b) {
      const ParticleSet& set = store.set(l, b);
      const Level& level = cloud.level(l);
      by_kind[k].add(rates_of(solids_->basis, transfer_grid(*solids_, level, carried_[k].half), set,
                              set, c, 0, set.size()));
      all[0] = std::max(all[0], rate_of_step(static_cast<int>(k), level, set, by_kind[k].wave));
    }
    by_kind[k].to(std::span(all).subspan(1 + k * KindRates::count, KindRates::count));
  }
  return all;
}

double SolidParticles::rate_of_step(int kind, const Level& level, const ParticleSet& set,
                                    double& wave) const {
  const SolidMaterial& material = solids_->materials[kind];
  if (solids_->implicit) return rate_of_displacements(level, set, carried_[kind]);
  if (material.rigid) return 0;
  const Carried& carried = carried_[kind];
  ParticleSet to(set.attribute_count());  // a law writes beside what it reads
  for (int q = 0; q < chunk_size; ++q) to.add({}, 0);
  double wave_speed[chunk_size], heating[chunk_size], still[chunk_size] = {}, rate = 0;
  LawBatch columns;
  for (std::size_t at = 0; at < set.size(); at += chunk_size) {
    const int n = static_cast<int>(std::min<std::size_t>(chunk_size, set.size() - at));
    for (std::size_t a = 0; a < set.attribute_count(); ++a)
      std::copy_n(set.column(a) + at, n, to.column(a));
    Batch& b = columns.between(set, at, to, 0, carried, n);
    for (const double*& l : b.L) l = still;
    b.wave_speed = wave_speed;
    b.heating = heating;
    b.dt = 1e-300;
    std::fill_n(heating, n, 0.0);
    material.law->update(b);
    add_water_to_waves(material, carried.columns, set, set, at, n, wave_speed);
    rate = std::max(rate, step_rate(level, set, carried.columns, *material.law, at, n, wave_speed));
    wave = std::max(wave, wave_rate(level, n, wave_speed));
  }
  return rate;
}

}  // namespace sluice::mpm
