// A deck of inputs/mpmice, or one of a few parts, that runs in this process, and what it leaves.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "framework/archive/archive.hpp"
#include "framework/base/error.hpp"
#include "framework/base/json.hpp"
#include "framework/base/temporary_folder.hpp"
#include "framework/deck/format/framework_schema.hpp"
#include "framework/deck/load_deck.hpp"
#include "framework/run/simulation/simulation.hpp"
#include "framework/solve/solver_tags.hpp"
#include "ice/deck/schema.hpp"
#include "mpm/deck/schema.hpp"
#include "mpmice/make_component.hpp"
#include "mpmice/test_support/coupled_deck.hpp"
#include "sluice_source_dir.hpp"

namespace sluice::mpmice {

class CoupledRun {
 public:
  // `max_steps`: the run ends there, with a checkpoint. `earlier`: it goes on from that one.
  explicit CoupledRun(const std::string& name, const std::vector<std::string>& overrides = {},
                      int threads = 1, IntVec3 boxes = {}, int max_steps = 0,
                      const CoupledRun* earlier = nullptr) {
    max_steps_ = max_steps;
    if (earlier != nullptr) restart_ = *earlier->report().archive;
    const std::string file = std::string(SLUICE_SOURCE_DIR) + "/inputs/mpmice/" + name + ".ups";
    run(load_deck(file, overrides, tags()), threads, boxes);
  }
  explicit CoupledRun(const CoupledDeck& deck, const std::vector<std::string>& overrides = {},
                      int threads = 1, IntVec3 boxes = {}, bool force_all = false) {
    force_all_ = force_all;
    run(load_deck_text(text_of(deck), "coupled.ups", overrides, tags()), threads, boxes);
  }

  const RunReport& report() const { return report_; }
  // Drift of a conserved quantity, as a share of its scale.
  double drift(const std::string& quantity) const {
    return Json::parse(report_.conservation_json).at(quantity).at("drift").get<double>();
  }
  double worst_drift_but_energy() const {
    double worst = 0;
    for (const char* name : {"momentum x", "momentum y", "momentum z"})
      worst = std::max(worst, std::fabs(drift(name)));
    for (int m = 0; m < component_->material_count(); ++m)
      worst = std::max(worst, std::fabs(drift("mass of material " + std::to_string(m))));
    return worst;
  }
  // A component of a field at the last output.
  DenseField field(const std::string& label, int material) const {
    const Archive archive = Archive::open(*report_.archive);
    const ArchiveStep step = archive.read_output(archive.select_output("last"));
    const FieldInfo* info = step.find(label, material, 0);
    if (info == nullptr) throw std::runtime_error("no field " + label);
    return step.read(*info);
  }
  std::vector<std::vector<double>> particles(const std::string& label, int material = 0) const {
    const Archive archive = Archive::open(*report_.archive);
    const ArchiveStep step = archive.read_output(archive.select_output("last"));
    const FieldInfo* info = step.find_particles(label, material, 0);
    if (info == nullptr) throw std::runtime_error("no particles have " + label);
    return step.read_particles(*info);
  }

 private:
  static Schema tags() {
    Schema schema;
    add_framework_tags(schema);
    solve::add_solver_tag(schema);
    add_ice_tags(schema);
    mpm::add_mpm_tags(schema);
    return schema;
  }
  void run(const Deck& deck, int threads, IntVec3 boxes) {
    std::vector<Fault> faults = deck.faults;
    throw_errors(faults);
    SceneOptions options;
    options.boxes = boxes;
    scene_ = read_scene(deck, options, faults);
    throw_errors(faults);
    component_ = make_component(deck, scene_, faults);
    throw_errors(faults);
    RunOptions run;
    run.parent = folder_.path();
    run.threads = threads;
    run.progress = ProgressMode::none;
    run.program = "test";
    run.deck_xml = to_xml(*deck.root);
    run.limits.max_steps = max_steps_;
    run.force_all = force_all_;
    run.restart = restart_;
    report_ = Simulation(scene_, *component_, world(), run).run();
  }
  static void throw_errors(const std::vector<Fault>& faults) {
    for (const Fault& f : faults)
      if (f.severity == Severity::error) throw InputError(to_string(f));
  }

  int max_steps_ = 0;
  bool force_all_ = false;
  std::string restart_;
  TemporaryFolder folder_;
  Scene scene_;
  std::unique_ptr<MpmIce> component_;
  RunReport report_;
};

}  // namespace sluice::mpmice
