#include "peridynamics/peridigm/convert.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <tuple>

#include "framework/scene/deck_values.hpp"
#include "peridynamics/peridigm/converter.hpp"

namespace sluice::peridynamics {
namespace {

// sum over neighbours of V 18 K/(pi delta^4 r) in a grid of cells as long as the longest horizon.
double step_of(const PeridigmReader& deck) {
  double reach = 0;
  for (const BlockOfDeck& b : deck.blocks) reach = std::max(reach, b.horizon);
  const auto block_of = [&](const MeshPoint& p) {
    return *std::find_if(deck.blocks.begin(), deck.blocks.end(),
                         [&](const BlockOfDeck& b) { return b.number == p.block; });
  };
  using Cell = std::tuple<int, int, int>;
  std::map<Cell, std::vector<const MeshPoint*>> cells;
  const auto along = [&](double x) { return static_cast<int>(std::floor(x / reach)); };
  for (const MeshPoint& p : deck.mesh.points)
    cells[{along(p.place.x), along(p.place.y), along(p.place.z)}].push_back(&p);
  double dt = 1e300;
  for (const MeshPoint& p : deck.mesh.points) {
    const BlockOfDeck block = block_of(p);
    const double delta = block.horizon;
    double sum = 0;
    for (int k = -1; k <= 1; ++k)
      for (int j = -1; j <= 1; ++j)
        for (int i = -1; i <= 1; ++i) {
          const auto at =
              cells.find({along(p.place.x) + i, along(p.place.y) + j, along(p.place.z) + k});
          if (at == cells.end()) continue;
          for (const MeshPoint* q : at->second) {
            const Vec3 xi = q->place - p.place;
            const double r = std::sqrt(dot(xi, xi));
            if (q != &p && r <= delta)
              sum += q->volume * 18 * block.material->bulk /
                     (std::numbers::pi * std::pow(delta, 4) * r);
          }
        }
    if (sum > 0) dt = std::min(dt, std::sqrt(2 * block.material->density / sum));
  }
  return deck.safety_factor * dt;
}

struct Extent {
  Vec3 lower{}, upper{};
};
Extent extent_of(const std::vector<MeshPoint>& points, double margin) {
  Extent e{points.front().place, points.front().place};
  for (const MeshPoint& p : points)
    for (int d = 0; d < 3; ++d) {
      e.lower[d] = std::min(e.lower[d], p.place[d]);
      e.upper[d] = std::max(e.upper[d], p.place[d]);
    }
  return {e.lower - Vec3::all(margin), e.upper + Vec3::all(margin)};
}

class UpsWriter {
 public:
  UpsWriter(const PeridigmReader& deck, ConvertedDeck& to) : deck_(deck), to_(to) {}

  void write() {
    double horizon = 0;
    for (const BlockOfDeck& b : deck_.blocks) horizon = std::max(horizon, b.horizon);
    to_.ups =
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<!-- Converted from a deck of Peridigm. "
        "-->\n<Uintah_specification>\n";
    to_.ups += fmt::format("  <Meta>\n    <title>{}</title>\n  </Meta>\n", to_.name);
    to_.ups += "  <SimulationComponent type=\"peridynamics\"/>\n";
    write_time();
    write_output();
    write_rules();
    to_.ups += "  <MaterialProperties>\n    <Peridynamics>\n";
    for (const BlockOfDeck& b : deck_.blocks) write_block(b);
    to_.ups += "    </Peridynamics>\n  </MaterialProperties>\n";
    write_grid(horizon);
    to_.ups += "</Uintah_specification>\n";
  }

