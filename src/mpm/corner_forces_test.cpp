// Forces that are handed in on corners between two stages of a step, and the sets before and after.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "mpm/levels/solid_levels.hpp"
#include "mpm/test_support/text_run.hpp"

namespace sluice::mpm::corner_forces_test {
namespace {

constexpr double push = 3;  // N, on every corner of an outer face, once for each

// What the component below saw.
struct Seen {
  int steps = 0;
  std::size_t corners = 0;  // pushed in a step
  double farthest = 0;      // way of a corner in a step
};

// Corners of particles that a face on the low side of x has outward.
solids::CornerForces pushed(const ParticleSet& set, const Columns& c) {
  solids::CornerForces forces;
  const CornerColumns x = corners_of(set, c);
  const double* outer = set.column(c.outer);
  for (std::size_t p = 0; p < set.size(); ++p) {
    if ((static_cast<int>(outer[p]) & outer_face_bit(0, 0)) == 0) continue;
    for (std::size_t k = 0; k < static_cast<std::size_t>(c.corner_count); k += 2)
      forces.push_back({{x[3 * k][p], x[3 * k + 1][p], x[3 * k + 2][p]}, {push, 0, 0}});
  }
  return forces;
}

class PushedSolids final : public Mpm {
 public:
  PushedSolids(const Scene& scene, const MpmScene& solids, Seen& seen)
      : Mpm(scene, solids), scene_(scene), solids_(solids), seen_(seen) {}

  const MpmStep& step() const override { return own_; }
  void declare_stages(StepShape& shape) const {
    const auto& particles = static_cast<const SolidParticles&>(*this->particles());
    const auto step =
        std::make_shared<SolidLevels>(scene_, solids_, particles.carried(), particles.kinds());
    const auto stage = [&](const char* name, Verdict (SolidLevels::*act)(const StageScope&)) {
      shape.stage(name, [step, act](const StageScope& scope) { return ((*step).*act)(scope); });
    };
    const Columns c = particles.carried().front().columns;
    stage("begin", &SolidLevels::begin);
    shape.stage("push", [step, c, this](const StageScope& scope) {
      solids::CornerForces forces;
      const ParticleStore& store = scope.particles->store(0);
      for (int b = 0; b < store.box_count(0); ++b)
        for (const CornerForce& f : pushed(store.set(0, b), c)) forces.push_back(f);
      seen_.corners = forces.size();
      step->add_corner_forces(scope, {{forces}});
      return Verdict::good;
    });
    stage("to grid", &SolidLevels::to_grid);
    stage("sums", &SolidLevels::share_sums);
    stage("nodes", &SolidLevels::move_nodes);
    stage("from grid", &SolidLevels::from_grid);
    shape.stage("look", [c, this](const StageScope& scope) {
      ++seen_.steps;
      for (int b = 0; b < scope.particles->store(0).box_count(0); ++b) {
        const auto [before, after] = SolidLevels::moved(*scope.particles, 0, 0, b);
        const CornerColumns x = corners_of(before, c), y = corners_of(after, c);
        for (std::size_t p = 0; p < before.size(); ++p)
          seen_.farthest = std::fmax(seen_.farthest, std::fabs(y[0][p] - x[0][p]));
      }
      return Verdict::good;
    });
    stage("take over", &SolidLevels::commit);
  }

 private:
  struct Step final : MpmStep {
    explicit Step(const PushedSolids& of) : MpmStep(of), pushed(&of) {}
    void declare_stages(StepShape& stages) const override { pushed->declare_stages(stages); }
    const PushedSolids* pushed;
  };
  Step own_{*this};
  const Scene& scene_;
  MpmScene solids_;
  Seen& seen_;
};

SolidDeck block() {
  SolidDeck deck;
  deck.flags = "<interpolator>carried_corners</interpolator><transfer>flip</transfer>";
  deck.upper = "[1,1,0.1]";
  deck.cells = "[10,10,1]";
  deck.objects =
      "<geom_object><box><min>[0.2,0.3,-1]</min><max>[0.4,0.6,1]</max></box><res>[2,2,1]</res>"
      "<velocity>[0,0,0]</velocity><temperature>300</temperature></geom_object>";
  return deck;
}

TextRun::Rewrites saves() {
  return {{"<maxTime>1<", "<maxTime>0.02<"},
          {"<outputInterval>0</outputInterval>",
           "<outputInterval>1</outputInterval><outputLastTimestep>true</outputLastTimestep>"
           "<save label='TotalMomentum'/><save label='p.x'/><save label='p.stress'/>"}};
}

// Twelve corners of six faces: the block gets their impulse and no other.
TEST(CornerForces, TheirImpulseIsTheMomentumOfTheBody) {
  Seen seen;
  const TextRun run(block(), saves(), "pushed", 1,
                    [&](const Scene& scene, const MpmScene& solids) -> std::unique_ptr<Mpm> {
                      return std::make_unique<PushedSolids>(scene, solids, seen);
                    });
  EXPECT_EQ(seen.corners, 12u);
  EXPECT_EQ(seen.steps, static_cast<int>(run.report().steps));
  EXPECT_GT(seen.farthest, 0);
  const auto rows = run.history("TotalMomentum");
  ASSERT_GT(rows.size(), 3u);
  const std::vector<double>&last = rows.back(), &before = rows[rows.size() - 2];
  const double impulse =
      12 * push * 0.5 * (last[0] + before[0]);  // velocities are half a step back
  RecordProperty("error", fmt::format("{:.1e}", last[1] / impulse - 1));
  EXPECT_NEAR(last[1], impulse, 1e-12 * impulse);
  EXPECT_NEAR(last[2], 0, 1e-12 * impulse);
}

TEST(CornerForces, ThreadsChangeNoBit) {
  std::vector<std::vector<double>> x[2];
  for (const int n : {0, 1}) {
    Seen seen;
    const TextRun run(block(), saves(), "pushed_by_threads", 1 + n,
                      [&](const Scene& scene, const MpmScene& solids) -> std::unique_ptr<Mpm> {
                        return std::make_unique<PushedSolids>(scene, solids, seen);
                      });
    x[n] = run.particles("p.stress");
  }
  EXPECT_EQ(x[0], x[1]);
}

// The flag for couplings: corners whatever the deck's basis is.
TEST(CornerForces, CarryCornersTakesTheBasisOfAnyDeck) {
  SolidDeck deck = block();
  deck.flags = "<interpolator>quadraticBS</interpolator><transfer>apic</transfer>";
  deck.objects.replace(deck.objects.find("[2,2,1]"), 7, "[2,2,2]");
  const TextRun run(deck, saves(), "taken", 1, [&](const Scene& scene, MpmScene solids) {
    solids.carry_corners({true, true, false});
    EXPECT_EQ(solids.transfer, Transfer::affine);
    for (const SeedObject& o : solids.materials.front().objects) EXPECT_EQ(o.per_cell.z, 1);
    return std::make_unique<Mpm>(scene, solids);
  });
  EXPECT_GT(run.report().steps, 1);
}

}  // namespace
}  // namespace sluice::mpm::corner_forces_test
