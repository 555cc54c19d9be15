// For the tests of this room: a deck run to its end, and what its archive says.
#pragma once
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <functional>
#include <sstream>
#include <string>
#include <vector>

#include "framework/archive/archive.hpp"
#include "framework/archive/selection.hpp"
#include "framework/base/temporary_folder.hpp"
#include "framework/deck/format/framework_schema.hpp"
#include "framework/deck/load_deck.hpp"
#include "framework/run/simulation/simulation.hpp"
#include "framework/scene/deck_values.hpp"
#include "framework/solve/solver_tags.hpp"

namespace sluice::examples {

// How a component is described and made.
struct Example {
  void (*add_tags)(Schema&);
  std::unique_ptr<Component> (*make)(const Deck&, const Scene&, std::vector<Fault>&);
};

struct ExampleOptions {
  IntVec3 boxes{};  // of the level; 0: as the deck says
  int threads = 1;
  IntVec3 block{};
};

// A deck with what all examples share; `blocks`: the component's own, and what it has beside.
struct ExampleDeck {
  std::string type, blocks, save;
  IntVec3 cells{8, 8, 8};
  double low = 0, high = 1;  // of the domain, along every direction
  std::string sides;         // <Face>s
  IntVec3 periodic{};
  double end = 1e9;
  int max_steps = 0;  // 0: until the end
  double multiplier = 1;

  std::string text() const {
    std::ostringstream t;
    t << "<Uintah_specification>\n<SimulationComponent type=\"" << type << "\"/>\n<Time><maxTime>"
      << end << "</maxTime><initTime>0</initTime><delt_min>0</delt_min><delt_max>0</delt_max>"
      << "<timestep_multiplier>" << multiplier << "</timestep_multiplier><max_Timesteps>"
      << max_steps << "</max_Timesteps><end_at_max_time_exactly>true</end_at_max_time_exactly>"
      << "</Time>\n<DataArchiver><filebase>example.uda</filebase><outputTimestepInterval>1000000"
      << "</outputTimestepInterval><outputLastTimestep>true</outputLastTimestep>" << save
      << "</DataArchiver>\n"
      << blocks << "\n<Grid>\n<BoundaryConditions>" << sides
      << "</BoundaryConditions>\n<Level><Box label=\"all\"><lower>" << corner(low)
      << "</lower><upper>" << corner(high) << "</upper><resolution>[" << cells.x << ',' << cells.y
      << ',' << cells.z << "]</resolution><patches>[1,1,1]</patches></Box><periodic>[" << periodic.x
      << ',' << periodic.y << ',' << periodic.z << "]</periodic></Level></Grid>\n"
      << "</Uintah_specification>\n";
    return t.str();
  }
  static std::string corner(double x) {
    const std::string s = std::to_string(x);
    return '[' + s + ',' + s + ',' + s + ']';
  }
};

// All faults of a deck, a line each.
inline std::string faults_of(const Example& example, const std::string& deck_text) {
  Schema schema;
  add_framework_tags(schema);
  solve::add_solver_tag(schema);
  example.add_tags(schema);
  const Deck deck = load_deck_text(deck_text, "deck.ups", {}, schema);
  std::vector<Fault> faults = deck.faults;
  if (deck.good()) {
    const Scene scene = read_scene(deck, SceneOptions{}, faults);
    if (!any_error(faults)) example.make(deck, scene, faults);
  }
  std::string text;
  for (const Fault& f : faults) text += to_string(f) + '\n';
  return text;
}

class ExampleRun {
 public:
  ExampleRun(const Example& example, const std::string& deck_text, ExampleOptions o = {}) {
    Schema schema;
    add_framework_tags(schema);
    solve::add_solver_tag(schema);
    example.add_tags(schema);
    const Deck deck = load_deck_text(deck_text, "deck.ups", {}, schema);
    for (const Fault& f : deck.faults)
      if (f.severity == Severity::error) throw InputError(to_string(f));
    SceneOptions scene_options;
    scene_options.boxes = o.boxes;
    const Scene scene = read_scene(deck, scene_options);
    std::vector<Fault> faults;
    const auto component = example.make(deck, scene, faults);
    if (component == nullptr) throw InputError(to_string(faults.front()));
    RunOptions run;
    run.parent = folder_.path();
    run.progress = ProgressMode::none;
    run.threads = o.threads;
    run.block = o.block;
    run.deck_xml = deck_text;
    report_ = Simulation(scene, *component, world(), run).run();
    if (report_.status == RunStatus::failed) throw PhysicsError(report_.message);
  }

  const RunReport& report() const { return report_; }
  Archive archive() const { return Archive::open(*report_.archive); }

  // f(position, value) at every place of the last output of a field on a level.
  void for_each(const std::string& name, const std::function<void(Vec3, double)>& f,
                int level = 0) const {
    const Archive a = archive();
    const ArchiveStep step = a.read_output(a.select_output("last"));
    const FieldInfo& info = *step.find(name, 0, level);
    const DenseField field = step.read(info);
    for_each_cell(field.cells, [&](IntVec3 c) {
      if (field.has(c)) f(position(step.grid().levels[level], info.centring, c), field.at(c));
    });
  }
  std::vector<double> values(const std::string& name) const {
    std::vector<double> all;
    for_each(name, [&](Vec3, double v) { all.push_back(v); });
    return all;
  }
  // Largest |value - exact(x)| over places where `where` holds.
  double worst(
      const std::string& name, const std::function<double(Vec3)>& exact,
      const std::function<bool(Vec3)>& where = [](Vec3) { return true; }) const {
    double most = 0;
    int places = 0;
    for_each(name, [&](Vec3 x, double v) {
      if (!where(x)) return;
      ++places;
      most = std::max(most, std::isfinite(v) ? std::abs(v - exact(x)) : 1e300);
    });
    EXPECT_GT(places, 0);
    return most;
  }
  // The numbers of a .dat history, a step each.
  std::vector<double> history(const std::string& name) const {
    std::ifstream file(std::filesystem::path(*report_.archive) / (name + ".dat"));
    std::vector<double> values;
    double time, value;
    for (std::string line; std::getline(file, line);)
      if (std::istringstream s(line); s >> time >> value) values.push_back(value);
    return values;
  }

 private:
  TemporaryFolder folder_;
  RunReport report_;
};

}  // namespace sluice::examples