 private:
  void write_time() {
    const double span = deck_.final_time - deck_.initial_time;
    const double dt = deck_.fixed_dt > 0 ? deck_.fixed_dt : step_of(deck_);
    const auto steps = static_cast<long long>(std::llround(std::ceil(span / dt - 1e-9)));
    to_.ups += fmt::format(
        "  <Time>\n    <maxTime>{}</maxTime>\n    <initTime>{}</initTime>\n    "
        "<delt_min>0</delt_min>\n    <delt_max>{}</delt_max>\n    "
        "<timestep_multiplier>1</timestep_multiplier>\n    <max_Timesteps>{}</max_Timesteps>\n"
        "  </Time>\n",
        deck_.final_time + dt, deck_.initial_time, dt, steps);
    to_.rules.push_back(fmt::format("the step is {} s in each of {} steps", dt, steps));
  }
  void write_output() {
    to_.ups += fmt::format(
        "  <DataArchiver>\n    <filebase>{}.uda</filebase>\n    <outputTimestepInterval>{}"
        "</outputTimestepInterval>\n    <outputInitTimestep/>\n    "
        "<outputLastTimestep>true</outputLastTimestep>\n",
        to_.name, deck_.output.frequency);
    for (const std::string& label : deck_.output.labels)
      to_.ups += fmt::format("    <save label=\"{}\"/>\n", label);
    if (deck_.output.labels.empty()) to_.ups += "    <save label=\"p.displacement\"/>\n";
    to_.ups += "  </DataArchiver>\n";
  }
  void write_rules() {
    to_.ups +=
        "  <Peridynamics>\n    <influence>one</influence>\n    "
        "<partial_volume>none</partial_volume>\n    "
        "<surface_weights>none</surface_weights>\n    "
        "<family_search>all</family_search>\n    "
        "<damage_order>before_force</damage_order>\n  </Peridynamics>\n";
    for (const char* rule : {"influence: one", "partial_volume: none", "surface_weights: none",
                             "family_search: all", "damage_order: before_force"})
      to_.rules.emplace_back(rule);
  }
  void write_block(const BlockOfDeck& b) {
    const MaterialOfDeck& m = *b.material;
    const std::string file = fmt::format("{}_block_{}.txt", to_.name, b.number);
    to_.ups += fmt::format(
        "      <material name=\"block_{}\">\n        <density>{}</density>\n        "
        "<horizon>{}</horizon>\n",
        b.number, m.density, b.horizon);
    to_.ups += m.bond_based
                   ? fmt::format(
                         "        <material_model type=\"linear_elastic_bond\">\n          "
                         "<bulk_modulus>{}</bulk_modulus>\n        </material_model>\n",
                         m.bulk)
                   : fmt::format(
                         "        <material_model type=\"linear_elastic_state\">\n          "
                         "<bulk_modulus>{}</bulk_modulus>\n          "
                         "<shear_modulus>{}</shear_modulus>\n        </material_model>\n",
                         m.bulk, m.shear);
    if (b.critical_stretch > 0)
      to_.ups += fmt::format(
          "        <damage_model type=\"critical_stretch\">\n          "
          "<s0>{}</s0>\n        </damage_model>\n",
          b.critical_stretch);
    to_.ups += fmt::format(
        "        <geom_object>\n          <file>\n            <name>{}</name>\n            "
        "<var>p.volume</var>\n            <var>p.velocity</var>\n{}          </file>\n          "
        "<res>[1,1,1]</res>\n          <velocity>[0,0,0]</velocity>\n        </geom_object>\n"
        "      </material>\n",
        file, deck_.displaced ? "            <var>p.displacement</var>\n" : "");
    std::string& text = to_.files[file];
    for (std::size_t n = 0; n < deck_.mesh.points.size(); ++n) {
      const MeshPoint& p = deck_.mesh.points[n];
      if (p.block != b.number) continue;
      const Vec3 v = deck_.velocity[n], u = deck_.displacement[n];
      text += fmt::format("{} {} {} {} {} {} {}", p.place.x, p.place.y, p.place.z, p.volume, v.x,
                          v.y, v.z);
      if (deck_.displaced) text += fmt::format(" {} {} {}", u.x, u.y, u.z);
      text += '\n';
    }
  }
  // Cells as wide as the horizon about; points live in them by their reference places.
  void write_grid(double horizon) {
    const Extent e = extent_of(deck_.mesh.points, horizon);
    IntVec3 cells;
    for (int d = 0; d < 3; ++d)
      cells[d] = std::clamp(static_cast<int>((e.upper[d] - e.lower[d]) / horizon), 2, 500);
    to_.ups += fmt::format(
        "  <Grid>\n    <Level>\n      <Box label=\"all\">\n        <lower>[{}, {}, {}]</lower>\n"
        "        <upper>[{}, {}, {}]</upper>\n        <resolution>[{}, {}, {}]</resolution>\n"
        "        <patches>[1,1,1]</patches>\n      </Box>\n    </Level>\n  </Grid>\n",
        e.lower.x, e.lower.y, e.lower.z, e.upper.x, e.upper.y, e.upper.z, cells.x, cells.y,
        cells.z);
  }

  const PeridigmReader& deck_;
  ConvertedDeck& to_;
};

}  // namespace

bool ConvertedDeck::good() const {
  return !any_error(faults);
}

ConvertedDeck convert_peridigm(const Parameter& deck, const std::string& name,
                               const std::string& folder) {
  ConvertedDeck converted;
  converted.name = name;
  PeridigmReader reader(deck, folder, converted.faults);
  reader.read();
  for (const BlockOfDeck& b : reader.blocks)
    if (converted.good() && cells_reach_farther(reader.mesh, b.horizon))
      add_not_built(converted.faults, deck.where,
                    fmt::format("a PdQuickGrid whose horizon {:g} ends within cells of neighbours",
                                b.horizon),
                    "a text mesh has neighbours by distance alone");
  if (converted.good() && reader.fixed_dt <= 0 && reader.safety_factor <= 0)
    add_error(converted.faults, deck.where, "the deck has no solver Verlet");
  if (converted.good()) UpsWriter(reader, converted).write();
  return converted;
}

}  // namespace sluice::peridynamics
