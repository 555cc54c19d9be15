// From the deck's conditions of one boundary region to a rule for several materials.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "framework/base/error.hpp"
#include "ice/boundary/region_rules.hpp"

namespace sluice::ice {
namespace {

// threshold: share of the largest density at a side below which a material counts as absent; unit:
//   1; test: MixtureGhosts.ATraceOfDensityIsNone
constexpr double min_given_density = 1e-9;
// coefficient: the pressures between which the one is sought at which densities and temperatures
//   fill a cell; unit: Pa
constexpr double lowest_sought = 1e-12;
// coefficient: the same, upwards; unit: Pa
constexpr double highest_sought = 1e15;
// threshold: relative width of a bracket at which the bisection ends; unit: 1; test:
//   MixtureGhosts.AnOutletPressureIsThatOfAllMaterials
constexpr double bracket_ends = 1e-15;
constexpr int max_bisections = 200;

using Part = MixtureRule::Part;

bool temperature_known(const Part& part) {
  return part.rule.fixed_temperature;
}

class MixtureRuleMaker {
 public:
  MixtureRuleMaker(const BoundaryRegion& region, std::span<const IceMaterial> materials,
                   const FlowConditions& conditions)
      : region_(region), materials_(materials), conditions_(conditions) {}

  MixtureRule make(int normal) {
    double densest = 0;
    for (const IceMaterial& material : materials_) {
      Part part;
      part.rule = make_rule(region_, material.number(), normal, conditions_);
      if (part.rule.exact_flow())
        refuse("its conditions give the exact flow of one gas; this deck has {} materials",
               materials_.size());
      densest = std::max(densest, part.rule.density);
      rule_.parts.push_back(part);
    }
    for (Part& part : rule_.parts)
      part.absent = part.rule.fixed_density && part.rule.density <= min_given_density * densest;
    check_waves();
    find_volumes();
    find_common();
    return rule_;
  }

 private:
  template <class... Arguments>
  [[noreturn]] void refuse(fmt::format_string<Arguments...> text, Arguments&&... arguments) const {
    throw InputError(fmt::format("{}: {}: {}", to_string(region_.where), region_.name,
                                 fmt::format(text, std::forward<Arguments>(arguments)...)));
  }

  std::string name(std::size_t m) const {
    const IceMaterial& material = materials_[m];
    return material.name.empty()
               ? fmt::format("material {}", material.number())
               : fmt::format("material {} ({})", material.number(), material.name);
  }
  template <class Use>
  void each_present(Use use) {
    for (std::size_t m = 0; m < rule_.parts.size(); ++m)
      if (!rule_.parts[m].absent) use(m, rule_.parts[m]);
  }
  // Waves belong to the mixture: open for all materials, or for none.
  void check_waves() const {
    const auto open = [](const Part& part) { return part.rule.waves; };
    if (std::none_of(rule_.parts.begin(), rule_.parts.end(), open)) return;
    for (std::size_t m = 0; m < rule_.parts.size(); ++m) {
      const GhostRule& rule = rule_.parts[m].rule;
      if (!rule.waves) refuse("LODI for some materials, but not for {}; write it for all", name(m));
      if (rule.fixed_density || rule.fixed_temperature)
        refuse(
            "LODI together with a given {} of {}; with several materials give the pressure or "
            "velocity",
            rule.fixed_density ? "density" : "temperature", name(m));
    }
  }
  // What a material of this density fills at a pressure.
  double volume_at(std::size_t m, double pressure) const {
    const Part& part = rule_.parts[m];
    if (part.rule.specific_volume > 0) return part.rule.density * part.rule.specific_volume;
    return part.rule.density / materials_[m].fluid.density(pressure, part.rule.temperature);
  }

