// Surfaces of bodies at the nodes at which they meet, against sums over all particles by the
// formula of the weights; elsewhere nothing is gathered.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "mpm/contact/surface_sums.hpp"
#include "mpm/levels/solid_levels.hpp"
#include "mpm/test_support/text_run.hpp"

namespace sluice::mpm::surfaces_test {
namespace {

constexpr double spacing = 0.1;      // m
constexpr double half = 0.25;        // width of a particle, cells
constexpr double round_off = 1e-12;  // of sums over that of a full node

// What the component below saw.
struct Seen {
  int meetings = 0;     // nodes at which both bodies have mass, over all steps
  int gathered = 0;     // steps in which surfaces were gathered
  double volume = 0;    // worst error of a volume, of that of a cell
  double gradient = 0;  // of a gradient, of the area of a face
};

// GIMP of one axis at a distance from the node in cells (Bardenhagen, Kober 2004), and its slope.
double weight(double x) {
  const double r = std::fabs(x);
  if (r < half) return 1 - (r * r + half * half) / (2 * half);
  if (r < 1 - half) return 1 - r;
  return r < 1 + half ? (1 + half - r) * (1 + half - r) / (4 * half) : 0;
}
double slope(double x) {
  const double r = std::fabs(x), sign = x > 0 ? -1 : 1;
  if (r < half) return sign * r / half;
  if (r < 1 - half) return sign;
  return r < 1 + half ? sign * (1 + half - r) / (2 * half) : 0;
}

// V and N of a body at a node; the bodies stand on the mirror y = 0.
SurfaceAtNode by_formula(const ParticleStore& store, const Columns& c, Vec3 node) {
  SurfaceAtNode sum;
  for (int b = 0; b < store.box_count(0); ++b) {
    const ParticleSet& set = store.set(0, b);
    for (std::size_t p = 0; p < set.size(); ++p)
      for (const double image : {1.0, -1.0}) {
        if (image < 0 && node.y == 0) continue;  // nodes on a mirror have their half alone
        Vec3 x = set.position(p);
        x.y *= image;
        const Vec3 way = (1 / spacing) * (x - node);
        const double V = set.column(static_cast<std::size_t>(c.volume))[p];
        const Vec3 w{weight(way.x), weight(way.y), weight(way.z)};
        sum.volume += V * w.x * w.y * w.z;
        // Of the node's weight at the particle: it falls with the distance.
        sum.gradient.x += V * slope(way.x) * w.y * w.z / spacing;
        sum.gradient.y += V * w.x * slope(way.y) * w.z / spacing;
        sum.gradient.z += V * w.x * w.y * slope(way.z) / spacing;
      }
  }
  return sum;
}

class Watched final : public Mpm {
 public:
  Watched(const Scene& scene, const MpmScene& solids, Seen& seen)
      : Mpm(scene, solids), scene_(scene), solids_(solids), seen_(seen) {}

  const MpmStep& step() const override { return own_; }
  void declare_stages(StepShape& shape) const {
    const auto& particles = static_cast<const SolidParticles&>(*this->particles());
    const auto step =
        std::make_shared<SolidLevels>(scene_, solids_, particles.carried(), particles.kinds());
    const auto stage = [&](const char* name, Verdict (SolidLevels::*act)(const StageScope&)) {
      shape.stage(name, [step, act](const StageScope& scope) { return ((*step).*act)(scope); });
    };
    stage("begin", &SolidLevels::begin);
    stage("to grid", &SolidLevels::to_grid);
    stage("sums", &SolidLevels::share_sums);
    shape.stage("look", [step, this](const StageScope& scope) {
      look(*step, scope);
      return Verdict::good;
    });
    stage("nodes", &SolidLevels::move_nodes);
    stage("back", &SolidLevels::map_back);
    stage("from grid", &SolidLevels::from_grid);
    stage("take over", &SolidLevels::commit);
  }

