// The last lines of a run.
#include "app/command/run_ending.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <cstring>
#include <sstream>

#include "app/command/archive_picture.hpp"
#include "app/loading/archive_error.hpp"
#include "app/process/study_process.hpp"
#include "framework/archive/archive.hpp"
#include "framework/base/console.hpp"
#include "framework/base/error.hpp"

namespace sluice {

namespace fs = std::filesystem;

std::string error_lines(const fs::path& folder) {
  const Archive archive = Archive::open(folder);
  if (archive.outputs().empty()) return {};
  const auto reference = reference_of_archive(archive);
  if (!reference) return {};
  const ArchiveStep step = archive.read_output(archive.select_output("last"));
  std::string text;
  if (reference->solution->has_places()) {
    const exact::ErrorNorms e = place_error(step, *reference, 0);
    text = fmt::format("  {:10} mean {:.3e}, largest {:.3e}\n", "p.x", e.l1, e.linf);
  }
  for (const char* variable : {"rho_CC", "press_CC", "temp_CC", "vel_CC"}) {
    const FieldInfo* field = step.find(variable, 0, 0);
    if (field == nullptr || reference->solution->has_places()) continue;
    if (reference->solution->materials() > 1 && variable == std::string("temp_CC")) continue;
    for (int c = 0; c < field->components(); ++c) {
      const Level& level = step.grid().levels.front();
      if (field->components() > 1 && !level.active[c]) continue;
      const exact::ErrorNorms e = archive_error(step, *reference, variable, c, 0);
      const std::string name =
          field->components() == 1 ? variable : fmt::format("{}.{}", variable, "xyz"[c]);
      const std::string share =
          e.relative_l1 > 0 ? fmt::format(" ({} of the mean)", human_percent(e.relative_l1)) : "";
      text += fmt::format("  {:10} L1 {:.3e}{}, largest {:.3e}\n", name, e.l1, share, e.linf);
    }
  }
  if (text.empty()) return {};
  return fmt::format("error against the exact solution at t = {:g}:\n", step.info().time) + text;
}

fs::path draw_picture(const fs::path& archive) {
  const fs::path log = archive / "plot.log";
  PictureRequest request;
  const fs::path picture = archive / "picture.png";
  request.archives = {archive.string()};
  request.options.set("--output", {picture.string()});
  if (draw_archives(request, PictureCommand::plot, log) != 0)
    throw SystemError(fmt::format("the picture could not be drawn:\n{}", last_lines(log, 10)));
  fs::remove(log);
  return picture;
}

bool ended_early(RunStatus status) {
  return status == RunStatus::terminated || status == RunStatus::wall_limit;
}

int exit_status_of(RunStatus status) {
  constexpr int early = 4;
  if (ended_early(status)) return early;
  return static_cast<int>(status == RunStatus::failed ? ExitStatus::failed : ExitStatus::good);
}

namespace {

// As one word of a shell.
std::string quoted(const fs::path& path) {
  std::string text = fs::absolute(path).lexically_normal().string();
  if (text.size() > 1 && text.back() == '/') text.pop_back();
  const auto is_plain = [](unsigned char c) {
    return std::isalnum(c) != 0 || std::strchr("/._-+=:,@%", c) != nullptr;
  };
  if (std::all_of(text.begin(), text.end(), is_plain)) return text;
  std::string word = "'";
  for (const char c : text) word += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return word + "'";
}

}  // namespace

std::string program_word() {
  std::error_code failed;
  const fs::path own = own_executable();
  const char* searched = std::getenv("PATH");
  std::istringstream folders(searched == nullptr ? "" : searched);
  for (std::string folder; std::getline(folders, folder, ':');) {
    const fs::path there = fs::path(folder.empty() ? "." : folder) / "sluice";
    if (::access(there.c_str(), X_OK) != 0) continue;
    // The first is the one that a shell takes.
    if (fs::path(folder).is_absolute() && fs::equivalent(there, own, failed)) return "sluice";
    break;
  }
  return quoted(own);
}

std::string command_to_continue(const ContinueWords& words) {
  std::string command = words.ranks > 1 ? fmt::format("mpirun -np {} ", words.ranks) : "";
  command += words.program + " run --restart " + quoted(words.archive);
  command += " -o " + quoted(words.parent);
  if (words.threads > 1) command += fmt::format(" --threads {}", words.threads);
  if (words.force_directions) command += " --force-directions";
  return command;
}

}  // namespace sluice
