// Laying particles out as the run will, and counting them.
#include "app/plan/planned_particles.hpp"

#include <fmt/format.h>

#include "framework/base/console.hpp"
#include "framework/base/memory.hpp"
#include "framework/run/component/step_shape.hpp"
#include "framework/run/levels/hierarchy.hpp"

namespace sluice {
namespace {

constexpr int place_and_id = 4;  // numbers of every particle

std::string name_of(const StepShape::Stage& stage) {
  if (const auto* one = std::get_if<StepShape::Solve>(&stage)) return one->name;
  if (const auto* one = std::get_if<StepShape::Prepare>(&stage)) return one->name;
  if (const auto* one = std::get_if<StepShape::Sweep>(&stage)) return one->name;
  if (const auto* one = std::get_if<StepShape::Iterate>(&stage)) return one->name;
  return std::holds_alternative<StepShape::Exchange>(stage) ? "ghost exchange" : "take over";
}

PlannedKind planned(const ParticleKind& kind) {
  PlannedKind p;
  p.name = kind.name;
  p.material = kind.material;
  p.numbers = place_and_id + static_cast<int>(kind.columns());
  p.temporary_numbers = place_and_id - 1 + static_cast<int>(kind.advanced_columns().size());
  p.numbers_written = place_and_id;
  for (const ParticleAttribute& a : kind.attributes)
    p.numbers_written += component_count(a.label.info().type);
  for (const DerivedAttribute& d : kind.derived)
    p.numbers_written += component_count(d.label.info().type);
  return p;
}

bool has_particles(const LoadedScene& loaded) {
  const ParticleMethod* method = loaded.component->particles();
  return method != nullptr && method->in_stages();
}

// Of the boxes of a level that the next finer one does not cover.
std::int64_t count_on(const ParticleMethod& method, int kind, const Grid& grid, std::size_t l) {
  const Level& level = grid.levels[l];
  std::int64_t count = 0;
  for (const GridBox& box : level.boxes)
    count += method.count_at_start(kind, level, box.cells).value_or(0);
  if (l + 1 == grid.levels.size()) return count;
  const Level& finer = grid.levels[l + 1];
  for (const GridBox& box : finer.boxes) {
    IndexBox below = box.cells;
    for (int d = 0; d < 3; ++d) {
      below.lower[d] /= finer.ratio[d];
      below.upper[d] /= finer.ratio[d];
    }
    count -= method.count_at_start(kind, level, below).value_or(0);
  }
  return count;
}

// This process holds the boxes of all ranks.
void lay_out(const LoadedScene& loaded, PlannedParticles& p) {
  Scene scene = loaded.scene;
  for (Level& level : scene.grid.levels)
    for (GridBox& box : level.boxes) box.owner = 0;
  Hierarchy hierarchy(scene, *loaded.component, world(), {});
  hierarchy.initialise();
  p.limit = hierarchy.rates().first_limit();
  const std::vector<ParticleCount> counts = hierarchy.particles()->counts();
  for (std::size_t k = 0; k < counts.size(); ++k) p.kinds[k].count = counts[k].here;
}

}  // namespace

double PlannedParticles::bytes() const {
  double sum = 0;
  for (const PlannedKind& k : kinds) sum += k.bytes();
  return sum;
}

double PlannedParticles::checkpoint_bytes() const {
  double sum = 0;
  for (const PlannedKind& k : kinds) sum += 8.0 * static_cast<double>(k.count) * k.numbers_written;
  return sum;
}

PlannedParticles count_particles(const LoadedScene& loaded) {
  PlannedParticles p;
  if (!has_particles(loaded)) return p;
  const ParticleMethod& method = *loaded.component->particles();
  const Grid& grid = loaded.scene.grid;
  for (const ParticleKind& kind : method.kinds()) {
    PlannedKind& k = p.kinds.emplace_back(planned(kind));
    for (std::size_t l = 0; l < grid.levels.size(); ++l)
      k.count += count_on(method, static_cast<int>(p.kinds.size()) - 1, grid, l);
  }
  return p;
}

PlannedParticles plan_particles(const LoadedScene& loaded, std::int64_t max_cells) {
  PlannedParticles p = count_particles(loaded);
  if (!p.any()) return p;
  StepShape shape;
  loaded.component->step().declare_stages(shape);
  for (const StepShape::Stage& stage : shape.stages()) p.stages.push_back(name_of(stage));
  const auto there = static_cast<double>(available_memory().bytes);
  const bool fits = there == 0 || p.bytes() < 0.5 * there;
  if (fits && loaded.scene.grid.cell_count() <= max_cells) lay_out(loaded, p);
  return p;
}

std::string particles_text(const PlannedParticles& p) {
  if (!p.any()) return {};
  using Align = TextTable::Align;
  TextTable table({{"particles"},
                   {"at the start", Align::right},
                   {"numbers each", Align::right},
                   {"made by a step", Align::right},
                   {"bytes", Align::right}});
  for (const PlannedKind& k : p.kinds)
    table.row({k.name, p.known ? human_count(k.count) : "counted by the run",
               std::to_string(k.numbers), std::to_string(k.temporary_numbers),
               p.known ? human_bytes(k.bytes()) : ""});
  return table.text("  ") + fmt::format("  per step: {}\n", fmt::join(p.stages, "; "));
}

}  // namespace sluice
