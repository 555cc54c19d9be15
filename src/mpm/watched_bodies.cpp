// The bodies that a run watches: solids that deform and are free.
#include <fmt/format.h>

#include <span>

#include "framework/base/lowest_text.hpp"
#include "framework/run/levels/particle_cloud.hpp"
#include "mpm/mpm.hpp"
#include "mpm/step/step_sums.hpp"

namespace sluice::mpm {

std::vector<BodyEnergy> MpmBudgets::body_energies(const std::vector<double>& sums) const {
  const std::span<const double> own = mpm_->sums().of(sums);
  std::vector<BodyEnergy> bodies;
  // Prescribed deformation has its work by definition; cohesive zones keep energy between bodies.
  if (!mpm_->scene().prescribed_file.empty() || !mpm_->scene().cohesive_zones.empty())
    return bodies;
  for (std::size_t m = 0; m < mpm_->scene().materials.size(); ++m) {
    const SolidMaterial& material = mpm_->scene().materials[m];
    // Water in pores has a velocity and an energy of its own.
    if (material.rigid || material.water) continue;
    using Of = BodyEnergySums;
    const std::size_t first = StepSums::of_body(mpm_->scene().materials.size(), m);
    const auto of = [&](Of::Index n) { return own[first + n]; };
    BodyEnergy b;
    b.name = material.name;
    b.material = static_cast<int>(m);
    b.mass = of(Of::mass);
    b.kinetic_before = of(Of::kinetic_before);
    b.kinetic_middle = of(Of::kinetic_middle);
    b.kinetic_after = of(Of::kinetic_after);
    b.stored_before = of(Of::stored_before);
    b.stored_after = of(Of::stored_after);
    b.work = of(Of::node_gain) - of(Of::node_work) + of(Of::load_work) + of(Of::corner_work);
    b.kick = of(Of::kick);
    b.contact_slack = of(Of::contact_slack);
    b.heat = of(Of::heat);
    b.returned = of(Of::lost_heat) - of(Of::contact_heat);
    b.lost = of(Of::lost);
    b.parted = of(Of::parted);
    b.particles = of(Of::particles);
    bodies.push_back(b);
  }
  return bodies;
}

// Beside a fluid all particles carry corners: there is no choice.
std::string MpmBudgets::better_for_energy() const {
  if (mpm_->scene().midpoint() || mpm_->scene().total_lagrangian || mpm_->scene().implicit ||
      mpm_->scene().any_water())
    return "";
  if (mpm_->scene().basis == Basis::linear)
    return "<interpolator> gimp or cpdi: particles of the interpolator linear are points, which "
           "convert rotation into strain";
  return "the default transfer midpoint (no <transfer>, <musl> and similar tags), which preserves "
         "vibration and rotation";
}

// The particle of a material whose energy has grown most in an attempted step, on all ranks.
std::string MpmBudgets::place_of_gain(const ParticleCloud& cloud, int material,
                                      Communicator& ranks) const {
  const Columns& c = mpm_->carried()[material].columns;
  const ParticleStore& store = cloud.store(material);
  double most = 0;
  std::string text;
  for (int l = 0; l < store.level_count(); ++l)
    for (int b = 0; b < store.box_count(l); ++b) {
      const ParticleSet &set = store.set(l, b), &next = store.next(l, b);
      const double* mass = set.column(c.mass);
      const std::size_t energy = c.energy;
      const auto v = read_columns<3>(set, c.velocity), w = read_columns<3>(next, c.velocity);
      for (std::size_t p = 0; p < set.size(); ++p) {
        double gain = next.column(energy)[p] - set.column(energy)[p];
        for (std::size_t d = 0; d < 3; ++d)
          gain += 0.5 * mass[p] * (w[d][p] * w[d][p] - v[d][p] * v[d][p]);
        if (!(gain > most)) continue;
        most = gain;
        const Vec3 x = set.position(p);
        text = fmt::format("; most of it at [{:g}, {:g}, {:g}]", x.x, x.y, x.z);
      }
    }
  Reduction all;
  const auto largest = all.add_maximum(most);
  ranks.reduce(all);
  if (most < all.maximum(largest)) text.clear();
  return lowest_text(ranks, text);
}

}  // namespace sluice::mpm
