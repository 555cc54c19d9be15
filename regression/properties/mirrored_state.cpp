// Cell by cell.
#include "properties/mirrored_state.hpp"

#include <fmt/format.h>

#include <cmath>

#include "framework/archive/archive.hpp"
#include "ice/fluid/labels.hpp"

namespace sluice::properties {
namespace {

// Whether the component changes its sign in a mirror.
bool is_odd(const FieldInfo& field, int component, int axis) {
  if (field.components() == 3) return component == axis;
  const auto& l = ice::labels();
  return field.name == l.momentum_component[axis].name() ||
         field.name == l.slip_component[axis].name();
}

struct Place {
  const FieldInfo& field;
  int component;
  bool odd;
  double allowed;  // absolute
};

// The largest number of a field, all components; 0 where there is none of that name.
double largest(const ArchiveStep& step, const FieldInfo* field) {
  if (field == nullptr) return 0;
  const DenseField values = step.read(*field);
  double most = 0;
  for_each_cell(values.cells, [&](IntVec3 c) {
    if (!values.has(c)) return;
    for (int k = 0; k < field->components(); ++k)
      most = std::fmax(most, std::fabs(values.at(c, k)));
  });
  return most;
}
// What a value of a field may differ by, absolute.
double room_of(const ArchiveStep& step, const FieldInfo& field, double allowed) {
  constexpr double rest = 1e-12;  // what counts as rest, of the speed of sound
  const double own = allowed * largest(step, &field);
  if (field.components() == 1) return own;
  const double p = largest(step, step.find("press_CC", 0, 0));
  const double rho = largest(step, step.find("rho_CC", 0, 0));
  return std::fmax(own, rho > 0 ? rest * std::sqrt(p / rho) : 0.0);
}

std::string field_difference(const Level& level, const Place& place, const DenseField& p,
                             const DenseField& q, int axis) {
  const int last = level.domain.lower[axis] + level.domain.upper[axis] - 1 +
                   (face_direction(place.field.centring) == axis ? 1 : 0);
  std::int64_t differing = 0, values = 0;
  std::string first;
  for_each_cell(p.cells, [&](IntVec3 c) {
    IntVec3 there = c;
    there[axis] = last - c[axis];
    const bool here = p.has(c);
    values += here;
    if (!here && !q.has(there)) return;
    if (here && q.has(there)) {
      const double b = q.at(there, place.component);
      const double a = p.at(c, place.component), image = place.odd ? 0.0 - b : b;
      if (a == image || std::fabs(a - image) <= place.allowed) return;
    }
    ++differing;
    if (!first.empty()) return;
    first = here != q.has(there)
                ? fmt::format("({},{},{}) is in one of them only", c.x, c.y, c.z)
                : fmt::format("({},{},{}): {:.17g} and {:.17g}", c.x, c.y, c.z,
                              p.at(c, place.component), q.at(there, place.component));
  });
  if (differing == 0 && values > 0) return {};
  return fmt::format("{} component {} of material {} on level {}: {} of {} differ, first {}",
                     place.field.name, place.component, place.field.material, place.field.level,
                     differing, values, first);
}

std::string step_difference(const ArchiveStep& a, const ArchiveStep& b, int axis,
                            double allowed = 0) {
  if (std::fabs(a.info().time - b.info().time) > allowed * a.info().time)
    return fmt::format("times {:.17g} and {:.17g}", a.info().time, b.info().time);
  if (a.fields().empty() || a.fields().size() != b.fields().size())
    return fmt::format("{} and {} fields", a.fields().size(), b.fields().size());
  for (const FieldInfo& field : a.fields()) {
    const FieldInfo* twin = b.find(field.name, field.material, field.level);
    if (twin == nullptr) return field.name + " is in one of them only";
    const DenseField p = a.read(field), q = b.read(*twin);
    const Level& level = a.grid().levels.at(static_cast<std::size_t>(field.level));
    const double room = allowed > 0 ? room_of(a, field, allowed) : 0.0;
    for (int c = 0; c < field.components(); ++c) {
      const Place place{field, c, is_odd(field, c, axis), room};
      if (std::string words = field_difference(level, place, p, q, axis); !words.empty())
        return words;
      // What the image has beyond.
      if (p.cells.volume() != q.cells.volume()) return field.name + " has other cells";
    }
  }
  return {};
}

}  // namespace

std::string mirror_difference(const std::filesystem::path& a, const std::filesystem::path& b,
                              int axis, double allowed) {
  const Archive one = Archive::open(a), other = Archive::open(b);
  if (one.outputs().size() != other.outputs().size() ||
      one.checkpoints().size() != other.checkpoints().size() || one.checkpoints().empty())
    return "other outputs or checkpoints";
  const auto tell = [](int step, const std::string& words) {
    return fmt::format("step {}: {}", step, words);
  };
  for (std::size_t n = 0; n < one.outputs().size(); ++n) {
    const ArchiveStep p = one.read_output(one.outputs()[n]),
                      q = other.read_output(other.outputs()[n]);
    if (const std::string words = step_difference(p, q, axis, allowed); !words.empty())
      return tell(p.info().step, words);
  }
  if (allowed > 0) return {};
  for (std::size_t n = 0; n < one.checkpoints().size(); ++n) {
    const ArchiveStep p = one.read_checkpoint(one.checkpoints()[n]),
                      q = other.read_checkpoint(other.checkpoints()[n]);
    if (const std::string words = step_difference(p, q, axis); !words.empty())
      return tell(p.info().step, "checkpoint: " + words);
  }
  return {};
}

}  // namespace sluice::properties
