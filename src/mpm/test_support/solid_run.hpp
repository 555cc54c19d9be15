// A deck of solids that runs in this process, and the particles that it leaves.
#pragma once
#include <algorithm>
#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "framework/archive/particle_table.hpp"
#include "framework/base/error.hpp"
#include "framework/base/temporary_folder.hpp"
#include "framework/deck/format/framework_schema.hpp"
#include "framework/deck/load_deck.hpp"
#include "framework/run/simulation/simulation.hpp"
#include "framework/scene/scene.hpp"
#include "mpm/deck/read_mpm_scene.hpp"
#include "mpm/deck/schema.hpp"
#include "mpm/mpm.hpp"
#include "sluice_source_dir.hpp"

namespace sluice::mpm {

class SolidRun {
 public:
  // A deck of inputs/mpm, without ".ups". InputError with the first error of the deck.
  explicit SolidRun(const std::string& name, const std::vector<std::string>& overrides = {},
                    int threads = 1, IntVec3 boxes = {}) {
    Schema schema;
    add_framework_tags(schema);
    schema.add(tag("MaterialProperties", "materials").multiple());
    add_mpm_tags(schema);
    const std::string file = std::string(SLUICE_SOURCE_DIR) + "/inputs/mpm/" + name + ".ups";
    const Deck deck = load_deck(file, overrides, schema);
    std::vector<Fault> faults = deck.faults;
    throw_errors(faults);
    SceneOptions options;
    options.boxes = boxes;
    scene_ = read_scene(deck, options, faults);
    throw_errors(faults);
    MpmScene solids = read_mpm_scene(deck, scene_, faults);
    throw_errors(faults);
    const Mpm component(scene_, std::move(solids));
    RunOptions run;
    run.parent = folder_.path();
    run.threads = threads;
    run.progress = ProgressMode::none;
    run.program = "test";
    run.deck_xml = to_xml(*deck.root);
    Simulation simulation(scene_, component, world(), run);
    report_ = simulation.run();
    for (const auto& entry : std::filesystem::directory_iterator(folder_.path()))
      if (entry.path().filename().string().find(".uda") != std::string::npos)
        archive_ = entry.path();
  }

  const RunReport& report() const { return report_; }
  const Scene& scene() const { return scene_; }
  Archive archive() const { return Archive::open(archive_); }
  ParticleTable particles(const std::string& which = "last", int material = 0) const {
    const Archive all = archive();
    return read_particles(all.read_output(all.select_output(which)), material);
  }

 private:
  static void throw_errors(const std::vector<Fault>& faults) {
    for (const Fault& f : faults)
      if (f.severity == Severity::error) throw InputError(to_string(f));
  }

  TemporaryFolder folder_;
  std::filesystem::path archive_;
  Scene scene_;
  RunReport report_;
};

}  // namespace sluice::mpm
