// The midpoint transfer: bodies that turn, ring and move keep their energy.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "framework/base/json.hpp"
#include "mpm/nodes/node_sums.hpp"
#include "mpm/step/midpoint_motion.hpp"
#include "mpm/test_support/solid_run.hpp"
#include "mpm/test_support/text_run.hpp"
#include "mpm/transfer/impulses_from_grid.hpp"

namespace sluice::mpm::midpoint_test {
namespace {

// A rigid turn by 2 atan(w dt/2), whatever w dt.
TEST(EndOfStep, TurnsWithoutStrain) {
  const double dt = 0.7, w[3] = {0.4, -1.1, 2.3};
  GridAtParticles read;
  const double L[9] = {0, -w[2], w[1], w[2], 0, -w[0], -w[1], w[0], 0};
  for (int e = 0; e < 9; ++e) read.L[e][0] = L[e];
  to_end_of_step(dt, 1, read);
  double F[9];
  for (int e = 0; e < 9; ++e) F[e] = (e % 4 == 0 ? 1 : 0) + dt * read.L[e][0];
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      double product = 0;
      for (int k = 0; k < 3; ++k) product += F[3 * k + i] * F[3 * k + j];
      EXPECT_NEAR(product, i == j ? 1 : 0, 1e-15);
    }
  const double size = std::sqrt(w[0] * w[0] + w[1] * w[1] + w[2] * w[2]);
  EXPECT_NEAR(F[0] + F[4] + F[8], 1 + 2 * std::cos(2 * std::atan(0.5 * dt * size)), 1e-14);
}

// Columns of one particle that is stretched and sheared, as bases with corners ask for them;
// carried corners enclose no parallelepiped.
struct Stretched {
  double F[9] = {1.2, 0.1, -0.05, -0.2, 0.9, 0.15, 0.1, -0.1, 1.1};
  double edges[9] = {0.5, 0, 0, 0, 0.6, 0, 0, 0, 0.4};
  double corners[24];

