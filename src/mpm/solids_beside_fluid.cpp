#include "mpm/solids_beside_fluid.hpp"

#include "mpm/levels/solid_levels.hpp"
#include "mpm/mpm.hpp"
#include "mpm/shape/axis.hpp"

namespace sluice::mpm {
namespace {

solids::ParticleColumns columns_beside_fluid(const Carried& carried) {
  const Columns& c = carried.columns;
  solids::ParticleColumns to;
  to.mass = c.mass;
  to.volume = c.volume;
  to.volume_0 = c.volume_0;
  to.velocity = c.velocity;
  to.spin = c.spin;
  to.corners = c.corners;
  to.outer = c.outer;
  to.stress = c.stress;
  to.temperature = c.temperature;
  to.energy = c.energy;
  to.lost_heat = c.lost_heat;
  to.open_energy = c.open_energy;
  to.with_mass = c.of_losses();
  to.filled = carried.filled;
  to.surface = carried.surface;
  to.flame = carried.flame;
  to.crack_radius = column_of(carried, "p.crackRad");
  return to;
}

class SolidsBesideFluid final : public solids::CoupledSolids {
 public:
  explicit SolidsBesideFluid(const Mpm& solids)
      : solids_(&solids), kinds_(kinds_beside_fluid(solids)), levels_(solids.make_step()) {}

  const std::vector<solids::SolidKind>& kinds() const override { return kinds_; }
  solids::BookedSums sums() const override {
    using Of = StepSums;
    return {Of::impulse_x,       Of::reaction_x,    Of::work,
            Of::heat_from_fluid, Of::exchange_gain, Of::surface_work};
  }
  double unit_of_places(int direction) const override {
    return axis_of(solids_->run_scene().grid.levels.back(), direction).unit;
  }

  void declare_start(StepShape& step) override;
  void declare_pass(StepShape& step) override {
    add(step, "bounds of the sums", &SolidLevels::begin);
  }
  void declare_motion(StepShape& step) override;
  void declare_commit(StepShape& step) override { add(step, "take over", &SolidLevels::commit); }

  double wave_rate(int kind) const override { return finest().body(kind).rates.wave; }
  double heaviest(int kind) const override { return finest().body(kind).rates.mass; }
  bool is_prescribed(int kind) const override { return finest().motion_of(kind) != nullptr; }
  Vec3 prescribed_velocity(int kind, Vec3 place) const override {
    return finest().motion_of(kind)->at(place);
  }
  double farthest_way() const override { return finest().outcome().travel; }
  double largest_extent(int kind) const override {
    const std::size_t first = 1 + static_cast<std::size_t>(kind * KindRates::count);
    return KindRates::from(std::span(finest().outcome().rates).subspan(first)).extent;
  }
  bool any_left() const override { return finest().outcome().left; }

  void add_corner_forces(const StageScope& scope,
                         std::vector<solids::CornerForces> forces) override {
    std::vector<std::vector<solids::CornerForces>> of_levels(levels_->count());
    for (auto& of_level : of_levels) of_level.resize(kinds_.size());
    of_levels.back() = std::move(forces);
    levels_->add_corner_forces(scope, of_levels);
  }
  void include_velocities(int kind, Vec3 most, Vec3 most_negative) override {
    finest().include_velocities(kind, most, most_negative);
  }
  void relocate(ParticleCloud& particles) override { levels_->relocate(particles); }

 private:
  SolidStep& finest() const { return levels_->level(levels_->count() - 1); }
  void add(StepShape& step, const char* name,
           Verdict (SolidLevels::*act)(const StageScope&)) const {
    step.stage(
        name, [levels = levels_, act](const StageScope& scope) { return ((*levels).*act)(scope); });
  }

  const Mpm* solids_;
  std::vector<solids::SolidKind> kinds_;
  std::shared_ptr<SolidLevels> levels_;
};

void SolidsBesideFluid::declare_start(StepShape& step) {
  declare_pass(step);
  if (solids_->scene().midpoint() && files_give_velocities(solids_->scene()))
    add(step, "spins of the start", &SolidLevels::start_spins);
}

void SolidsBesideFluid::declare_motion(StepShape& step) {
  add(step, "particles to grid", &SolidLevels::to_grid);
  add(step, "sums of images and ranks", &SolidLevels::share_sums);
  add(step, "nodes: contact, forces, contact, boundary", &SolidLevels::move_nodes);
  if (solids_->scene().transfer == Transfer::xpic)
    add(step, "filtered velocities (XPIC)", &SolidLevels::filter_velocities);
  if (solids_->scene().midpoint())
    add(step, "new velocities; to grid at the middle of the step", &SolidLevels::map_back);
  add(step, "grid to particles, deformation, stress", &SolidLevels::from_grid);
}

}  // namespace

std::vector<solids::SolidKind> kinds_beside_fluid(const Mpm& solids) {
  std::vector<solids::SolidKind> kinds;
  const MpmScene& scene = solids.scene();
  for (std::size_t k = 0; k < scene.materials.size(); ++k) {
    const SolidMaterial& material = scene.materials[k];
    const MaterialConstants& constants = material.constants;
    kinds.push_back({material.name, material.rigid, constants.density, constants.specific_heat,
                     scene.heat_conduction ? constants.conductivity : 0.0,
                     constants.reference_pressure, columns_beside_fluid(solids.carried()[k])});
  }
  return kinds;
}

std::shared_ptr<solids::CoupledSolids> make_solids_beside_fluid(const Mpm& solids) {
  return std::make_shared<SolidsBesideFluid>(solids);
}

}  // namespace sluice::mpm
