#include "peridynamics/start/point_particles.hpp"

#include <algorithm>
#include <stdexcept>

#include "framework/geometry/point_file.hpp"
#include "framework/geometry/sampling.hpp"
#include "peridynamics/start/family_bound.hpp"

namespace sluice::peridynamics {
namespace {

using Columns = std::vector<std::vector<double>>;

// What is known of each point by its bonds: f(entry, component).
template <class F>
DerivedAttribute looked_up(Label label, const BondedPoints& points, F f) {
  return {label, [&points, f](const ParticleSet& set, Columns& to) {
            for (std::size_t n = 0; n < set.size(); ++n) {
              const int entry = points.entry_of(set.id(n));
              if (entry < 0) throw std::logic_error("a point without its bonds");
              for (std::size_t c = 0; c < to.size(); ++c) to[c][n] = f(entry, c);
            }
          }};
}

// x = X + u.
DerivedAttribute place_now(const PointColumns& columns) {
  return {particle_labels().position,
          [first = columns.displacement](const ParticleSet& set, Columns& to) {
            for (int d = 0; d < 3; ++d) {
              const double *X = set.coordinate(d),
                           *u = set.column(static_cast<std::size_t>(first + d));
              for (std::size_t n = 0; n < set.size(); ++n)
                to[static_cast<std::size_t>(d)][n] = X[n] + u[n];
            }
          }};
}

}  // namespace

PointParticles::PointParticles(const PeriScene& scene, const Grid& grid)
    : scene_(&scene), seeder_(scene.seeds, grid) {
  const FamilyBound bound = bound_families(scene, grid.levels.front());
  largest_family_ = bound.largest;
  typical_family_ = bound.typical;
  carried_ = carried_by(scene, largest_family_);
  bonded_ = std::make_unique<BondedPoints>(scene, carried_.columns);
  read_displacements();
  for (const PeriMaterial& m : scene.materials) {
    ParticleKind& kind = kinds_.emplace_back();
    kind.name = m.name.empty() ? "material " + std::to_string(m.index) : m.name;
    kind.material = m.index;
    kind.attributes = carried_.attributes;
    kind.present = place_now(carried_.columns);
    kind.home = point_labels().reference;
    add_derived(kind);
  }
}

void PointParticles::read_displacements() {
  for (const mpm::SolidMaterial& material : scene_->seeds.materials)
    for (const mpm::SeedObject& object : material.objects) {
      const auto* piece = dynamic_cast<const PointFilePiece*>(object.piece.get());
      if (piece == nullptr) continue;
      const auto found = piece->file().vectors.find("p.displacement");
      if (found == piece->file().vectors.end()) continue;
      for (std::size_t n = 0; n < found->second.size(); ++n) {
        const Vec3 x = piece->file().points[n];
        displacements_[{x.x, x.y, x.z}] = found->second[n];
      }
    }
}

void PointParticles::add_derived(ParticleKind& kind) const {
  const PointLabels& l = point_labels();
  const BondedPoints& b = *bonded_;
  const auto add = [&](Label label, auto f) { kind.derived.push_back(looked_up(label, b, f)); };
  add(l.acceleration,
      [&b](int i, std::size_t c) { return b.present().a[c][static_cast<std::size_t>(i)]; });
  add(l.internal_force, [&b](int i, std::size_t c) {
    return b.force()[c][static_cast<std::size_t>(i)] * b.points().V[static_cast<std::size_t>(i)];
  });
  add(l.horizon, [&b](int i, std::size_t) { return b.horizon(i); });
  add(l.neighbours, [&b](int i, std::size_t) { return static_cast<double>(b.neighbours(i)); });
  add(l.energy_density,
      [&b](int i, std::size_t) { return b.energy()[static_cast<std::size_t>(i)]; });
  add(l.stress, [&b](int i, std::size_t c) {
    constexpr std::size_t of_symmetric[9] = {0, 5, 4, 5, 1, 3, 4, 3, 2};
    return b.stress(i)[of_symmetric[c]];
  });
  if (scene_->any(Law::lps)) {
    add(l.dilatation,
        [&b](int i, std::size_t) { return b.dilatation()[static_cast<std::size_t>(i)]; });
    add(l.weighted_volume, [&b](int i, std::size_t) { return b.weighted_volume(i); });
  }
  if (scene_->breaks() || !scene_->precracks.empty())
    add(l.damage, [&b](int i, std::size_t) { return b.damage(i); });
}

void PointParticles::start(int kind, const Level& level, const IndexBox& cells,
                           ParticleSet& set) const {
  mpm::SeededParticles seeded;
  seeder_.seed(kind, level, cells, {}, seeded);
  set.reserve(set.size() + seeded.count());
  const PointColumns& c = carried_.columns;
  for (std::size_t p = 0; p < seeded.count(); ++p) {
    set.add({seeded.x[p], seeded.y[p], seeded.z[p]}, seeded.id[p]);
    const std::size_t n = set.size() - 1;
    set.attribute(static_cast<std::size_t>(c.volume), n) = seeded.volume[p];
    set.attribute(static_cast<std::size_t>(c.mass), n) = seeded.mass[p];
    for (int d = 0; d < 3; ++d)
      if (level.active[d])
        set.attribute(static_cast<std::size_t>(c.velocity + d), n) =
            seeded.velocity[static_cast<std::size_t>(d)][p];
    if (displacements_.empty()) continue;
    const auto given = displacements_.find({seeded.x[p], seeded.y[p], seeded.z[p]});
    if (given == displacements_.end()) continue;
    for (int d = 0; d < 3; ++d)
      if (level.active[static_cast<std::size_t>(d)])
        set.attribute(static_cast<std::size_t>(c.displacement + d), n) = given->second[d];
  }
}

std::optional<std::int64_t> PointParticles::count_at_start(int kind, const Level& level,
                                                           const IndexBox& cells) const {
  const CellLattice lattice{level.anchor, level.spacing};
  std::int64_t count = 0;
  for (const mpm::SeedObject& object :
       scene_->seeds.materials[static_cast<std::size_t>(kind)].objects) {
    if (const std::vector<Vec3>* points = object.piece->points())
      count += std::count_if(points->begin(), points->end(),
                             [&](Vec3 p) { return cells.contains(lattice.cell_of(p)); });
    else
      count += mpm::count_places(*object.piece, object, level,
                                 intersection(mpm::window_of(object, level), cells));
  }
  return count;
}

void PointParticles::laid_out(const ParticleCloud& cloud, const ThreadTeam* team) const {
  bonded_->make(cloud, team, world());
}

bool PointParticles::starts_at_zero(int /*kind*/, Label label) const {
  return label == point_labels().displacement;
}

std::vector<double> PointParticles::rates(const ParticleCloud& /*cloud*/, int /*level*/) const {
  return {bonded_->step_rate()};
}

}  // namespace sluice::peridynamics
