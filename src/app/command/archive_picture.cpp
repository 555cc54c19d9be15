// The exact solution is sampled here, into a temporary CSV file that Python draws as a line.
#include "app/command/archive_picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <optional>

#include "app/loading/archive_error.hpp"
#include "app/process/python_tool.hpp"
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

// On the line between two points that differ in one direction.
void write_points(const DeckReference& reference, Vec3 low, Vec3 high, int direction, double time,
                  const std::string& path) {
  std::ofstream file(path);
  file << "x,rho_CC,press_CC,vel_CC,temp_CC\n";
  for (int n = 0; n < kExactPoints; ++n) {
    Vec3 x = low;
    x[direction] += (n + 0.5) / kExactPoints * (high[direction] - low[direction]);
    const exact::State s = reference.solution->at(x, time);
    file << fmt::format("{:.17g},{:.17g},{:.17g},{:.17g},{:.17g}\n", x[direction], s.density,
                        s.pressure, s.velocity[direction], s.temperature(reference.specific_heat));
  }
  if (!file.flush()) throw SystemError("cannot write " + path + ": is the disk full?");
}

void write_line(const DeckReference& reference, const Level& level, int direction, double time,
                const std::string& path) {
  Vec3 low = level.centre(level.domain.lower);
  low[direction] =
      level.anchor[direction] + level.domain.lower[direction] * level.spacing[direction];
  Vec3 high = low;
  high[direction] += level.domain.size()[direction] * level.spacing[direction];
  write_points(reference, low, high, direction, time, path);
}

// From the origin to the farthest corner of the domain, along the first dimension of the run.
void write_radius(const DeckReference& reference, const Level& level, double time,
                  const std::string& path) {
  int direction = -1;
  double square = 0;
  for (int d = 2; d >= 0; --d) {
    if (level.domain.size()[d] <= 1) continue;
    direction = d;
    const double low = level.anchor[d] + level.domain.lower[d] * level.spacing[d];
    const double high = level.anchor[d] + level.domain.upper[d] * level.spacing[d];
    square += std::max(low * low, high * high);
  }
  if (direction < 0) throw InputError("--radius: the run has one cell");
  Vec3 low{}, high{};
  high[direction] = std::sqrt(square);
  write_points(reference, low, high, direction, time, path);
}

// The output that a picture shows; of several the last that is named.
std::string time_of(const PictureRequest& request) {
  const std::vector<std::string> times = request.options.values("--time");
  return times.empty() ? "last" : times.back();
}

// Writes the exact solution of a 1-D archive at the drawn time, or that along a radius; false when
// the deck names none.
bool sample_exact(const PictureRequest& request, const std::string& path) {
  const Archive archive = Archive::open(request.archives.front());
  if (archive.outputs().empty()) return false;
  const auto reference = reference_of_archive(archive);
  if (!reference || reference->solution->has_places()) return false;
  const StepEntry& output = archive.select_output(time_of(request));
  const ArchiveStep step = archive.read_output(output);
  const Level& level = step.grid().levels.front();
  if (request.options.has("--radius")) {
    write_radius(*reference, level, output.time, path);
    return true;
  }
  const std::optional<int> direction = line_direction(level);
  if (!direction) return false;
  write_line(*reference, level, *direction, output.time, path);
  return true;
}

// One exact solution belongs to one time of one kind of picture.
bool wants_exact_of_deck(const PictureRequest& request, PictureCommand which) {
  const PictureOptions& options = request.options;
  if (which != PictureCommand::plot || options.values("--time").size() > 1) return false;
  // Checkpoints hold the state of the run, which no exact solution has.
  for (const char* other : {"--history", "--line", "--difference", "--checkpoint"})
    if (options.has(other)) return false;
  return true;
}

// With the exact solution from this CSV file, if any.
int draw_with(const PictureRequest& request, PictureCommand which, const std::string& exact,
              const fs::path& output) {
  std::vector<std::string> words = {which == PictureCommand::plot ? "plot" : "movie"};
  words.insert(words.end(), request.archives.begin(), request.archives.end());
  const std::vector<std::string> options = request.options.words({"--exact"});
  words.insert(words.end(), options.begin(), options.end());
  if (!exact.empty()) words.push_back("--exact=" + exact);
  return run_python_tool(words, output);
}

}  // namespace

int draw_archives(const PictureRequest& request, PictureCommand which, const fs::path& output) {
  const std::vector<std::string> exact = request.options.values("--exact");
  const std::string asked = exact.empty() ? "auto" : exact.front();
  if (asked != "auto" && asked != "none") return draw_with(request, which, asked, output);
  if (asked == "none" || !wants_exact_of_deck(request, which))
    return draw_with(request, which, "", output);
  const TemporaryFolder folder(TemporaryFolder::Place::disk);
  const std::string line = (folder / "exact.csv").string();
  return draw_with(request, which, sample_exact(request, line) ? line : "", output);
}

}  // namespace sluice