  ParticleShape shape(Basis basis, const TransferGrid& grid, const double (&x)[3]) {
    ParticleShape s;
    for (std::size_t e = 0; e < 9; ++e) {
      s.F[e] = &F[e];
      s.edges[e] = &edges[e];
    }
    if (basis != Basis::carried) return s;
    for (int c = 0; c < 8; ++c)
      for (int d = 0; d < 3; ++d) {
        double sum = c == 0 || c == 6 ? 0.03 : -0.01;
        for (int e = 0; e < 3; ++e)
          sum += 0.5 * F[3 * d + e] * edges[4 * e] * (c >> e & 1 ? 1.0 : -1.0);
        const std::size_t at = 3 * c + d;
        corners[at] = x[d] + sum * grid.axes[d].spacing;
        s.corners[at] = &corners[at];
      }
    return s;
  }
};

// An impulse on nodes works on what a particle gave them as much as the particle gets:
//   sum J_i . S (v + w x r) = dv . v + I dw . w
TEST(Impulses, AreTheAdjointOfVelocitiesWithSpin) {
  Level level;
  level.spacing = {0.2, 0.1, 0.4};
  level.domain = {{0, 0, 0}, {8, 8, 8}};
  level.active = {true, true, true};
  TransferGrid grid;
  grid.count = 3;
  for (int d = 0; d < 3; ++d) {
    grid.axes[d] = axis_of(level, d);
    grid.active[d] = d;
  }
  grid.half = {0.25, 0.3, 0.5};
  const double x[3] = {0.71, 0.42, 1.53}, mass = 1, v[3] = {0.3, -0.2, 0.7};
  const double spin[3] = {1.5, -0.4, 0.8};
  Stretched stretched;
  for (const Basis basis :
       {Basis::gimp, Basis::quadratic, Basis::cubic, Basis::cpdi, Basis::cpti, Basis::carried}) {
    if (basis == Basis::quadratic) grid.half = {0.5, 0.5, 0.5};
    Window given(block_shape(level.active), 1), impulses(block_shape(level.active), 1);
    given.begin({0, 0, 0}, {7, 7, 7});
    impulses.begin({0, 0, 0}, {7, 7, 7});
    ParticlesToGrid p;
    p.mass = &mass;
    if (by_corners(basis)) p.shape = stretched.shape(basis, grid, x);
    for (std::size_t d = 0; d < 3; ++d) {
      p.x[d] = &x[d];
      p.v[d] = &v[d];
      p.spin[d] = &spin[d];
    }
    SumUnits units;
    units.mass = units.momentum = 0x1p45;
    add_to_window(basis, grid, p, 0, 1, units, given);
    double work = 0;
    for (int k = 0; k < 8; ++k)
      for (int j = 0; j < 8; ++j)
        for (int i = 0; i < 8; ++i)
          for (int d = 0; d < 3; ++d) {
            const double J = std::sin(3.7 * i + 5.1 * j - 2.3 * k + 1.9 * d);
            impulses.at(i, j, k)[4 + d] = as_bits(J);
            work += J * sum_in(given.at(i, j, k), 1 + d) / units.momentum;
          }
    ImpulsesAtParticles got;
    interpolate_impulses(basis, grid, p.x, p.shape, 0, 1, false, impulses, got);
    double found = 0;
    for (int d = 0; d < 3; ++d) found += got.dv[d][0] * v[d] + got.turn[d][0] * spin[d];
    EXPECT_NEAR(found, work, 1e-12);
    // Of velocities of a rigid turn about the particle a particle gets that turn.
    for (int axis = 0; axis < 3; ++axis) {
      const int one = (axis + 1) % 3, other = (axis + 2) % 3;
      for (int k = 0; k < 8; ++k)
        for (int j = 0; j < 8; ++j)
          for (int i = 0; i < 8; ++i) {
            const double r[3] = {i * 0.2 - x[0], j * 0.1 - x[1], k * 0.4 - x[2]};
            std::int64_t* node = impulses.at(i, j, k) + 4;
            node[axis] = as_bits(0.0);
            node[one] = as_bits(-r[other]);
            node[other] = as_bits(r[one]);
          }
      interpolate_impulses(basis, grid, p.x, p.shape, 0, 1, false, impulses, got);
      EXPECT_NEAR(got.turn[axis][0], got.inertia[axis][0], 1e-14);
    }
    // B-splines have one second moment wherever they are: h^2/4 and h^2/3.
    if (basis != Basis::quadratic && basis != Basis::cubic) continue;
    const double factor = basis == Basis::quadratic ? 0.25 : 1.0 / 3;
    EXPECT_NEAR(got.inertia[0][0], factor * (0.1 * 0.1 + 0.4 * 0.4), 1e-15);
    EXPECT_NEAR(got.inertia[1][0], factor * (0.2 * 0.2 + 0.4 * 0.4), 1e-15);
    EXPECT_NEAR(got.inertia[2][0], factor * (0.2 * 0.2 + 0.1 * 0.1), 1e-15);
  }
}

struct Case {
  const char* basis;
  int per_cell;
  double multiplier;
};
void PrintTo(const Case& c, std::ostream* out) {
  *out << c.basis << ' ' << c.per_cell << " a cell, " << c.multiplier;
}

// Cells of 1 m, c = 1 m/s, K = 2 G; points with velocities.
class Body {
 public:
  Body(const Case& c, int cells, double end) : case_(c), cells_(cells), end_(end) {}
  void add(double x, double y, double vx, double vy) {
    lines_ += fmt::format("{} {} 0.5 {} {} {} 0\n", x, y, volume(), vx, vy);
  }
  double volume() const { return 1.0 / (case_.per_cell * case_.per_cell); }
  std::unique_ptr<TextRun> run(const std::string& name,
                               const TextRun::Rewrites& further = {}) const {
    const auto file =
        std::filesystem::temp_directory_path() / fmt::format("sluice_{}_{}.txt", name, ::getpid());
    std::ofstream(file) << lines_;
    SolidDeck deck;
    deck.upper = deck.cells = fmt::format("[{},{},1]", cells_, cells_);
    deck.flags = fmt::format(
        "<interpolator>{}</interpolator>"
        "<DoExplicitHeatConduction>false</DoExplicitHeatConduction>",
        case_.basis);
    deck.objects = fmt::format(
        "<geom_object><file><name>{}</name><var>p.volume</var><var>p.velocity</var></file>"
        "<res>[{},{},1]</res><velocity>[0,0,0]</velocity><temperature>300</temperature>"
        "</geom_object>",
        file.string(), case_.per_cell, case_.per_cell);
    TextRun::Rewrites rewrites = {
        {"<density>1000<", "<density>1<"},
        {"<bulk_modulus>1e6<", "<bulk_modulus>0.6<"},
        {"<shear_modulus>5e5<", "<shear_modulus>0.3<"},
        {"<maxTime>1<", fmt::format("<maxTime>{}<", end_)},
        {"<timestep_multiplier>0.4<", fmt::format("<timestep_multiplier>{}<", case_.multiplier)},
        {"<outputInterval>0</outputInterval>",
         saves({"p.velocity", "p.x", "KineticEnergy", "StrainEnergy"})}};
    rewrites.insert(rewrites.end(), further.begin(), further.end());
    auto result = std::make_unique<TextRun>(deck, rewrites, name);
    std::filesystem::remove(file);
    return result;
  }

