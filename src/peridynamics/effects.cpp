#include "peridynamics/effects.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace sluice::peridynamics {
namespace {

std::size_t count(const PeriScene& s, Law law) {
  return static_cast<std::size_t>(std::count_if(
      s.materials.begin(), s.materials.end(), [&](const PeriMaterial& m) { return m.law == law; }));
}

std::string text_of_weights(const PeriScene& s) {
  constexpr const char* influences[] = {"influence 1", "influence 1 - r/horizon",
                                        "influence horizon/r"};
  return fmt::format(
      "{}, {}", influences[static_cast<int>(s.influence)],
      s.partial_volume == PartialVolume::ramp ? "partial volumes by a ramp" : "no partial volumes");
}

}  // namespace

EffectList effects_of(const PeriScene& s) {
  EffectList list;
  constexpr const char* planes[] = {"three dimensions", "plane strain", "plane stress", "a line"};
  list.add({"bonds",
            true,
            fmt::format("{} material{}, {}, horizon up to {:g} m, {}", s.materials.size(),
                        s.materials.size() == 1 ? "" : "s", planes[static_cast<int>(s.plane)],
                        s.largest_horizon(), text_of_weights(s)),
            {}});
  const std::size_t lps = count(s, Law::lps);
  list.add({"dilatation", lps > 0,
            lps > 0
                ? fmt::format("linear_elastic_state in {} of {} materials", lps, s.materials.size())
                : "all materials are bond-based",
            s.materials.front().where});
  const auto fails = [](const PeriMaterial& m) {
    return m.damage.criterion != DamageModel::Criterion::none;
  };
  const auto first = std::find_if(s.materials.begin(), s.materials.end(), fails);
  list.add({"damage", s.breaks(),
            s.breaks() ? fmt::format("<damage_model> in {} of {} materials",
                                     std::count_if(s.materials.begin(), s.materials.end(), fails),
                                     s.materials.size())
                       : "no <damage_model>",
            s.breaks() ? first->damage.where : Location{}});
  list.add({"pre-cracks", !s.precracks.empty(), fmt::format("{} <precrack>", s.precracks.size()),
            s.precracks.empty() ? Location{} : s.precracks.front().where});
  list.add({"images at symmetric sides",
            !s.mirrors.empty(),
            fmt::format("{} symmetric sides", s.mirrors.size()),
            {}});
  list.add({"contact", false, "no <ContactModel>", {}});
  list.add({"gravity", s.gravity != Vec3{},
            fmt::format("gravity is [{:g}, {:g}, {:g}]", s.gravity.x, s.gravity.y, s.gravity.z),
            s.gravity_where});
  list.add({"damping", s.damping > 0, fmt::format("damping is {:g}", s.damping), {}});
  return list;
}

}  // namespace sluice::peridynamics
