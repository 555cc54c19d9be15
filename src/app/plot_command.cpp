// sluice plot UDA: pictures by the Python package sluice_tools, with the exact solution if the
// deck names one.
//
// The package lies beside the executable (build tree and installation have the same layout); it is
// run by Debian's own /usr/bin/python3, to which Debian's h5py and matplotlib belong. The exact
// solution is sampled here, into a temporary CSV file that Python draws as a line.
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <CLI/CLI.hpp>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>

#include "app/archive_error.hpp"
#include "app/commands.hpp"
#include "app/data_folder.hpp"
#include "app/study_process.hpp"
#include "framework/archive/archive.hpp"
#include "framework/base/error.hpp"

namespace sluice {
namespace {

namespace fs = std::filesystem;

constexpr const char* kPython = "/usr/bin/python3";
constexpr int kExactPoints = 4000;  // finer than the pixels of a picture

struct PlotRequest {
  std::string archive;
  std::vector<std::string> variables, histories;
  std::string material, slice, title;
  std::string time = "last";
  std::string exact = "auto";
  std::string picture = "picture.png";
};

// A file that goes away with this object.
class TemporaryFile {
 public:
  TemporaryFile() : path_((fs::temp_directory_path() / "sluice_exact_XXXXXX").string()) {
    const int descriptor = ::mkstemp(path_.data());
    if (descriptor < 0)
      throw SystemError(
          fmt::format("cannot create a temporary file {}: {}; set TMPDIR to a folder "
                      "that can be written",
                      path_, std::strerror(errno)));
    ::close(descriptor);
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  ~TemporaryFile() { ::unlink(path_.c_str()); }
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

// The folder that holds the package sluice_tools.
fs::path tools_folder() {
  fs::path tools = data_folder() / "tools";
  if (!fs::exists(tools / "sluice_tools" / "__main__.py"))
    throw SystemError(
        fmt::format("the Python tools are not beside this executable: looked for {}; "
                    "install with cmake --install, or run the one in the build tree",
                    (tools / "sluice_tools").string()));
  return tools;
}

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
bool sample_exact(const PlotRequest& request, const std::string& path) {
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

int run_python(const PlotRequest& request, const std::string& exact) {
  if (::access(kPython, X_OK) != 0)
    throw SystemError(
        fmt::format("pictures need {}; on Debian: apt-get install python3 "
                    "python3-numpy python3-h5py python3-matplotlib",
                    kPython));
  ProcessRequest python;
  python.words = {kPython, "-B", "-m", "sluice_tools", "plot", request.archive};
  auto option = [&](const char* name, const std::string& value) {
    if (value.empty()) return;
    python.words.emplace_back(name);
    python.words.push_back(value);
  };
  for (const std::string& v : request.variables) option("--var", v);
  for (const std::string& h : request.histories) option("--history", h);
  option("--material", request.material);
  option("--slice", request.slice);
  option("--title", request.title);
  option("--time", request.time);
  option("--exact", exact);
  option("--output", request.picture);
  python.environment = {"PYTHONPATH=" + tools_folder().string()};
  return run_process(python);
}

int plot(const PlotRequest& request) {
  if (request.exact != "auto" && request.exact != "none") return run_python(request, request.exact);
  if (request.exact == "none" || !request.histories.empty()) return run_python(request, "");
  const TemporaryFile line;
  return run_python(request, sample_exact(request, line.path()) ? line.path() : "");
}

}  // namespace

void add_plot_command(CLI::App& app, int& exit_status) {
  CLI::App* command = app.add_subcommand("plot", "Draw an archive: profiles, slices, histories");
  auto request = std::make_shared<PlotRequest>();
  command->add_option("UDA", request->archive, "Archive (folder or link)")->required();
  // CLI11 hands lists of one option over together; each --var takes one name.
  command->add_option("--var", request->variables, "Label, or a component of it: vel_CC.x")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  command->add_option("--history", request->histories, "A .dat file by its label")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  command->add_option("--material", request->material, "Material index (the first stored)");
  command->add_option("--time", request->time, "last, first, #N (N-th output) or a time");
  command->add_option("--slice", request->slice, "Plane of a 3-D run, z=0.5 (the middle)");
  command->add_option("--exact", request->exact,
                      "auto: the solution that the deck names; none; or a CSV file x,LABEL,...");
  command->add_option("--title", request->title, "Heading of the picture");
  command->add_option("-o,--output", request->picture, "Picture: .png, .svg or .pdf");
  command->callback([request, &exit_status] { exit_status = plot(*request); });
}

}  // namespace sluice
