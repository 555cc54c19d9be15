// Coarse cells under finer ones are subtracted box by box: exact sums lose nothing by that.
#include "framework/archive/extremes/material_sums.hpp"

#include <algorithm>
#include <functional>
#include <set>

#include "framework/archive/particle_table.hpp"
#include "framework/base/exact_sum.hpp"

namespace sluice {
namespace {

// Integral over the cells of `level` that no finer level covers. value(cell): per volume.
template <class F>
void integrate(const Grid& grid, std::size_t level, F&& value, ExactSum& sum) {
  const Level& l = grid.levels[level];
  const double volume = l.cell_volume();
  const auto add = [&](const IndexBox& cells, double sign) {
    for_each_cell(cells, [&](IntVec3 c) { sum.add(sign * volume * value(c)); });
  };
  for (const GridBox& box : l.boxes) add(box.cells, 1);
  if (level + 1 >= grid.levels.size()) return;
  const Level& fine = grid.levels[level + 1];
  for (const GridBox& finer : fine.boxes) {
    IndexBox under;
    for (int d = 0; d < 3; ++d) {
      under.lower[d] = finer.cells.lower[d] / fine.ratio[d];
      under.upper[d] = finer.cells.upper[d] / fine.ratio[d];
    }
    for (const GridBox& box : l.boxes)
      if (const IndexBox both = intersection(box.cells, under); !both.empty()) add(both, -1);
  }
}

// The fields of a material on one level; those that are not saved are empty.
struct CellFields {
  std::optional<DenseField> density, velocity, fraction, specific_volume;

  CellFields(const ArchiveStep& step, int material, int level) {
    const auto read = [&](const char* name) -> std::optional<DenseField> {
      const FieldInfo* info = step.find(name, material, level);
      if (info == nullptr) return std::nullopt;
      return step.read(*info);
    };
    density = read("rho_CC");
    velocity = read("vel_CC");
    fraction = read("vol_frac_CC");
    specific_volume = read("sp_vol_CC");
  }
};

// Where a material is absent, its velocity and specific volume may be any number, or none.
double product(double density, double other) {
  return density == 0 ? 0.0 : density * other;
}

MaterialSums cell_sums(const ArchiveStep& step, int material, bool alone) {
  ExactSum volume, mass;
  std::array<ExactSum, 3> momentum;
  bool has_volume = true, has_momentum = true;
  for (std::size_t l = 0; l < step.grid().levels.size(); ++l) {
    const CellFields f(step, material, static_cast<int>(l));
    if (!f.density) continue;
    const auto rho = [&](IntVec3 c) { return f.density->at(c); };
    integrate(step.grid(), l, rho, mass);
    for (int d = 0; d < 3 && f.velocity; ++d)
      integrate(
          step.grid(), l, [&](IntVec3 c) { return product(rho(c), f.velocity->at(c, d)); },
          momentum[static_cast<std::size_t>(d)]);
    has_momentum = has_momentum && f.velocity.has_value();
    if (f.fraction)
      integrate(
          step.grid(), l, [&](IntVec3 c) { return f.fraction->at(c); }, volume);
    else if (alone)
      integrate(
          step.grid(), l, [](IntVec3) { return 1.0; }, volume);
    else if (f.specific_volume)
      integrate(
          step.grid(), l, [&](IntVec3 c) { return product(rho(c), f.specific_volume->at(c)); },
          volume);
    else
      has_volume = false;
  }
  MaterialSums sums;
  sums.material = material;
  sums.mass = mass.value();
  if (has_volume)
    sums.volume = volume.value();
  else
    sums.missing.emplace_back("vol_frac_CC");
  if (has_momentum)
    sums.momentum = {momentum[0].value(), momentum[1].value(), momentum[2].value()};
  else
    sums.missing.emplace_back("vel_CC");
  return sums;
}

MaterialSums particle_sums(const ArchiveStep& step, int material) {
  const ParticleTable table =
      read_particles(step, material, {{"p.volume", "p.mass", "p.velocity"}, {}});
  const ParticleColumn *volume = table.find("p.volume"), *mass = table.find("p.mass"),
                       *velocity = table.find("p.velocity");
  MaterialSums sums;
  sums.material = material;
  sums.particles = true;
  const auto sum = [&](const std::function<double(std::size_t)>& value) {
    ExactSum s;
    for (std::size_t p = 0; p < table.size(); ++p) s.add(value(p));
    return s.value();
  };
  if (volume != nullptr)
    sums.volume = sum([&](std::size_t p) { return volume->components[0][p]; });
  else
    sums.missing.emplace_back("p.volume");
  if (mass == nullptr) {
    sums.missing.emplace_back("p.mass");
    return sums;
  }
  sums.mass = sum([&](std::size_t p) { return mass->components[0][p]; });
  if (velocity == nullptr) {
    sums.missing.emplace_back("p.velocity");
    return sums;
  }
  Vec3 momentum;
  for (int d = 0; d < 3; ++d)
    momentum[d] = sum([&](std::size_t p) {
      return mass->components[0][p] * velocity->components[static_cast<std::size_t>(d)][p];
    });
  sums.momentum = momentum;
  return sums;
}

}  // namespace

std::vector<MaterialSums> material_sums(const ArchiveStep& step, bool alone) {
  std::vector<MaterialSums> all;
  std::set<int> of_cells;
  for (const FieldInfo& f : step.fields())
    if (f.name == "rho_CC" && f.centring == Centring::cell) of_cells.insert(f.material);
  for (const int material : of_cells) all.push_back(cell_sums(step, material, alone));
  for (const int material : particle_materials(step)) {
    MaterialSums sums = particle_sums(step, material);
    if (sums.volume || sums.mass) all.push_back(std::move(sums));
  }
  return all;
}

}  // namespace sluice
