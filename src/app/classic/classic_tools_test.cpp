// The tools of the public suite on small raw archives: what they print, and how they end.
#include <gmock/gmock.h>

#include <cmath>
#include <fstream>

#include "app/classic/classic_test_support.hpp"
#include "app/command/command_test_support.hpp"

namespace sluice::classic_tools_test {
namespace {

using namespace classic_test;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsSupersetOf;
using ::testing::StartsWith;

TEST(ClassicTools, EachHasALinkBesideTheCommand) {
  const fs::path bin = fs::path(SLUICE_COMMAND).parent_path();
  for (const ClassicTool& tool : classic_tools()) {
    ASSERT_TRUE(fs::is_symlink(bin / tool.name)) << tool.name;
    EXPECT_EQ(fs::canonical(bin / tool.name), fs::canonical(SLUICE_COMMAND));
    EXPECT_EQ(find_classic_tool((bin / tool.name).string()), &tool);
  }
  EXPECT_EQ(find_classic_tool(SLUICE_COMMAND), nullptr);
  const Outcome usage = run_in_shell((bin / "puda").string());
  EXPECT_EQ(usage.status, 1);
  EXPECT_THAT(usage.text, StartsWith("Usage: puda"));
}

TEST(ClassicTools, FaultyLinesEndWithOneAndSayWhy) {
  const TemporaryFolder folder;
  const std::string a = write_small(folder / "a.uda.000", small_fields());
  for (const auto& [name, words, message] :
       {std::tuple{"puda", std::vector<std::string>{"-timestpes", a}, "-timesteps"},
        {"puda", {"-timesteps"}, "no archive"},
        {"puda", {"-timesteps", a, "b"}, "'b' is a second"},
        {"puda", {"-gridstats", "-timesteplow", "2", a}, "between 0 and 1"},
        {"puda", {"-partvar", "p.x", a}, "press_CC"},
        {"lineextract", {"-v", "rho_CC", "-uda", a}, "press_CC"},
        {"lineextract", {"-v", "press_CC", "-uda", a, "-m", "x"}, "'x' is not an integer"},
        {"lineextract", {"-v", "press_CC", "-uda"}, "-uda takes <archive>"},
        {"lineextract",
         {"-v", "press_CC", "-uda", a, "-istart", "9", "0", "0", "-iend", "9", "0", "0"},
         "Could not find any patches on Level 0"},
        {"timeextract", {"-v", "press_CC", "-uda", a, "-i", "9", "0", "0"}, "has no value"},
        {"compare_uda", {a}, "two archive directories"},
        {"compare_uda", {a, (folder / "none").string()}, "cannot open archive"},
        {"restart_merger", {a, a}, "no \"restart\" tag"}}) {
    const Said said = call_tool(name, words);
    EXPECT_EQ(said.status, 1) << name;
    EXPECT_THAT(said.error, HasSubstr(message)) << name;
  }
}

TEST(ClassicTools, PudaListsAndPrintsParticles) {
  const TemporaryFolder folder;
  const std::string a = write_small(folder / "a.uda.000", small_particles());
  EXPECT_THAT(lines_of(call_tool("puda", {"-timesteps", a}).output),
              ElementsAre("There are 2 timesteps:", "1: 5.0000000000000000e-01",
                          "3: 1.5000000000000000e+00"));
  EXPECT_THAT(
      lines_of(call_tool("puda", {"-listVariables", a}).output),
      ElementsAre("There are 4 variables:", "p.x: ParticleVariable<Point>",
                  "p.particleID: ParticleVariable<long64>", "p.volume: ParticleVariable<double>",
                  "p.stress: ParticleVariable<Matrix3>"));
  EXPECT_THAT(
      lines_of(call_tool("puda", {"-partvar", "p.volume", "-timesteplow", "1", a}).output),
      ElementsAre("1.50000000e+00 1 0 11 1.00000000e+00", "1.50000000e+00 1 0 12 1.00000000e+00",
                  "1.50000000e+00 2 0 21 2.00000000e+00"));
}

TEST(ClassicTools, PudaSummarisesByPatch) {
  const TemporaryFolder folder;
  const std::string a = write_small(folder / "a.uda.000", small_fields(), 1);
  const Said all = call_tool("puda", {"-varsummary", a});
  // The extra cells of the first patch begin at -1; its largest is in the row above.
  EXPECT_THAT(all.output,
              HasSubstr("\t\t\t\tCCVariable<double> over [int -1, -1, -1] (inclusive) to "
                        "[int 2, 3, 2] (exclusive)\n"
                        "\t\t\t\tmin value: -1.1000000000000000e+01\n"
                        "\t\t\t\tmax value: 2.1000000000000000e+01\n"
                        "\t\t\t\tmin location: [int -1, -1, -1] (Occurrences: ~3)\n"));
  const Said inner = call_tool("puda", {"-varsummary", "-brief", "-no_extra_cells", a});
  EXPECT_THAT(inner.output, HasSubstr("press_CC (matl: 0): \n   Level 0: Min/Max: "
                                      "0.0000000000000000e+00, 1.3000000000000000e+01\n"));
}

TEST(ClassicTools, LinesAndHistoriesOfCells) {
  const TemporaryFolder folder;
  const std::string a = write_small(folder / "a.uda.000", small_fields());
  const Said line =
      call_tool("lineextract", {"-v", "press_CC", "-timestep", "1", "-istart", "1", "1", "0",
                                "-iend", "2", "1", "0", "-pr", "3", "-uda", a});
  EXPECT_EQ(line.status, 0);
  EXPECT_EQ(line.output,
            "press_CC: CCVariable<double> being extracted for material 0, Level: 0, at index [int "
            "1, 1, 0] to [int 2, 1, 0]\nThere are 2 timesteps\n1 1 0 1.100e+01\n2 1 0 "
            "1.200e+01\n\n");
  EXPECT_EQ(line.error, "%outputting for times[1] = 1.5\n");
  // Faces lie half a cell below the centres; cells beyond the level are padded, or left out.
  EXPECT_THAT(
      lines_of(
          call_tool("lineextract", {"-v", "uvel_FC", "-q", "-tlow", "1", "-iend", "5", "0", "0",
                                    "-istart", "3", "0", "0", "-cellCoords", "-pr", "1", "-uda", a})
              .output),
      ElementsAre("3.0e+00 5.0e-01 5.0e-01 3.0e+00", "4.0e+00 5.0e-01 5.0e-01 4.0e+00", ""));
  EXPECT_THAT(lines_of(call_tool("lineextract",
                                 {"-v", "press_CC", "-q", "-tlow", "1", "-iend", "4", "0", "0",
                                  "-istart", "3", "0", "0", "-pad", "-ni", "-pr", "1", "-uda", a})
                           .output),
              ElementsAre("3.0e+00", "0.0e+00", ""));
  const Said history =
      call_tool("timeextract", {"-v", "vel_CC", "-p", "2.5", "1.5", "0.5", "-pr", "2", "-uda", a});
  EXPECT_EQ(history.output,
            "vel_CC: CCVariable<Vector> being extracted for material 0 at index [int 2, 1, 0]\n"
            "There are 2 timesteps:\noutputting for times[0] = 0.5 to times[1] = 1.5\n"
            "5.00e-01   2.00e+00 1.00e+00 0.00e+00 \n1.50e+00   2.00e+00 1.00e+00 0.00e+00 \n");
}

TEST(ClassicTools, ParticlesByNumberPlaceAndRange) {
  const TemporaryFolder folder;
  const std::string a = write_small(folder / "a.uda.000", small_particles());
  EXPECT_THAT(lines_of(call_tool("partextract",
                                 {"-partvar", "p.volume", "-partvar", "p.x", "-partid", "12", a})
                           .output),
              ElementsAre("% Time patchIndex material particleID p.volume p.x",
                          "5.00000000e-01 1 0 12 1.00000000e+00 1.25000000e+00 5.00000000e-01 "
                          "5.00000000e-01 ",
                          "1.50000000e+00 1 0 12 1.00000000e+00 1.25000000e+00 5.00000000e-01 "
                          "5.00000000e-01 "));
  // s11 = 4 of particle 12, with a shear of 1/2: s11 s22 s33 s23 s13 s12.
  EXPECT_THAT(lines_of(call_tool("partextract",
                                 {"-part_stress", "all", "-partid", "12", "-timestep", "0", a})
                           .output),
              ElementsAre("5.000000e-01 12 1 0 4.000000e+00 0.000000e+00 0.000000e+00 0.000000e+00 "
                          "0.000000e+00 5.000000e-01"));
  // Equivalent: (s11^2 + 3 s12^2)^(1/2); the mean by volume of s11: (3 + 4 + 2 * 4) / 4.
  EXPECT_THAT(lines_of(call_tool("partextract",
                                 {"-part_stress", "equiv", "-partid", "12", "-timestep", "0", a})
                           .output),
              ElementsAre("5.000000e-01 12 1 0 4.092676e+00"));
  EXPECT_THAT(call_tool("partextract", {"-part_stress", "avg", "-timestep", "0", a}).output,
              HasSubstr("3.75000000e+00  5.00000000e-01  0.00000000e+00  \n"));
  EXPECT_THAT(lines_of(call_tool("selectpart",
                                 {"-box", "1", "0", "0", "4", "1", "1", "-timesteplow", "1", a})
                           .output),
              ElementsAre("1.50000000e+00 1 0 12 1.25000000e+00 5.00000000e-01 5.00000000e-01",
                          "1.50000000e+00 2 0 21 2.25000000e+00 5.00000000e-01 5.00000000e-01"));
  EXPECT_THAT(lines_of(call_tool("partvarRange", {a}).output),
              ElementsAre("p.volume min = 1.00000000e+00 max = 2.00000000e+00",
                          // (9 + 2/4)^(1/2), (16 + 2/4)^(1/2)
                          "p.stress min = 3.08220700e+00 max = 4.06201920e+00"));
}

TEST(ClassicTools, ComparisonsEndAsTheSuiteSays) {
  const TemporaryFolder folder;
  const std::string a = write_small(folder / "a.uda.000", small_fields());
  const std::string b = write_small(folder / "b.uda.000", small_fields(1e-3));
  const std::string c = write_small(folder / "c.uda.000", small_fields(), 1);
  const std::string d = write_small(folder / "d.uda.000", small_particles());
  EXPECT_EQ(call_tool("compare_uda", {a, a}).status, 0);
  const Said different = call_tool("compare_uda", {a, b});
  EXPECT_EQ(different.status, 2);
  EXPECT_THAT(different.error, HasSubstr("DIFFERENCE [int 2, 0, 0]  Time: 0.5 Level: 0 Patch1: 1 "
                                         "Patch2: 1 Material: 0 Variable: press_CC\n"));
  EXPECT_THAT(different.error, HasSubstr("\n2\t\t2.00099999999999989\n"));
  EXPECT_EQ(call_tool("compare_uda", {"-abs_tolerance", "2e-3", a, b}).status, 0);
  EXPECT_EQ(call_tool("compare_uda", {"-relTolerance", "1e-3", a, b}).status, 0);
  EXPECT_EQ(call_tool("compare_uda", {"-ignoreVariables", "press_CC", a, b}).status, 0);
  const Said warned = call_tool("compare_uda", {"-as_warnings", "-concise", a, b});
  EXPECT_EQ(warned.status, 2);
  EXPECT_THAT(warned.output, HasSubstr("time = 1.5\n"));
  EXPECT_EQ(call_tool("compare_uda", {a, c}).status, 5);  // numbers of outputs
  EXPECT_EQ(call_tool("compare_uda", {a, d}).status, 5);  // variables
  EXPECT_EQ(call_tool("compare_uda", {b, c}).status, 2);  // a difference was seen before
  EXPECT_EQ(call_tool("compare_uda", {d, d}).status, 0);
}

class InFolder {
 public:
  explicit InFolder(const fs::path& folder) : before_(fs::current_path()) {
    fs::current_path(folder);
  }
  ~InFolder() { fs::current_path(before_); }