 private:
  void look(SolidLevels& levels, const StageScope& scope) const {
    const std::vector<Body>& bodies = levels.level(0).bodies();
    const ContactStage* contact = levels.level(0).contact();
    if (contact != nullptr && contact->surfaces().sums(0).blocks() > 0) ++seen_.gathered;
    const BlockShape shape = bodies[0].table.shape();
    for (int b = 0; b < bodies[0].table.count(); ++b) {
      const IntVec3 block = bodies[0].table.block(b);
      const int other = bodies[1].table.find(block);
      if (other < 0) continue;
      const int numbers[2] = {b, other};
      for_each_node(shape, shape.lower(block), [&](int n, IntVec3 node) {
        for (std::size_t m = 0; m < 2; ++m)
          if (bodies[m].nodes.sums(numbers[m])[n * lanes + lanes - 1] == 0) return;
        if (node.y < 0) return;
        ++seen_.meetings;
        for (std::size_t m = 0; m < 2; ++m)
          compare(contact->surfaces().at({static_cast<int>(m), numbers[m]}, n),
                  by_formula(scope.particles->store(static_cast<int>(m)),
                             bodies[m].carried->columns, spacing * to_real(node)));
      });
    }
  }
  void compare(const SurfaceAtNode& found, const SurfaceAtNode& wanted) const {
    const double area = spacing * spacing;
    seen_.volume =
        std::fmax(seen_.volume, std::fabs(found.volume - wanted.volume) / (area * spacing));
    for (int d = 0; d < 3; ++d)
      seen_.gradient =
          std::fmax(seen_.gradient, std::fabs(found.gradient[d] - wanted.gradient[d]) / area);
  }

  struct Step final : MpmStep {
    explicit Step(const Watched& of) : MpmStep(of), watched(&of) {}
    void declare_stages(StepShape& stages) const override { watched->declare_stages(stages); }
    const Watched* watched;
  };
  Step own_{*this};
  const Scene& scene_;
  MpmScene solids_;
  Seen& seen_;
};

std::string box(const std::string& low, const std::string& high, const std::string& velocity) {
  return "<geom_object><box><min>" + low + "</min><max>" + high +
         "</max></box><res>[2,2,2]</res><velocity>" + velocity +
         "</velocity><temperature>300</temperature></geom_object>";
}

// Two blocks that stand on a mirror, with a rule or without, the second from x on.
SolidDeck two_blocks(const std::string& x, const std::string& end, bool rule) {
  SolidDeck deck;
  deck.flags =
      "<interpolator>gimp</interpolator><DoExplicitHeatConduction>false"
      "</DoExplicitHeatConduction>";
  deck.objects = box("[0.15,0,0.2]", "[0.35,0.3,0.5]", "[4,0,1]");
  deck.further =
      solid_material("second", box("[" + x + ",0,0.25]", "[" + end + ",0.2,0.45]", "[-4,0,0]"));
  if (rule)
    deck.contacts =
        "<contact><type>friction</type><mu>0.3</mu><materials>[0,1]</materials></contact>";
  return deck;
}

TextRun::Rewrites ten_steps() {
  return {{"<maxTime>1<", "<max_Timesteps>10</max_Timesteps><maxTime>1<"},
          {"<outputInterval>0</outputInterval>", saves({"p.x", "p.velocity", "p.stress"})}};
}

Seen seen_in(const SolidDeck& deck, int threads) {
  Seen seen;
  const TextRun run(deck, ten_steps(), "surfaces", threads,
                    [&](const Scene& scene, const MpmScene& solids) -> std::unique_ptr<Mpm> {
                      return std::make_unique<Watched>(scene, solids, seen);
                    });
  EXPECT_EQ(run.report().steps, 10);
  return seen;
}

TEST(Surfaces, AreThoseOfAllParticlesWhereBodiesMeet) {
  for (const int threads : {1, 2}) {
    const Seen seen = seen_in(two_blocks("0.4", "0.6", true), threads);
    EXPECT_GT(seen.meetings, 100);
    EXPECT_EQ(seen.gathered, 10);
    RecordProperty("worst", fmt::format("{:.1e} {:.1e}", seen.volume, seen.gradient));
    EXPECT_LT(seen.volume, round_off);
    EXPECT_LT(seen.gradient, round_off);
  }
}

TEST(Surfaces, AreNotGatheredForBodiesOutOfReach) {
  const Seen seen = seen_in(two_blocks("0.8", "0.95", true), 1);
  EXPECT_EQ(seen.meetings, 0);
  EXPECT_EQ(seen.gathered, 0);
}

TEST(Surfaces, ARuleOutOfReachChangesNoBit) {
  std::vector<std::vector<double>> found[2][3];
  for (const std::size_t n : {0, 1}) {
    const TextRun run(two_blocks("0.8", "0.95", n == 1), ten_steps(), "out_of_reach");
    int k = 0;
    for (const char* label : {"p.x", "p.velocity", "p.stress"})
      found[n][k++] = run.particles(label);
  }
  for (int k = 0; k < 3; ++k) EXPECT_EQ(found[0][k], found[1][k]);
}

}  // namespace
}  // namespace sluice::mpm::surfaces_test
