// A block of particles in a few cells, and the fluid around it, for tests that build one class of
// the coupling alone.
#pragma once
#include <memory>

#include "framework/base/communicator.hpp"
#include "framework/deck/format/framework_schema.hpp"
#include "framework/deck/load_deck.hpp"
#include "framework/solve/solver_tags.hpp"
#include "ice/deck/schema.hpp"
#include "ice/fluid/labels.hpp"
#include "mpm/deck/schema.hpp"
#include "mpmice/make_component.hpp"
#include "mpmice/surfaces/surfaces.hpp"
#include "mpmice/test_support/coupled_deck.hpp"

namespace sluice::mpmice {

// n cells of width h along each of D directions.
template <int D>
Level level_of(int n, double h, bool periodic = false) {
  Level level;
  level.spacing = {h, h, h};
  for (int d = 0; d < 3; ++d) {
    level.active[static_cast<std::size_t>(d)] = d < D;
    level.periodic[static_cast<std::size_t>(d)] = periodic && d < D;
    level.domain.upper[d] = d < D ? n : 1;
  }
  level.boxes = {{level.domain, 0, 0}};
  return level;
}

// Solids whose answers a test sets.
class GivenSolids final : public solids::CoupledSolids {
 public:
  std::vector<solids::SolidKind> materials;
  double waves = 0, mass = 1, way = 0, extent = 0;
  bool left = false;
  std::optional<Vec3> prescribed;

  std::vector<solids::CornerForces> forces;  // given back
  Vec3 most{}, most_negative{};

  const std::vector<solids::SolidKind>& kinds() const override { return materials; }
  solids::BookedSums sums() const override { return {0, 3, 6, 7, 8, 9}; }
  double unit_of_places(int) const override { return 0x1p-40; }
  void declare_start(StepShape&) override {}
  void declare_pass(StepShape&) override {}
  void declare_motion(StepShape&) override {}
  void declare_commit(StepShape&) override {}
  double wave_rate(int) const override { return waves; }
  double heaviest(int) const override { return mass; }
  bool is_prescribed(int) const override { return prescribed.has_value(); }
  Vec3 prescribed_velocity(int, Vec3) const override { return *prescribed; }
  double farthest_way() const override { return way; }
  double largest_extent(int) const override { return extent; }
  bool any_left() const override { return left; }
  void add_corner_forces(const StageScope&, std::vector<solids::CornerForces> given) override {
    forces = std::move(given);
  }
  void include_velocities(int, Vec3 up, Vec3 down) override {
    most = up;
    most_negative = down;
  }
  void relocate(ParticleCloud&) override {}
};

// A block of one particle a cell, `low` to `high` cells along each direction, in n cells of width
// h; at the end of the step it lies `way` cells farther along the first direction.
template <int D>
struct BlockInCells {
  static constexpr int stress_column = 7 + 3 * (1 << D);
  Level level;
  NearCells<D> near;
  GivenSolids solids;
  ParticleSet set{static_cast<std::size_t>(stress_column + 9)}, next = set;
  SolidSets<D> sets;
  Surfaces<D> surfaces;

  BlockInCells(int n, double h, double low, double high, double way = 0, bool rigid = false,
               bool viscous = false, double density = 1000)
      : level(level_of<D>(n, h)),
        near(level),
        sets(kinds_of(solids, rigid, density), false),
        surfaces(solids, viscous) {
    fill(low, high, density);
    next = set;
    for (std::size_t p = 0; p < next.size(); ++p) {
      Vec3 place = next.position(p);
      place[0] += way * h;
      next.move_to(p, place);
      for (int k = 0; k < (1 << D); ++k)
        next.column(static_cast<std::size_t>(columns().corners + 3 * k))[p] += way * h;
    }
    SolidSet<D>& s = sets.all().emplace_back();
    s.columns = &columns();
    s.present = &set;
    s.set = &set;
    s.next = &next;
    OccupiedCells<D>& occupied = near.begin();
    sets.add_cells(near.frame(), 1, occupied);
    near.finish(level, level.boxes, world());
  }
  BlockInCells(const BlockInCells&) = delete;
  BlockInCells& operator=(const BlockInCells&) = delete;