  // Where all densities are given.
  void find_volumes() {
    std::vector<std::size_t> present;
    bool all = true, known = true;
    each_present([&](std::size_t m, const Part& part) {
      present.push_back(m);
      all = all && part.rule.fixed_density;
      known = known && (part.rule.specific_volume > 0 || temperature_known(part));
    });
    if (!all) {
      for (const std::size_t m : present) {
        const Part& part = rule_.parts[m];
        if (part.rule.fixed_density && part.rule.specific_volume <= 0 && !temperature_known(part))
          refuse("the density of {} is given, but not its volume; give its Temperature too",
                 name(m));
      }
      return;
    }
    if (present.size() == 1) {
      rule_.parts[present.front()].volume = 1.0;
      return;
    }
    if (!known)
      refuse(
          "the densities of {} materials are given, but not their volumes; give the Temperature or "
          "the SpecificVol of each",
          present.size());
    const bool from_volumes = std::all_of(present.begin(), present.end(), [&](std::size_t m) {
      return rule_.parts[m].rule.specific_volume > 0;
    });
    GhostRule& pressure = rule_.parts.front().rule;
    if (pressure.pressure_flow != nullptr && !from_volumes)
      refuse("give the SpecificVol of each material where the pressure oscillates");
    if (!pressure.fixed_pressure && !from_volumes) {
      const double found = filling_pressure(present);
      for (Part& part : rule_.parts) {
        part.rule.fixed_pressure = true;
        part.rule.pressure = found;
      }
    }
    double sum = 0;
    for (const std::size_t m : present) {
      Part& part = rule_.parts[m];
      part.volume = volume_at(m, pressure.pressure);
      if (!(part.volume > 0))
        refuse("{} has no admissible state at {:.6g} Pa and {:.6g} K", name(m), pressure.pressure,
               part.rule.temperature);
      sum += part.volume;
    }
    if (!(std::fabs(sum - 1.0) <= unfilled))
      refuse(
          "the materials fill {:.9g} of a cell, not all of it: Density is mass per volume of the "
          "cell; change it, or the Temperature or SpecificVol",
          sum);
    for (const std::size_t m : present) rule_.parts[m].volume /= sum;
  }

  // Volumes fall with pressure: bisection in its logarithm.
  double filling_pressure(const std::vector<std::size_t>& present) const {
    const auto excess = [&](double p) {
      double sum = -1;
      for (const std::size_t m : present) sum += volume_at(m, p);
      return sum;
    };
    double low = lowest_sought, high = highest_sought;
    if (!(excess(low) > 0) || !(excess(high) < 0))
      refuse(
          "there is no pressure at which materials with these densities and temperatures fill a "
          "cell");
    for (int n = 0; n < max_bisections && high > low * (1 + bracket_ends); ++n) {
      const double middle = std::sqrt(low * high);
      (excess(middle) > 0 ? low : high) = middle;
    }
    return std::sqrt(low * high);
  }

  void find_common() {
    rule_.plain = true;
    const Part* first = nullptr;
    std::size_t index = 0;
    each_present([&](std::size_t m, const Part& part) {
      if (first == nullptr) {
        first = &part;
        index = m;
      }
      if (part.rule.mirrored() != first->rule.mirrored())
        refuse(
            "a wall for {} but not for {}, although the materials have one velocity; give all the "
            "same kind of Velocity",
            name(first->rule.mirrored() ? index : m), name(first->rule.mirrored() ? m : index));
      rule_.plain = rule_.plain && part.rule.plain();
    });
    if (first == nullptr) refuse("no material is present");
    rule_.common = first->rule;
    const auto absent = [](const Part& part) { return part.absent; };
    rule_.plain = rule_.plain && std::none_of(rule_.parts.begin(), rule_.parts.end(), absent);
  }

  const BoundaryRegion& region_;
  std::span<const IceMaterial> materials_;
  const FlowConditions& conditions_;
  MixtureRule rule_;
};

}  // namespace

MixtureRule make_mixture_rule(const BoundaryRegion& region, std::span<const IceMaterial> materials,
                              int normal, const FlowConditions& conditions) {
  return MixtureRuleMaker(region, materials, conditions).make(normal);
}

}  // namespace sluice::ice
