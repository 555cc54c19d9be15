// A deck of peridynamic solids run to its end, and what its archive says.
#pragma once
#include <fstream>
#include <map>
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
#include "peridynamics/deck/schema.hpp"
#include "peridynamics/peridynamics.hpp"

namespace sluice::peridynamics {

inline Schema peri_schema() {
  particle_labels();
  declare_labels();
  Schema schema;
  add_framework_tags(schema);
  add_tags(schema);
  return schema;
}

// All faults of a deck, a line each.
inline std::string faults_of(const std::string& deck_text) {
  const Deck deck = load_deck_text(deck_text, "deck.ups", {}, peri_schema());
  std::vector<Fault> faults = deck.faults;
  if (deck.good()) {
    const Scene scene = read_scene(deck, SceneOptions{}, faults);
    if (!any_error(faults)) make(deck, scene, faults);
  }
  std::string text;
  for (const Fault& f : faults) text += to_string(f) + '\n';
  return text;
}

// What decks of tests have in common.
struct PeriDeck {
  std::string settings = "<influence>one</influence>";
  std::string material;  // density, models, objects
  std::string beside;    // of the block of materials
  std::string save =
      "<save label=\"p.displacement\"/><save label=\"p.velocity\"/><save label=\"p.dilatation\"/>"
      "<save label=\"KineticEnergy\"/><save label=\"StrainEnergy\"/>";
  Vec3 lower{0, 0, 0}, upper{1, 1, 1};
  IntVec3 cells{8, 8, 8}, periodic{};
  std::string sides;
  double end = 1, dt = 0;  // 0: as long as the physics allows, by the multiplier
  double multiplier = 0.9;
  int max_steps = 0;

  std::string text() const {
    std::ostringstream t;
    t.precision(17);
    const auto vector = [&](auto v) { t << '[' << v.x << ',' << v.y << ',' << v.z << ']'; };
    t << "<Uintah_specification>\n<SimulationComponent type=\"peridynamics\"/>\n<Time><maxTime>"
      << end << "</maxTime><initTime>0</initTime><delt_min>0</delt_min><delt_max>"
      << (dt > 0 ? dt : 1e9) << "</delt_max><timestep_multiplier>" << multiplier
      << "</timestep_multiplier><max_Timesteps>" << max_steps
      << "</max_Timesteps><end_at_max_time_exactly>" << (dt > 0 ? "false" : "true")
      << "</end_at_max_time_exactly></Time>\n<DataArchiver><filebase>peri.uda</filebase>"
      << "<outputTimestepInterval>1000000</outputTimestepInterval><outputLastTimestep>true"
      << "</outputLastTimestep>" << save << "</DataArchiver>\n<Peridynamics>" << settings
      << "</Peridynamics>\n<MaterialProperties><Peridynamics><material name=\"solid\">" << material
      << "</material>" << beside << "</Peridynamics></MaterialProperties>\n<Grid>"
      << "<BoundaryConditions>" << sides
      << "</BoundaryConditions><Level><Box label=\"all\"><lower>";
    vector(lower);
    t << "</lower><upper>";
    vector(upper);
    t << "</upper><resolution>";
    vector(cells);
    t << "</resolution><patches>[1,1,1]</patches></Box><periodic>";
    vector(periodic);
    t << "</periodic></Level></Grid>\n</Uintah_specification>\n";
    return t.str();
  }
};

struct PeriOptions {
  IntVec3 boxes{};
  int threads = 1;
};

class PeriRun {
 public:
  explicit PeriRun(const std::string& deck_text, PeriOptions o = {}) {
    const Deck deck = load_deck_text(deck_text, "deck.ups", {}, peri_schema());
    for (const Fault& f : deck.faults)
      if (f.severity == Severity::error) throw InputError(to_string(f));
    SceneOptions scene_options;
    scene_options.boxes = o.boxes;
    const Scene scene = read_scene(deck, scene_options);
    std::vector<Fault> faults;
    const auto component = make(deck, scene, faults);
    if (component == nullptr) throw InputError(to_string(faults.front()));
    RunOptions run;
    run.parent = folder_.path();
    run.progress = ProgressMode::none;
    run.threads = o.threads;
    run.deck_xml = deck_text;
    report_ = Simulation(scene, *component, world(), run).run();
    if (report_.status == RunStatus::failed) throw PhysicsError(report_.message);
  }

  const RunReport& report() const { return report_; }
  // Components of a label at the last output, by id.
  std::map<std::int64_t, std::vector<double>> last(const std::string& label,
                                                   int material = 0) const {
    const Archive archive = Archive::open(*report_.archive);
    const ArchiveStep step = archive.read_output(archive.select_output("last"));
    const auto columns = step.read_particles(*step.find_particles(label, material, 0));
    const auto ids =
        step.read_particles(*step.find_particles(particle_labels().id.name(), material, 0));
    std::map<std::int64_t, std::vector<double>> all;
    for (std::size_t n = 0; n < ids[0].size(); ++n)
      for (const std::vector<double>& column : columns)
        all[static_cast<std::int64_t>(ids[0][n])].push_back(column[n]);
    return all;
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
  const std::filesystem::path& folder() const { return folder_.path(); }

 private:
  TemporaryFolder folder_;
  RunReport report_;
};

}  // namespace sluice::peridynamics
