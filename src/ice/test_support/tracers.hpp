// Gas with tracers, run in this process through all its levels.
#pragma once
#include <gtest/gtest.h>

#include <map>

#include "ice/test_support/deck_run.hpp"

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

class TracerRun : public DeckRun {
 public:
  using Particles = std::map<std::int64_t, SeenParticle>;

  // `level`: text of further <Level> or <AMR> elements.
  explicit TracerRun(const GasBox& box, IntVec3 boxes = {}, const std::string& level = {},
                     const std::string& amr = {}, int threads = 1)
      : DeckRun(text_of(box, level, amr), boxes, threads) {}

  // To the end, in steps as long as the flow allows; returns how many.
  int run(double end, double share = 1) {
    int steps = 0;
    for (; time() < end; ++steps)
      if (!attempt(std::min(share * limit(), end - time())))
        throw PhysicsError("inadmissible step");
    return steps;
  }

  Particles particles() const {
    Particles all;
    const ParticleStore& store = hierarchy().particles()->store(0);
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
  ParticleCount count() const { return hierarchy().particles()->counts().front(); }

 private:
  static std::string text_of(GasBox box, const std::string& level, const std::string& amr) {
    box.scheme = "conservative";
    std::string text = deck_text(box);
    return text.replace(text.find("</Level></Grid>"), 15, "</Level>" + level + "</Grid>" + amr);
  }
};

}  // namespace sluice::ice
