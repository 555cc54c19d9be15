// Outputs, patches and numbers as the tools print them.
#include "app/classic/classic_archive.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "framework/archive/particle_table.hpp"

namespace sluice {

OutputRange outputs_asked(const ClassicArguments& arguments, const Archive& archive,
                          const RangeOptions& names) {
  const std::size_t count = archive.outputs().size();
  if (count == 0) throw InputError(archive.folder().string() + " has no output");
  const auto number = [&](const std::string& option, std::size_t fallback) {
    if (option.empty() || !arguments.has(option)) return fallback;
    const int n = arguments.integer(option, 0);
    if (n < 0 || static_cast<std::size_t>(n) >= count)
      throw InputError(fmt::format("{} {}: must be between 0 and {}", option, n, count - 1));
    return static_cast<std::size_t>(n);
  };
  OutputRange range;
  range.first = number(names.low, number(names.only, 0));
  range.last =
      number(names.high,
             names.only.empty() || !arguments.has(names.only) ? count - 1 : number(names.only, 0));
  if (range.last < range.first)
    throw InputError(
        fmt::format("{} {} lies before {} {}", names.high, range.last, names.low, range.first));
  if (!names.increment.empty()) {
    const int step = arguments.integer(names.increment, 1);
    if (step < 1) throw InputError(fmt::format("{} {}: must be at least 1", names.increment, step));
    range.step = static_cast<std::size_t>(step);
  }
  return range;
}

const VariableEntry& need_variable(const Archive& archive, const std::string& name) {
  std::string known;
  for (const VariableEntry& v : archive.index().variables) {
    if (v.name == name && v.readable) return v;
    known += "\n  " + v.name;
  }
  throw InputError(
      fmt::format("Variable \"{}\" was not found. Possible variable names are:{}", name, known));
}

const FieldInfo& ParticleLists::info(const std::string& name, const PatchParticles& at) const {
  const FieldInfo* found = step_.find_particles(name, at.material, at.level);
  if (found == nullptr)
    throw DamageError(fmt::format("{}: particles of material {} on level {} have no {}",
                                  step_.folder().string(), at.material, at.level, name));
  return *found;
}

bool ParticleLists::has(const std::string& name, const PatchParticles& at) const {
  return step_.find_particles(name, at.material, at.level) != nullptr;
}

ValueType ParticleLists::type(const std::string& name, const PatchParticles& at) const {
  return info(name, at).type;
}

const std::vector<std::vector<double>>& ParticleLists::values(const std::string& name,
                                                              const PatchParticles& at) {
  const Key key{name, at.level, at.material};
  auto found = values_.find(key);
  if (found == values_.end())
    found = values_.emplace(key, step_.read_particles(info(name, at))).first;
  return found->second;
}

const std::vector<std::int64_t>& ParticleLists::integers(const std::string& name,
                                                         const PatchParticles& at) {
  const Key key{name, at.level, at.material};
  auto found = integers_.find(key);
  if (found == integers_.end())
    found = integers_.emplace(key, step_.read_particle_integers(info(name, at))).first;
  return found->second;
}

Vec3 ParticleLists::position(const PatchParticles& at, std::size_t place) {
  const auto& x = values(particle_position_name, at);
  return {x[0].at(place), x[1].at(place), x[2].at(place)};
}

std::string number_text(double value, int digits) {
  return fmt::format("{:.{}e}", value, digits);
}

std::string value_text(ValueType type, double value, int digits) {
  const bool integer = type == ValueType::integer || type == ValueType::long_integer;
  return integer ? fmt::format("{:.0f}", value) : number_text(value, digits);
}

std::string index_text(IntVec3 i) {
  return fmt::format("[int {}, {}, {}]", i.x, i.y, i.z);
}

std::string point_text(Vec3 p, int digits) {
  return fmt::format("[{} {} {}]", number_text(p.x, digits), number_text(p.y, digits),
                     number_text(p.z, digits));
}

std::string vector_text(Vec3 v, int digits) {
  return fmt::format(" {} {} {} ", number_text(v.x, digits), number_text(v.y, digits),
                     number_text(v.z, digits));
}

std::string value_text(ValueType type, const std::vector<double>& components, int digits) {
  if (type == ValueType::vector)
    return vector_text({components[0], components[1], components[2]}, digits);
  std::string text;
  for (const double c : components) text += (text.empty() ? "" : " ") + value_text(type, c, digits);
  return text;
}

Archive archive_asked(const ClassicArguments& arguments) {
  if (!arguments.positional().empty())
    arguments.refuse(fmt::format("'{}' belongs to no option", arguments.positional().front()));
  if (!arguments.has("-uda")) arguments.refuse("no archive is given (-uda)");
  return Archive::open(arguments.text("-uda"));
}

int digits_asked(const ClassicArguments& arguments) {
  const int digits = arguments.integer("-pr", 16);
  if (digits < 1 || digits > 32)
    throw InputError(fmt::format("-pr {}: must be between 1 and 32", digits));
  return digits;
}

const Level& level_asked(const ArchiveStep& step, int level) {
  const auto& levels = step.grid().levels;
  if (level < 0 || static_cast<std::size_t>(level) >= levels.size())
    throw InputError(fmt::format("-l {}: the grid has {} levels", level, levels.size()));
  return levels[level];
}

}  // namespace sluice
