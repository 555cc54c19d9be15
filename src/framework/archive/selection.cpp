// Choosing fields by name, with the nearest thing to try when there is none.
#include "framework/archive/selection.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "framework/base/error.hpp"

namespace sluice {
namespace {

bool holds(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

template <class T>
std::string listed(const std::set<T>& items) {
  std::string text;
  for (const T& i : items) text += fmt::format("{}{}", text.empty() ? "" : ", ", i);
  return text.empty() ? "nothing" : text;
}

}  // namespace

Vec3 position(const Level& level, Centring centring, IntVec3 c) {
  const IntVec3 closing = closing_layers(centring);
  Vec3 p;
  for (int d = 0; d < 3; ++d)
    p[d] = level.anchor[d] + (c[d] + 0.5 * (1 - closing[d])) * level.spacing[d];
  return p;
}

IntVec3 cell_of(const Level& level, Vec3 point) {
  IntVec3 cell;
  for (int d = 0; d < 3; ++d) {
    const double place = std::floor((point[d] - level.anchor[d]) / level.spacing[d]);
    cell[d] = static_cast<int>(std::clamp(place, -1e9, 1e9));
  }
  return cell;
}

IndexBox index_range(const Level& level, Centring centring) {
  return {level.domain.lower, level.domain.upper + closing_layers(centring)};
}

bool LabelFilter::selects(const std::string& name) const {
  return (only.empty() || holds(only, name)) && !holds(ignore, name);
}

std::vector<std::string> split_names(const std::string& text) {
  std::vector<std::string> names;
  std::string name;
  for (const char c : text + ',') {
    if (c != ',' && c != ' ') name += c;
    if (c == ',' && !name.empty()) names.push_back(std::exchange(name, {}));
  }
  return names;
}

std::vector<FieldInfo> select_fields(const ArchiveStep& step, const std::string& name,
                                     std::optional<int> material, int level) {
  std::vector<FieldInfo> found;
  std::set<std::string> names;
  std::set<int> materials, levels;
  for (const FieldInfo& f : step.fields()) {
    names.insert(f.name);
    if (f.name != name) continue;
    materials.insert(f.material);
    levels.insert(f.level);
    if ((!material || f.material == *material) && (level < 0 || f.level == level))
      found.push_back(f);
  }
  if (!found.empty()) return found;
  for (const FieldInfo& f : step.particle_fields()) names.insert(f.name);
  const std::string where = step.folder().string();
  if (materials.empty() && !step.damage().empty()) throw DamageError(step.damage().front());
  if (materials.empty())
    throw InputError(fmt::format("{} has no label {}; it has {}", where, name, listed(names)));
  throw InputError(fmt::format("{} has no such {}: it is stored for materials {} and levels {}",
                               where, name, listed(materials), listed(levels)));
}

}  // namespace sluice
