// Filling cells with several materials: shares from sub-points, their sum, common pressure.
#include "ice/start/material_fill.hpp"

#include <fmt/format.h>

#include <cmath>

#include "framework/deck/faults.hpp"
#include "framework/geometry/boolean.hpp"
#include "ice/start/initial_state_parts.hpp"

namespace sluice::ice {
namespace {

// Fractions are ratios of small integers, or a deck's volumeFraction, which often has few digits.
// threshold: largest difference of the sum of volume fractions from one; unit: 1; test:
//   MaterialFill.RefusesFractionsThatDoNotSumToOne
constexpr double sum_tolerance = 1e-10;

double sub_points(const GeomObject& o) {
  return static_cast<double>(o.res.x) * o.res.y * o.res.z;
}

double share_of_object(const GeomObject& o) {
  return o.has("volumeFraction") ? o.value("volumeFraction") : 1.0;
}

// The object without what later objects of the material take from it.
GeomObject own_part(const IceMaterial& m, std::size_t index) {
  GeomObject part = m.objects[index];
  std::vector<PiecePtr> later;
  for (std::size_t n = index + 1; n < m.objects.size(); ++n) later.push_back(m.objects[n].piece);
  if (!later.empty())
    part.piece = std::make_shared<DifferencePiece>(
        part.piece,
        later.size() == 1 ? later.front() : std::make_shared<UnionPiece>(std::move(later)));
  return part;
}

// Counts of sub-points add up exactly where all objects have the same number of them.
void apply_objects(const IceMaterial& m, const Level& level, MaterialFill& fill) {
  const std::size_t count = fill.density.size();
  fill.volume_fraction.assign(count, 0.0);
  // What the material would be where it is not: a start for pressures of the surroundings.
  const ObjectState elsewhere(m.objects.front());
  for (std::size_t n = 0; n < count; ++n) elsewhere.put(n, fill);
  bool alike = true;  // one number of sub-points, no shares
  for (const GeomObject& o : m.objects)
    alike = alike && sub_points(o) == sub_points(m.objects.front()) && share_of_object(o) == 1.0;
  for (std::size_t k = 0; k < m.objects.size(); ++k) {
    const GeomObject part = own_part(m, k);
    const double weight = alike ? 1.0 : share_of_object(part) / sub_points(part);
    const std::vector<std::int32_t> inside = count_inside(part, level, fill.cells);
    const ObjectState state(part);
    for (std::size_t n = 0; n < count; ++n) {
      if (inside[n] == 0) continue;
      fill.volume_fraction[n] += weight * inside[n];
      state.put(n, fill);
    }
  }
  if (!alike) return;
  for (double& share : fill.volume_fraction) share /= sub_points(m.objects.front());
}

std::string fractions_text(const IceScene& scene, const MixtureFill& fill, std::size_t n) {
  std::string text;
  for (std::size_t m = 0; m < scene.materials.size(); ++m) {
    const std::string& name = scene.materials[m].name;
    text += fmt::format("{}{} {:.10g}", text.empty() ? "" : ", ",
                        name.empty() ? fmt::format("material {}", m) : name,
                        fill.materials[m].volume_fraction[n]);
  }
  return text;
}

// The last object that holds a part of the cell, or the first material when there is none.
Location last_object_in(const IceScene& scene, const Level& level, IntVec3 c) {
  Location where = scene.materials.front().where;
  for (const IceMaterial& m : scene.materials)
    for (const GeomObject& o : m.objects)
      if (count_inside(o, level, {c, c + IntVec3::all(1)}).front() > 0) where = o.where;
  return where;
}

[[noreturn]] void refuse(const IceScene& scene, const MixtureFill& fill, const Level& level,
                         IntVec3 c, double sum) {
  const Vec3 x = level.centre(c);
  const char* advice =
      sum == 0.0  ? "no geom_object covers it: add one that covers the rest"
      : sum > 1.0 ? "objects of different materials overlap: cut one out of the other with "
                    "<difference>, and give them the same <res>"
                  : "part of the cell is empty: add a geom_object for the rest, and give objects "
                    "that share a cell the same <res>";
  throw DeckError(
      last_object_in(scene, level, c),
      fmt::format("volume fractions sum to {:.10g} in cell [{}, {}, {}] at ({:g}, {:g}, {:g}), not "
                  "to 1 ({})",
                  sum, c.x, c.y, c.z, x.x, x.y, x.z, fractions_text(scene, fill, fill.offset(c))),
      advice);
}

// Beside solids: what is there fills what they leave; where nothing is, what is around.
void fill_beside_solids(const IceScene& scene, const Level& level, IntVec3 c, std::size_t n,
                        double sum, MixtureFill& fill) {
  if (sum > 0) {
    for (MaterialFill& m : fill.materials) m.volume_fraction[n] /= sum;
    return;
  }
  constexpr int farthest = 3;
  std::size_t found = 0;
  const GeomObject* object = &scene.materials.front().objects.front();
  for (int reach = 1, seen = 0; reach <= farthest && seen == 0; ++reach) {
    IndexBox around{c - level.ghosts(reach), c + level.ghosts(reach) + IntVec3{1, 1, 1}};
    around = intersection(around, level.domain);
    for (std::size_t m = 0; m < scene.materials.size(); ++m)
      for (const GeomObject& o : scene.materials[m].objects) {
        const std::vector<std::int32_t> inside = count_inside(o, level, around);
        if (std::none_of(inside.begin(), inside.end(), [](auto count) { return count > 0; }))
          continue;
        found = m;
        object = &o;
        seen = 1;
      }
  }
  fill.materials[found].volume_fraction[n] = 1.0;
  const ObjectState state(*object);
  state.put(n, fill.materials[found]);
  const Fluid& law = scene.materials[found].fluid;
  fill.materials[found].pressure[n] =
      law.pressure(state.density, law.energy_from_temperature(state.density, state.temperature));
}

// Fractions that miss one by round-off are made to fit: one material that is alone has all of it,
// and of several the largest takes the rest.
void close_fractions(const IceScene& scene, const Level& level, MixtureFill& fill) {
  for_each_cell(fill.cells, [&](IntVec3 c) {
    const std::size_t n = fill.offset(c);
    double sum = 0;
    std::size_t largest = 0;
    for (std::size_t m = 0; m < fill.materials.size(); ++m) {
      const double share = fill.materials[m].volume_fraction[n];
      sum += share;
      if (share > fill.materials[largest].volume_fraction[n]) largest = m;
    }
    if (scene.solids > 0 && sum < 1.0 - sum_tolerance) {
      fill_beside_solids(scene, level, c, n, sum, fill);
      sum = 1.0;
      for (std::size_t m = 0; m < fill.materials.size(); ++m)
        if (fill.materials[m].volume_fraction[n] > fill.materials[largest].volume_fraction[n])
          largest = m;
    }
    if (!(std::abs(sum - 1.0) <= sum_tolerance)) refuse(scene, fill, level, c, sum);
    double others = 0;
    for (std::size_t m = 0; m < fill.materials.size(); ++m)
      if (m != largest) others += fill.materials[m].volume_fraction[n];
    fill.materials[largest].volume_fraction[n] = 1.0 - others;
  });
}

// One pressure for all materials of a cell: that of the height, or, where gravity acts along
// several directions, that which carries the marked material.
void balance_weight(const IceScene& scene, const PhysicalConstants& constants,
                    const Level& coarsest, const Level& level, const WeightProfile& weight,
                    MixtureFill& fill) {
  PrimitiveFill surrounding = fill.materials[scene.surrounding().index];
  if (weight.direction < 0)
    apply_hydrostatics(constants, scene.surrounding(), coarsest, level, surrounding);
  else
    for_each_cell(fill.cells, [&](IntVec3 c) {
      const std::size_t j = c[weight.direction] - weight.first;
      surrounding.pressure[fill.offset(c)] = weight.pressure[j];
    });
  for (std::size_t m = 0; m < fill.materials.size(); ++m)
    for (std::size_t n = 0; n < surrounding.pressure.size(); ++n) {
      MaterialFill& body = fill.materials[m];
      if (body.volume_fraction[n] == 0) continue;
      set_pressure(scene.materials[m],
                   what_is_kept(scene.materials[m], body.density[n], body.temperature[n],
                                constants.reference_pressure),
                   surrounding.pressure[n], n, body);
    }
}

MixtureFill cut(MixtureFill&& from, const IndexBox& cells) {
  if (from.cells == cells) return std::move(from);
  MixtureFill fill;
  fill.cells = cells;
  for (const MaterialFill& m : from.materials) {
    MaterialFill part{cut(static_cast<const PrimitiveFill&>(m), cells), {}};
    for_each_cell(
        cells, [&](IntVec3 c) { part.volume_fraction.push_back(m.volume_fraction[m.offset(c)]); });
    fill.materials.push_back(std::move(part));
  }
  return fill;
}

}  // namespace

MixtureFill fill_weightless(const IceScene& scene, const PhysicalConstants& constants,
                            const Level& coarsest, const Level& level, const IndexBox& cells) {
  MixtureFill fill;
  fill.cells = cells;
  for (const IceMaterial& m : scene.materials) {
    fill.materials.emplace_back();
    size_fill(cells, fill.materials.back());
    apply_objects(m, level, fill.materials.back());
    apply_mixture(scene.models, m.index, level, fill.materials.back());
    apply_starts(scene, constants, m, coarsest, level, fill.materials.back());
  }
  close_fractions(scene, level, fill);
  return fill;
}

MixtureFill fill_materials(const IceScene& scene, const PhysicalConstants& constants,
                           const Level& coarsest, const Level& level, const IndexBox& cells,
                           const WeightProfile& weight) {
  const IndexBox filled =
      weight.direction < 0 ? cells_to_fill(scene, constants, level, cells) : cells;
  MixtureFill fill = fill_weightless(scene, constants, coarsest, level, filled);
  if (is_hydrostatic(scene, constants, level))
    balance_weight(scene, constants, coarsest, level, weight, fill);
  for (std::size_t m = 0; m < fill.materials.size(); ++m)
    for_each_cell(fill.cells, [&](IntVec3 c) {
      const std::size_t n = fill.offset(c);
      if (fill.materials[m].volume_fraction[n] > 0)
        check_admissible(scene.materials[m], level, c, n, fill.materials[m]);
    });
  return cut(std::move(fill), cells);
}

}  // namespace sluice::ice
