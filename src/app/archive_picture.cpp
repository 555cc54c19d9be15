// The exact solution is sampled here, into a temporary CSV file that Python draws as a line.
#include "app/archive_picture.hpp"

#include <fmt/format.h>

#include <fstream>
#include <optional>

#include "app/archive_error.hpp"
#include "app/python_tool.hpp"
#include "framework/archive/archive.hpp"
#include "framework/base/error.hpp"
#include "framework/base/temporary_folder.hpp"

namespace sluice {
namespace {

namespace fs = std::filesystem;

constexpr int kExactPoints = 4000;  // finer than the pixels of a picture

// The direction of a 1-D run.
std::optional<int> line_direction(const Level& level) {
  std::optional<int> found;
  for (int d = 0; d < 3; ++d) {
    if (level.domain.size()[d] <= 1) continue;
    if (found) return std::nullopt;
    found = d;
  }
  return found;
}

void write_line(const DeckReference& reference, const Level& level, int direction, double time,
                const std::string& path) {
  std::ofstream file(path);
  file << "x,rho_CC,press_CC,vel_CC,temp_CC\n";
  const int cells = level.domain.size()[direction];
  for (int n = 0; n < kExactPoints; ++n) {
    Vec3 x = level.centre(level.domain.lower);
    const double along = (n + 0.5) / kExactPoints * cells;
    x[direction] = level.anchor[direction] +
                   (level.domain.lower[direction] + along) * level.spacing[direction];
    const exact::State s = reference.solution->at(x, time);
    file << fmt::format("{:.17g},{:.17g},{:.17g},{:.17g},{:.17g}\n", x[direction], s.density,
                        s.pressure, s.velocity[direction], s.temperature(reference.specific_heat));
  }
  if (!file.flush()) throw SystemError("cannot write " + path + ": is the disk full?");
}

// Writes the exact solution of a 1-D archive at the drawn time; false when the deck names none.
bool sample_exact(const PictureRequest& request, const std::string& path) {
  const Archive archive = Archive::open(request.archive);
  if (archive.outputs().empty()) return false;
  const auto reference = reference_of_archive(archive);
  if (!reference) return false;
  const StepEntry& output = archive.select_output(request.time);
  const ArchiveStep step = archive.read_output(output);
  const Level& level = step.grid().levels.front();
  const std::optional<int> direction = line_direction(level);
  if (!direction) return false;
  write_line(*reference, level, *direction, output.time, path);
  return true;
}

// With the exact solution from this CSV file, if any.
int draw_with(const PictureRequest& request, const std::string& exact, const fs::path& output) {
  std::vector<std::string> words = {"plot", request.archive};
  auto option = [&](const char* name, const std::string& value) {
    if (value.empty()) return;
    words.emplace_back(name);
    words.push_back(value);
  };
  for (const std::string& v : request.variables) option("--var", v);
  for (const std::string& h : request.histories) option("--history", h);
  option("--material", request.material);
  option("--slice", request.slice);
  option("--levels", request.levels);
  option("--title", request.title);
  option("--time", request.time);
  option("--exact", exact);
  option("--output", request.picture);
  return run_python_tool(words, output);
}

}  // namespace

int draw_archive(const PictureRequest& request, const fs::path& output) {
  if (request.exact != "auto" && request.exact != "none")
    return draw_with(request, request.exact, output);
  if (request.exact == "none" || !request.histories.empty()) return draw_with(request, "", output);
  const TemporaryFolder folder(TemporaryFolder::Place::disk);
  const std::string line = (folder / "exact.csv").string();
  return draw_with(request, sample_exact(request, line) ? line : "", output);
}

}  // namespace sluice
