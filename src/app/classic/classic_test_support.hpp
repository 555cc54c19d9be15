// Calling a tool of the public suite as its link does, and small archives for it.
#pragma once
#include <gtest/gtest.h>

#include <sstream>

#include "app/classic/classic_tools.hpp"
#include "framework/archive/raw_archive_test_support.hpp"
#include "framework/base/temporary_folder.hpp"

namespace sluice::classic_test {

namespace fs = std::filesystem;

struct Said {
  int status = -1;
  std::string output, error;
};

inline Said call_tool(const std::string& name, const std::vector<std::string>& words,
                      const std::function<int(const std::vector<std::string>&)>& sluice = {}) {
  Said said;
  ::testing::internal::CaptureStdout();
  ::testing::internal::CaptureStderr();
  said.status = run_classic_tool(*find_classic_tool("/usr/bin/" + name), {name, words, sluice});
  std::fflush(stdout);
  said.output = ::testing::internal::GetCapturedStdout();
  said.error = ::testing::internal::GetCapturedStderr();
  return said;
}

inline std::vector<std::string> lines_of(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

// Pressure i + 10 j, velocity (i, j, 0), faces i; `shift` is added to the pressure of one cell.
inline std::vector<raw_test::Variable> small_fields(double shift = 0) {
  const auto pressure = [shift](IntVec3 i, int) {
    return i.x + 10.0 * i.y + (i == IntVec3{2, 0, 0} ? shift : 0);
  };
  return {{"press_CC", "CCVariable<double>", 0, pressure},
          {"vel_CC", "CCVariable<Vector>", 0, [](IntVec3 i, int c) { return c == 2 ? 0 : i[c]; }},
          {"uvel_FC", "SFCXVariable<float>", 0, [](IntVec3 i, int) { return i.x; }}};
}

// Two particles in the first patch, one in the second; the numbers are 11, 12 and 21.
inline std::vector<raw_test::Variable> small_particles() {
  const auto count = [](const raw_test::Patch& p) { return 2 - p.id; };
  const auto place = [](const raw_test::Patch& p, int n, int c) {
    return c == 0 ? p.interior.lower.x + 0.25 + n : 0.5;
  };
  const auto stress = [](const raw_test::Patch& p, int n, int c) {
    return c == 0 ? 3.0 + p.id + n : c == 1 || c == 3 ? 0.5 : 0.0;
  };
  return {{"p.x", "ParticleVariable<Point>", 0, {}, count, place},
          {"p.particleID",
           "ParticleVariable<long64>",
           0,
           {},
           count,
           [](const raw_test::Patch& p, int n, int) { return 11.0 + 10 * p.id + n; }},
          {"p.volume",
           "ParticleVariable<double>",
           0,
           {},
           count,
           [](const raw_test::Patch& p, int, int) { return 1.0 + p.id; }},
          {"p.stress", "ParticleVariable<Matrix3>", 0, {}, count, stress}};
}

// Four by two cells in two patches, outputs of steps 1 and 3 at times 0.5 and 1.5.
inline std::string write_small(const fs::path& folder, std::vector<raw_test::Variable> variables,
                               int outputs = 2) {
  raw_test::Writer writer(folder);
  const std::vector<raw_test::Level> grid = {
      raw_test::make_level({{0, 0, 0}, {4, 2, 1}}, {2, 1, 1}, {1, 1, 1}, {1, 1, 1})};
  for (int n = 0; n < outputs; ++n) writer.add_step(1 + 2 * n, 0.5 + n, grid, variables);
  writer.write_index();
  return folder.string();
}

}  // namespace sluice::classic_test