 private:
  fs::path before_;
};

TEST(ClassicTools, NormsAreWrittenByLevelAndVariable) {
  const TemporaryFolder folder;
  const std::string a = write_small(folder / "a.uda.000", small_fields());
  const std::string b = write_small(folder / "b.uda.000", small_fields(0.5));
  const InFolder here(folder.path());
  const Said said = call_tool("compute_Lnorm_udas", {"-compareVariables", "press_CC", a, b});
  EXPECT_EQ(said.status, 0) << said.error;
  // One cell of eight differs by 1/2.
  EXPECT_THAT(said.output, HasSubstr(" \t norms: L1 0.0625 L2: 0.176777 Linf: 0.5 n_cells: 8\n"));
  EXPECT_THAT(lines_of(text_of(folder / "Lnorm/L-0/press_CC_0")),
              ElementsAre("#Time \t\t\t L1 \t\t L2 \t\t Linf",
                          "5.0000000000e-01 6.2500000000e-02 1.7677669530e-01 5.0000000000e-01",
                          "1.5000000000e+00 6.2500000000e-02 1.7677669530e-01 5.0000000000e-01"));
  const std::string later = write_small(folder / "later.uda.000", small_fields(), 1);
  raw_test::Writer writer(folder / "later.uda.000");
  EXPECT_EQ(call_tool("compute_Lnorm_udas", {"-timeTolerance", "1e-3", a, later}).status, 0);
}

TEST(ClassicTools, PudaWritesParticlesOfCells) {
  const TemporaryFolder folder;
  const std::string a = write_small(folder / "a.uda.000", small_particles(), 1);
  const InFolder here(folder.path());
  EXPECT_EQ(call_tool("puda", {"-pic", "1", "0", "0", a}).status, 0);
  EXPECT_EQ(text_of("partIds.index.1.0.0.time.0000"), "12\n");
  EXPECT_EQ(call_tool("puda", {"-partvar", "p.volume", "-pol", "x", "0", "0", a}).status, 0);
  EXPECT_EQ(text_of("particleAverage.axis.x.at.0.0.time.0000"),
            "0\t0\t0\t1\n1\t0\t0\t1\n2\t0\t0\t2\n3\t0\t0\t0\n");
  EXPECT_EQ(
      call_tool("puda", {"-partvar", "p.stress", "-pol", "x", "0", "0", "false", "true", a}).status,
      0);
  // Of s11 = 3 with a shear of 1/2: pressure -1, (9 + 3/4)^(1/2).
  EXPECT_THAT(text_of("particleSingle.axis.x.at.0.0.time.0000"),
              StartsWith("0\t0\t0\t-1\t3.1225\n"));
  EXPECT_EQ(call_tool("puda", {"-partvar", "p.volume", "-pol", "w", "0", "0", a}).status, 1);
}

// On the circle of radius 1 the generalised vortex turns by sin(pi t): at time 1/2 by one radian.
TEST(ClassicTools, PudaTellsErrorsOfMotions) {
  const TemporaryFolder folder;
  const auto count = [](const raw_test::Patch& p) { return p.id == 0 ? 2 : 0; };
  const Vec3 turned{std::cos(1.0), std::sin(1.0), 0.5};
  const auto off = [](int n, int c) { return n == 1 && c == 2 ? 0.01 : 0.0; };
  const std::string a =
      write_small(folder / "a.uda.000",
                  {{"p.x",
                    "ParticleVariable<Point>",
                    0,
                    {},
                    count,
                    [=](const raw_test::Patch&, int n, int c) { return turned[c] + off(n, c); }},
                   {"p.displacement",
                    "ParticleVariable<Vector>",
                    0,
                    {},
                    count,
                    [=](const raw_test::Patch&, int n, int c) {
                      return turned[c] - Vec3{1, 0, 0.5}[c] + off(n, c);
                    }}},
                  1);
  const InFolder here(folder.path());
  const Said said = call_tool("puda", {"-GV_MMS", a});
  EXPECT_EQ(said.status, 0) << said.error;
  EXPECT_THAT(said.output, HasSubstr("L_inf Error: 1.00000000e-02, L2norm: 7.07106781e-03 "
                                     "numParticles: 2 , Worst particle: [5.40302306e-01 "));
  EXPECT_THAT(lines_of(text_of("L_norms"))[1], StartsWith("5.0000000000000000e-01, 1.00000"));
  EXPECT_EQ(call_tool("puda", {"-AA_MMS_1", a}).status, 1);  // a bar has one direction
}

TEST(ClassicTools, RestartsAreJoined) {
  const TemporaryFolder folder;
  const auto grid =
      std::vector{raw_test::make_level({{0, 0, 0}, {4, 2, 1}}, {2, 1, 1}, {1, 1, 1}, {1, 1, 1})};
  const std::string globals =
      "<globals><variable href=\"M.dat\" type=\"ReductionVariable&lt;double&gt;\" "
      "name=\"M\"/></globals>";
  raw_test::Writer first(folder / "a.uda.000"), second(folder / "a.uda.001");
  for (int step : {1, 2, 3, 4}) first.add_step(step, 0.5 * step, grid, small_fields());
  for (int step : {4, 5}) second.add_step(step, 0.5 * step, grid, small_fields(step));
  first.tail = globals;
  second.tail = globals + "<restarts><restart from=\"a.uda.000\" timestep=\"3\"/></restarts>";
  first.write_index();
  second.write_index();
  std::ofstream(first.folder() / "M.dat") << "0.5\t1\n1\t2\n1.5\t3\n2\t4\n";
  std::ofstream(second.folder() / "M.dat") << "2\t40\n2.5\t50\n";
  const InFolder here(folder.path());
  const Said said = call_tool("restart_merger", {"a.uda.000", "a.uda.001"});
  EXPECT_EQ(said.status, 0) << said.error;
  EXPECT_EQ(said.output, "Successfully created a.uda.002\n");
  EXPECT_THAT(lines_of(call_tool("puda", {"-timesteps", "a.uda.002"}).output),
              ElementsAre("There are 5 timesteps:", "1: 5.0000000000000000e-01",
                          "2: 1.0000000000000000e+00", "3: 1.5000000000000000e+00",
                          "4: 2.0000000000000000e+00", "5: 2.5000000000000000e+00"));
  EXPECT_EQ(text_of("a.uda.002/M.dat"), "0.5\t1\n1\t2\n1.5\t3\n2\t40\n2.5\t50\n");
  EXPECT_EQ(call_tool("validateUda", {"a.uda.002"}).status, 0);
  fs::resize_file("a.uda.002/t00002/l0/p00000.data", 100);
  const Said damaged = call_tool("validateUda", {"a.uda.002"});
  EXPECT_EQ(damaged.status, 1);
  EXPECT_THAT(damaged.output, HasSubstr("timestep t00002: "));
  EXPECT_THAT(damaged.output, HasSubstr("p00000.data"));
}

}  // namespace
}  // namespace sluice::classic_tools_test