  const solids::ParticleColumns& columns() const { return solids.materials.front().columns; }
  // Of all particles, at both ends of the step.
  void give(int column, double value) {
    for (ParticleSet* of : {&set, &next})
      std::fill_n(of->column(static_cast<std::size_t>(column)), of->size(), value);
  }
  // Surfaces at the start, fractions as they are found; and at the end.
  void find_surfaces() {
    const Warehouse none = fractions();
    surfaces.begin(near, sets, none, 0, world());
    surfaces.add_means(near, sets, 1, world());
    surfaces.finish(near, sets, world());
  }
  void find_moved() { surfaces.find_moved(near, sets, world()); }
  std::size_t at(Cell<D> c) const { return near.frame().cells.index(c); }

 private:
  static const std::vector<solids::SolidKind>& kinds_of(GivenSolids& solids, bool rigid,
                                                        double density) {
    solids::SolidKind kind;
    kind.name = "block";
    kind.rigid = rigid;
    kind.density = density;
    kind.specific_heat = 1000;
    kind.columns.mass = 0;
    kind.columns.volume = 1;
    kind.columns.volume_0 = 2;
    kind.columns.velocity = 3;
    kind.columns.outer = 6;
    kind.columns.corners = 7;
    kind.columns.stress = stress_column;
    kind.columns.temperature = stress_column + 6;
    kind.columns.energy = stress_column + 7;
    solids.materials = {kind};
    return solids.materials;
  }
  // Particles whose parts of the block are cut at whole cells from its low corner.
  void fill(double low, double high, double density) {
    const double h = level.spacing.x;
    const int along = static_cast<int>(std::ceil(high - low - 1e-12));
    int count = 1;
    for (int d = 0; d < D; ++d) count *= along;
    for (int n = 0; n < count; ++n) {
      double ends[2][3] = {{0, 0, 0}, {h, h, h}};
      int outer = 0;
      double volume = 1;
      for (int d = 0, rest = n; d < D; ++d, rest /= along) {
        const int k = rest % along;
        ends[0][d] = (low + k) * h;
        ends[1][d] = std::min(low + k + 1, high) * h;
        outer |= (k == 0 ? 1 << (2 * d) : 0) | (k + 1 == along ? 2 << (2 * d) : 0);
      }
      Vec3 middle{};
      for (int d = 0; d < 3; ++d) {
        middle[d] = 0.5 * (ends[0][d] + ends[1][d]);
        volume *= ends[1][d] - ends[0][d];
      }
      set.add(middle, n);
      const auto p = static_cast<std::size_t>(n);
      set.column(0)[p] = density * volume;
      set.column(1)[p] = set.column(2)[p] = volume;
      set.column(6)[p] = outer;
      for (int k = 0; k < (1 << D); ++k)
        for (int d = 0; d < 3; ++d)
          set.column(static_cast<std::size_t>(7 + 3 * k + d))[p] =
              d < D ? ends[k >> d & 1][d] : middle[d];
    }
  }
  // The geometry itself, in place of what an earlier step has left.
  Warehouse fractions() {
    Warehouse state(level, 0);
    const int slot = state.add({ice::labels().solid_fraction, 0, 1, 0});
    SurfaceGeometry<D> geometry;
    SolidInCells<D> found;
    sets.find_faces(near, false, world());
    geometry.begin_at_start(near.frame(), sets.all());
    geometry.finish_at_start(near.frame(), sets.all(), nullptr, found);
    clean_volume_fractions(found.theta);
    const RealView to = state.view(slot, 0, 0);
    near.frame().for_each_held(level.domain,
                               [&](IntVec3 c, std::size_t i) { to(c) = found.theta[i]; });
    return state;
  }
};

// The gas of a coupled deck as a part of its component.
class GivenFluid {
 public:
  explicit GivenFluid(CoupledDeck deck = {}) {
    Schema tags;
    add_framework_tags(tags);
    solve::add_solver_tag(tags);
    add_ice_tags(tags);
    mpm::add_mpm_tags(tags);
    const Deck read = load_deck_text(text_of(deck), "coupled.ups", {}, tags);
    std::vector<Fault> faults = read.faults;
    throw_errors(faults);
    scene_ = read_scene(read, {}, faults);
    component_ = make_component(read, scene_, faults);
    throw_errors(faults);
  }
  const ice::FluidPart& part() const { return component_->fluid().part(); }
  const MpmIce& component() const { return *component_; }
  const Scene& scene() const { return scene_; }

 private:
  static void throw_errors(const std::vector<Fault>& faults) {
    for (const Fault& fault : faults)
      if (fault.severity == Severity::error) throw InputError(to_string(fault));
  }

  Scene scene_;
  std::unique_ptr<MpmIce> component_;
};

}  // namespace sluice::mpmice
