// Choosing fields by name, with the nearest thing to try when there is none.
#include "framework/archive/selection.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
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

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

// "A:B" with each end as a time; an empty one is `open`.
template <class ToTime>
TimeRange range_of(std::string_view text, ToTime&& to_time) {
  const std::size_t colon = text.find(':');
  const std::string_view first = text.substr(0, colon), last = text.substr(colon + 1);
  const TimeRange range{first.empty() ? -infinite : to_time(first),
                        last.empty() ? infinite : to_time(last)};
  if (!(range.first <= range.last))
    throw InputError(fmt::format("--time {}: the range is empty: it begins after its end", text));
  return range;
}

double plain_time(std::string_view text) {
  try {
    if (const double time = parse_real(text, "--time"); std::isfinite(time)) return time;
  } catch (const DamageError&) {
    // Said below.
  }
  throw InputError(fmt::format("--time: '{}' is not a time (s)", text));
}

const StepEntry& nearest_to(const std::vector<StepEntry>& steps, const TimeRange& range) {
  return *std::min_element(steps.begin(), steps.end(), [&](const auto& a, const auto& b) {
    const auto away = [&](double t) { return std::max(range.first - t, t - range.last); };
    return away(a.time) < away(b.time);
  });
}

}  // namespace

bool TimeRange::contains(double time) const {
  const auto round_off = [&](double end) {
    return std::isinf(end) ? 0 : 1e-12 * std::max(std::abs(time), std::abs(end));
  };
  return time >= first - round_off(first) && time <= last + round_off(last);
}

TimeRange parse_time_range(std::string_view text) {
  return range_of(text, plain_time);
}

std::vector<StepEntry> select_steps(const Archive& archive, Stored kind, std::string_view text) {
  if (text != "all" && text.find(':') == std::string_view::npos)
    return {archive.select(kind, text)};
  archive.select(kind, "last");  // tells when there is none
  const std::vector<StepEntry>& steps =
      kind == Stored::outputs ? archive.outputs() : archive.checkpoints();
  if (text == "all") return steps;
  const TimeRange range = range_of(text, [&](std::string_view end) {
    const bool word = end.starts_with('#') || end == "first" || end == "last";
    return word ? archive.select(kind, end).time : plain_time(end);
  });
  std::vector<StepEntry> chosen;
  for (const StepEntry& s : steps)
    if (range.contains(s.time)) chosen.push_back(s);
  if (!chosen.empty()) return chosen;
  const StepEntry& nearest = nearest_to(steps, range);
  throw InputError(fmt::format(
      "--time {}: {} has nothing between: the nearest is step {} at {:.17g}; see sluice "
      "info",
      text, archive.folder().string(), nearest.step, nearest.time));
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