 private:
  Case case_;
  int cells_;
  double end_;
  std::string lines_;
};

// A disk of four cells radius, its rim at .15 c, for one turn.
struct SpinningDisk {
  static constexpr double rim = 0.15, radius = 4, omega = rim / radius;

  explicit SpinningDisk(const Case& c) : body(c, 24, 2 * std::numbers::pi / omega) {
    const int n = c.per_cell, reach = 5 * n;
    for (int j = -reach; j < reach; ++j)
      for (int i = -reach; i < reach; ++i) {
        const double x = (i + 0.5) / n, y = (j + 0.5) / n;
        if (x * x + y * y > radius * radius) continue;
        body.add(12.13 + x, 12.27 + y, -omega * y, omega * x);
        kinetic += 0.5 * body.volume() * omega * omega * (x * x + y * y);
        momentum += body.volume() * omega * (x * x + y * y);
      }
  }

  Body body;
  double kinetic = 0, momentum = 0;
};

// Points of the interpolator linear turn spin into strain: the run says so, and what to take.
TEST(SpinOfPoints, IsToldWithWhatToTake) {
  const auto run = SpinningDisk({"linear", 2, 0.5}).body.run("points");
  EXPECT_THAT(run->report().solids_text,
              testing::AllOf(testing::HasSubstr("has gained energy by numerical error"),
                             testing::HasSubstr("Use <interpolator> gimp or cpdi")));
}

class Midpoint : public testing::TestWithParam<Case> {};

// Right: the strain that the spin makes keeps .0065 of the kinetic energy.
TEST_P(Midpoint, DiskKeepsItsSpin) {
  const SpinningDisk disk(GetParam());
  const auto& [body, kinetic, momentum] = disk;
  const auto ran = body.run("disk");
  const TextRun& run = *ran;
  const auto kinetic_energy = run.history("KineticEnergy"), strain = run.history("StrainEnergy");
  double ratio = 0, left = 0, count = 0;
  for (std::size_t k = strain.size() / 2; k < strain.size(); ++k, ++count) {
    ratio += strain[k][1] / kinetic_energy[k][1];
    left += kinetic_energy[k][1] / kinetic;
  }
  RecordProperty("kinetic", std::to_string(left / count));
  RecordProperty("strain", std::to_string(ratio / count));
  EXPECT_NEAR(left / count, 0.99, 0.02);
  EXPECT_LE(ratio / count, 0.015);
  const auto x = run.particles("p.x"), v = run.particles("p.velocity");
  double middle[2] = {}, spin = 0;
  for (int d = 0; d < 2; ++d)
    for (const double place : x[d]) middle[d] += place / static_cast<double>(x[0].size());
  for (std::size_t p = 0; p < x[0].size(); ++p)
    spin += body.volume() * ((x[0][p] - middle[0]) * v[1][p] - (x[1][p] - middle[1]) * v[0][p]);
  EXPECT_NEAR(spin / momentum, 1, 0.01);
  const Json solids = Json::parse(run.report().solids_json).at("block");
  EXPECT_LE(solids.at("numerical_gain_of_scale").get<double>(), 0.005);
}

// A free block of ten cells that moves slantwise across cells: the lowest mode of its length, three
// periods.
TEST_P(Midpoint, BlockKeepsItsVibration) {
  Body body(GetParam(), 20, 60);
  const int n = 10 * GetParam().per_cell;
  constexpr double vx = 0.05, vy = 0.03, amplitude = 0.01;
  double start = 0, mass = 0;
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const double u = amplitude * std::cos(std::numbers::pi * (i + 0.5) / n);
      body.add(5.1 + (i + 0.5) / GetParam().per_cell, 5.37 + (j + 0.5) / GetParam().per_cell,
               vx + u, vy);
      start += 0.5 * body.volume() * u * u;
      mass += body.volume();
    }
  const auto ran = body.run("block");
  const TextRun& run = *ran;
  const auto kinetic = run.history("KineticEnergy"), strain = run.history("StrainEnergy");
  double left = 0, count = 0;
  for (std::size_t k = 2 * strain.size() / 3; k < strain.size(); ++k, ++count)
    left += (kinetic[k][1] + strain[k][1] - 0.5 * mass * (vx * vx + vy * vy)) / start;
  RecordProperty("left", std::to_string(left / count));
  EXPECT_GE(left / count, 0.93);
  EXPECT_LE(left / count, 1.02);
}

