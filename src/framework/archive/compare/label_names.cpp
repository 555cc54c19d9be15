// The table of names, read in both directions.
#include "framework/archive/compare/label_names.hpp"

#include <fmt/format.h>

#include "framework/base/error.hpp"

namespace sluice {

std::span<const LabelName> label_names() {
  static const std::vector<LabelName> names = {
      {"p.deformationGradient", "p.deformationMeasure"},
      {"p.localized", "p.localizedMPM"},
      {"p.localizedDamage", "p.localizedMPM"},
      {"p.localizedBD", "p.localizedMPM"},
      {"p.damageBD", "p.damage"},
      {"p.epsfBD", "p.epsf"},
      {"p.timeoflocBD", "p.timeofloc"},
      {"p.eqPlasticStrain", "p.plasticStrain"},
      {"p.eqPlasticStrainRate", "p.plasticStrainRate"},
      {"p.eqStrainRate", "p.strainRate"},
      {"p.plasticStrainVol", "p.plasticVolStrain"},
      {"p.elasticStrainVol", "p.elasticVolStrain"},
      {"p.yield", "p.yieldStress"},
      {"p.CapX", "p.capX"},
  };
  return names;
}

std::vector<std::string> names_elsewhere(const std::string& label,
                                         const std::vector<LabelName>& more) {
  std::vector<std::string> names;
  const auto add = [&](const LabelName& n) {
    if (n.raw == label) names.push_back(n.own);
    if (n.own == label) names.push_back(n.raw);
  };
  for (const LabelName& n : more) add(n);
  names.push_back(label);
  for (const LabelName& n : label_names()) add(n);
  if (label.size() > 1 && label.back() == '+') names.push_back(label.substr(0, label.size() - 1));
  return names;
}

std::string label_names_help() {
  std::string text =
      "RAW=OWN: between formats, a label of the raw archive and that of Sluice that is the same "
      "quantity, besides the same name and";
  for (const LabelName& n : label_names()) text += fmt::format(" {}={}", n.raw, n.own);
  return text;
}

LabelName parse_label_name(const std::string& text) {
  const std::size_t sign = text.find('=');
  if (sign == text.npos || sign == 0 || sign + 1 == text.size())
    throw InputError(fmt::format("--same {}: expected two labels, RAW=OWN", text));
  return {text.substr(0, sign), text.substr(sign + 1)};
}

}  // namespace sluice
