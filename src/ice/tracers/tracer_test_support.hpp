// Gas with tracers, run in this process through all its levels.
#pragma once
#include <gtest/gtest.h>

#include <map>

#include "framework/run/hierarchy.hpp"
#include "framework/scene/deck_values.hpp"
#include "ice/classic/classic_test_support.hpp"

namespace sluice::ice {

inline std::string tracer_box(const char* low, const char* high) {
  return fmt::format("<box><min>{}</min><max>{}</max></box>", low, high);
}
inline std::string tracer_start(const std::string& piece, double per_cell) {
  return fmt::format("<geom_object>{}<particlesPerCell>{}</particlesPerCell></geom_object>", piece,
                     per_cell);
}
inline std::string tracer_source(const std::string& piece, double rate) {
  return fmt::format(
      "<geom_object>{}<particlesPerCellPerSecond>{}</particlesPerCellPerSecond></geom_object>",
      piece, rate);
}
inline std::string tracer_model(const std::string& start, const std::string& sources = {},
                                const std::string& other = {}) {
  return fmt::format(
      "<Model type='TracerParticles'><TracerParticles><material>gas</material>{}<tracer "
      "name='dust'>"
      "<initialization>{}</initialization>{}</tracer></TracerParticles></Model>",
      other, start, sources.empty() ? "" : "<interiorSources>" + sources + "</interiorSources>");
}

struct SeenParticle {
  Vec3 place{};
  double carried = 0;  // its first attribute
  int level = 0;
  friend bool operator==(const SeenParticle&, const SeenParticle&) = default;
};

class TracerRun {
 public:
  using Particles = std::map<std::int64_t, SeenParticle>;

  // `level`: text of further <Level> or <AMR> elements.
  explicit TracerRun(GasBox box, IntVec3 boxes = {}, const std::string& level = {},
                     const std::string& amr = {}, int threads = 1) {
    box.scheme = "conservative";
    std::string text = deck_text(box);
    text.replace(text.find("</Level></Grid>"), 15, "</Level>" + level + "</Grid>" + amr);
    Schema schema;
    add_framework_tags(schema);
    add_ice_tags(schema);
    deck_ = load_deck_text(text, "box.ups", {}, schema);
    std::vector<Fault> faults = deck_.faults;
    SceneOptions scene_options;
    scene_options.boxes = boxes;
    if (deck_.good()) scene_ = read_scene(deck_, scene_options, faults);
    IceScene ice_scene;
    if (!any_error(faults)) ice_scene = read_ice_scene(deck_, scene_, faults);
    for (const Fault& f : faults)
      if (f.severity == Severity::error) throw InputError(to_string(f));
    ice_ = std::make_unique<Ice>(scene_, std::move(ice_scene));
    SolverOptions options;
    options.threads = threads;
    hierarchy_ = std::make_unique<Hierarchy>(scene_, *ice_, world(), options);
    hierarchy_->initialise();
  }

  // To the end, in steps as long as the flow allows; returns how many.
  int run(double end, double share = 1) {
    int steps = 0;
    for (; time_ < end; ++steps) {
      const double dt = std::min(share * hierarchy_->step_limit().dt, end - time_);
      const CycleResult& result = hierarchy_->attempt(++step_, time_, dt, {}, *control_, ledger_);
      if (!result.good) throw PhysicsError("inadmissible step");
      hierarchy_->accept();
      time_ = time_ + dt;
      hierarchy_->regrid(step_);
    }
    return steps;
  }

  Particles particles() const {
    Particles all;
    const ParticleStore& store = hierarchy_->particles()->store(0);
    for (int l = 0; l < store.level_count(); ++l)
      for (int b = 0; b < store.box_count(l); ++b) {
        const ParticleSet& set = store.set(l, b);
        for (std::size_t n = 0; n < set.size(); ++n) {
          const double carried = set.attribute_count() > 0 ? set.attribute_values(0)[n] : 0;
          const bool fresh =
              all.emplace(set.id(n), SeenParticle{set.position(n), carried, l}).second;
          EXPECT_TRUE(fresh) << set.id(n);
        }
      }
    return all;
  }
  ParticleCount count() const { return hierarchy_->particles()->counts().front(); }
  double time() const { return time_; }
  Hierarchy& hierarchy() { return *hierarchy_; }
  const Ice& ice() const { return *ice_; }
  const Level& level() const { return scene_.grid.levels.front(); }

 private:
  Deck deck_;
  Scene scene_;
  std::unique_ptr<Ice> ice_;
  std::unique_ptr<Hierarchy> hierarchy_;
  std::shared_ptr<RunControl> control_ = shared_control();
  EventLedger ledger_;
  double time_ = 0;
  int step_ = 0;
};

}  // namespace sluice::ice
