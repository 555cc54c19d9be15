#include "mpmice/burn/solid_burning.hpp"

#include "mpmice/burn/burning_outputs.hpp"
#include "mpmice/burn/explosive.hpp"
#include "mpmice/burn/surface_burning.hpp"

namespace sluice::mpmice {

template <int D>
class SolidBurning<D>::Forms final : public models::BurningForms {
 public:
  // `switches`: of outputs, those that are left.
  Forms(SolidBurning& burning, const BurningStep<D>& step, const models::SolidBurn& burn,
        std::span<double>& switches)
      : burning_(burning),
        step_(step),
        burn_(burn),
        switches_(switches),
        shares_(step.sets.all().size()) {}

  bool burn_surfaces(const models::SurfaceLaw& law) override {
    mpmice::burn_surfaces(step_, burn_, law, shares_);
    return give(burn_.product, burn_.law->heat_of_reaction(), shares_, {});
  }
  bool burn_cells(const models::CellLaw& law) override {
    Column in_cells;
    mpmice::burn_cells(step_, burn_, law, in_cells);
    share_by_cells(step_, burn_, in_cells, shares_);
    return give(burn_.product, burn_.law->heat_of_reaction(), shares_, in_cells);
  }
  bool burn_explosive(const models::Ddt1& law) override {
    Explosive<D> explosive(step_, burn_, law);
    const ExplosiveShares shares = explosive.burn();
    explosive.pass_switches(switches_);
    switches_ = switches_.subspan(law.switches.size());
    const double flame_heat = law.flame.heat();
    bool any = give(burn_.product, law.detonation.heat, shares.detonated, explosive.detonates());
    any |= give(law.surface_product, flame_heat, shares.of_surfaces, {});
    any |= give(burn_.product, flame_heat, shares.of_cracks, {});
    explosive.store(shares);
    return any;
  }

 private:
  bool give(int product, double heat, const std::vector<Column>& shares, const Column& in_cells) {
    return burning_.products_.give(
        step_, product, burning_.particles_.take(step_.sets, burn_.solid, product, heat, shares),
        in_cells);
  }

  SolidBurning& burning_;
  const BurningStep<D>& step_;
  const models::SolidBurn& burn_;
  std::span<double>& switches_;
  std::vector<Column> shares_;  // of the particles' masses that burn, by set of particles
};

template <int D>
bool SolidBurning<D>::burn(const BurningStep<D>& step) {
  const StageScope& scope = step.scope;
  particles_.begin(step.sets);
  products_.begin(step.amounts, step.near.size());
  std::span<double> switches = places_.switches.of(*scope.sums);
  bool any = false;
  std::vector<Column> given(step.sets.kinds().size());
  for (const models::SolidBurn& burn : burns_) {
    const Column before = products_.all();
    Forms forms(*this, step, burn, switches);
    any |= burn.law->burn(forms);
    const Column now = products_.all();
    Column& of_solid = given[static_cast<std::size_t>(burn.solid)];
    of_solid.resize(now.size());
    for (std::size_t i = 0; i < now.size(); ++i) of_solid[i] += now[i] - before[i];
  }
  store_given_mass(step, given, products_.made());
  if (!any) return false;
  particles_.book(*scope.ranks, places_.burned.of(*scope.sums));
  particles_.expose_neighbours(step.near, step.sets, *scope.ranks);
  particles_.note(*scope.journal, step.sets);
  return true;
}

template class SolidBurning<1>;
template class SolidBurning<2>;
template class SolidBurning<3>;

}  // namespace sluice::mpmice