// A disk hits a ring whose wall is half a cell: what is elastic keeps its energy but for friction.
class ThinRing : public testing::TestWithParam<const char*> {};

TEST_P(ThinRing, KeepsMostOfItsEnergy) {
  const SolidRun run("disk_in_ring", {fmt::format("MPM/interpolator={}", GetParam())});
  double lost = 0;
  for (const auto& [name, value] : run.report().budget)
    if (name != "within particles") lost += value;
  constexpr double speed = 1000;  // m^2/s^2
  const double start = 0.5 * 8000 * std::numbers::pi * 0.1 * 0.1 * 0.025 * speed;
  EXPECT_LE(lost / start, 0.3);
  EXPECT_GE(lost / start, 0.05);
  EXPECT_THAT(run.report().solids_text, testing::Not(testing::HasSubstr("has gained")));
}

INSTANTIATE_TEST_SUITE_P(Of, ThinRing, testing::Values("gimp", "cpdi"));

INSTANTIATE_TEST_SUITE_P(Of, Midpoint,
                         testing::Values(Case{"gimp", 1, 0.8}, Case{"gimp", 2, 0.3},
                                         Case{"gimp", 2, 0.8}, Case{"gimp", 3, 0.8},
                                         Case{"3rdorderBS", 2, 0.8}, Case{"4thorderBS", 2, 0.8},
                                         Case{"cpdi", 1, 0.8}, Case{"cpdi", 2, 0.8},
                                         Case{"carried_corners", 1, 0.8},
                                         Case{"carried_corners", 2, 0.8}));

// A finer level in the way of a block: without a wave its velocity stays to round-off, and its
// vibration gains nothing.
TEST(MidpointOnLevels, BlocksCrossThem) {
  const TextRun::Rewrites finer = {
      {"</Level></Grid>",
       "</Level><Level><Box label='2'><lower>[10,8,0]</lower><upper>[20,18,1]</upper>"
       "<resolution>[20,20,1]</resolution></Box></Level></Grid>"}};
  for (const double amplitude : {0.0, 0.01}) {
    Body body({"gimp", 2, 0.8}, 24, 120);
    for (int j = 0; j < 20; ++j)
      for (int i = 0; i < 20; ++i)
        body.add(5.1 + (i + 0.5) / 2, 5.37 + (j + 0.5) / 2,
                 0.0625 + amplitude * std::cos(std::numbers::pi * (i + 0.5) / 20), 0.03125);
    const auto run = body.run("levels", finer);
    const Json solids = Json::parse(run->report().solids_json).at("block");
    EXPECT_LE(solids.at("numerical_gain_of_scale").get<double>(), 1e-3);
    if (amplitude > 0) continue;
    const auto v = run->particles("p.velocity");
    ASSERT_EQ(v[0].size(), 400u);
    for (std::size_t p = 0; p < v[0].size(); ++p) {
      ASSERT_NEAR(v[0][p], 0.0625, 1e-12);
      ASSERT_NEAR(v[1][p], 0.03125, 1e-12);
    }
  }
}

// Bodies that meet, roll, slip and bounce, at the largest step: contact works on velocities that it
// gave, so that nothing gains.
class MidpointInContact : public testing::TestWithParam<const char*> {};

TEST_P(MidpointInContact, GainsNothing) {
  const SolidRun run(
      GetParam(), {"MPM/interpolator=gimp", "MPM/transfer=midpoint", "Time/timestep_multiplier=1"});
  const Json solids = Json::parse(run.report().solids_json);
  for (const auto& [name, body] : solids.members())
    EXPECT_LE(body.at("numerical_gain_of_scale").get<double>(), 0.005) << name;
}

INSTANTIATE_TEST_SUITE_P(Of, MidpointInContact,
                         testing::Values("bouncing_bar", "three_disks", "disk_rolls", "disk_slips",
                                         "sliding_block", "rigid_piston"));

}  // namespace
}  // namespace sluice::mpm::midpoint_test
