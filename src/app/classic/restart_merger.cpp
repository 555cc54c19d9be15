// restart_merger: one archive of the outputs of a run and of its restarts, in either format.
//
// Outputs of an archive count up to the step at which the next one went on. Checkpoints, decks and
// the catalogue of variables are those of the last; lines of histories are put together.
#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "app/classic/classic_arguments.hpp"
#include "app/classic/classic_tools.hpp"
#include "framework/archive/archive.hpp"
#include "framework/archive/posix_file.hpp"

namespace sluice {
namespace {

namespace fs = std::filesystem;

ClassicSpec merger_spec() {
  return {"restart_merger",
          "[options] <archive 1> <archive 2> [<archive 3> ...]",
          {{"-h -help", "", "this text"},
           {"-copy", "", "leave the archives as they are (default)"},
           {"-move", "", "move their outputs, and remove the archives"}}};
}

// The name of the first archive without its number, with the smallest free number here.
fs::path free_name(const fs::path& first) {
  fs::path base = fs::canonical(first).filename();
  const std::string number = base.extension().string();
  if (number.size() > 1 && number.find_first_not_of("0123456789", 1) == number.npos)
    base = base.stem();
  for (int n = 0; n < 100000; ++n) {
    fs::path name = base.string() + fmt::format(".{:03}", n);
    if (!fs::exists(name)) return name;
  }
  throw SystemError(base.string() + ".NNN: all numbers up to 99999 are taken");
}

void copy_tree(const fs::path& from, const fs::path& to, bool move) {
  std::error_code error;
  if (move) {
    fs::rename(from, to, error);
    if (!error) return;
    error.clear();  // another file system
  }
  fs::copy(from, to, fs::copy_options::recursive, error);
  if (error) fail_system("copy " + from.string() + " to", to, error.value());
}

// The steps that count: after that at which the archive itself began, up to that of the next.
std::vector<StepEntry> steps_between(const Archive& archive, int after, int last) {
  std::vector<StepEntry> steps;
  for (const StepEntry& s : archive.outputs())
    if (s.step > after && (last < 0 || s.step <= last)) steps.push_back(s);
  return steps;
}

int restart_step(const Archive& archive) {
  if (archive.index().restarts.empty())
    throw InputError(archive.folder().string() +
                     " is not a restarted uda -- no \"restart\" tag found.");
  return archive.index().restarts.back().step;
}

// Lines of the earlier archives up to the first of the next one.
void merge_histories(const std::vector<Archive>& archives, const fs::path& target) {
  for (const HistoryEntry& h : archives.back().index().histories) {
    std::string text;
    for (const Archive& archive : archives) {
      const fs::path file = archive.folder() / h.file;
      if (!fs::exists(file)) continue;
      const std::string next = read_text(file);
      const double begin = std::strtod(next.c_str(), nullptr);
      std::istringstream lines(text);
      std::string kept;
      for (std::string line; std::getline(lines, line);)
        if (std::strtod(line.c_str(), nullptr) < begin) kept += line + '\n';
      text = kept + next;
    }
    write_text(target / h.file, text);
  }
}

XmlElement read_index_xml(const Archive& archive) {
  const fs::path path = archive.folder() / "index.xml";
  if (archive.format() == ArchiveFormat::hdf5) return read_sealed(path);
  return parse_xml(read_text(path), path.string());
}

void write_index(const std::vector<Archive>& archives, const std::vector<StepEntry>& steps,
                 const fs::path& target) {
  XmlElement root = read_index_xml(archives.back());
  std::erase_if(root.children, [](const XmlElement& e) {
    return e.name == "timesteps" || e.name == "restarts" || e.name == "restart";
  });
  XmlElement& restarts = root.add("restarts");
  for (const RestartEntry& r : archives.front().index().restarts)
    restarts.add("restart").set("from", r.from).set("timestep", std::to_string(r.step));
  XmlElement& list = root.add("timesteps");
  for (const StepEntry& s : steps)
    list.add("timestep", std::to_string(s.step))
        .set("href", s.href.string())
        .set("time", real_text(s.time))
        .set("oldDelt", real_text(s.old_delt));
  if (archives.back().format() == ArchiveFormat::hdf5)
    publish_sealed(target / "index.xml", root);
  else
    write_text_atomically(target / "index.xml", to_text(root));
}

// Files of the archive itself, and its checkpoints.
void copy_rest(const Archive& last, const fs::path& target, bool move) {
  for (const auto& entry : fs::directory_iterator(last.folder())) {
    const std::string name = entry.path().filename().string();
    if (entry.is_regular_file() && name != "index.xml" && entry.path().extension() != ".dat")
      copy_tree(entry.path(), target / name, false);
    if (entry.is_directory() && name == "checkpoints") copy_tree(entry.path(), target / name, move);
  }
}

std::vector<Archive> open_chain(const std::vector<std::string>& names) {
  std::vector<Archive> archives;
  for (const std::string& name : names) {
    archives.push_back(Archive::open(name));
    if (archives.back().format() != archives.front().format())
      throw InputError("archives of two formats cannot be joined");
    if (archives.size() > 2 &&
        restart_step(archives.back()) < restart_step(archives[archives.size() - 2]))
      throw InputError(fmt::format("{} does not follow {}: it went on at an earlier step", name,
                                   names[archives.size() - 2]));
  }
  return archives;
}

}  // namespace

int run_restart_merger(const ClassicCall& call) {
  const ClassicArguments arguments(merger_spec(), call.words);
  if (arguments.has("-h") || arguments.positional().size() < 2) {
    fmt::print(stderr, "{}", usage_of(merger_spec()));
    return 1;
  }
  const bool move = arguments.has("-move");
  const std::vector<Archive> archives = open_chain(arguments.positional());
  const fs::path target = free_name(archives.front().folder());
  if (!make_folder(target)) throw SystemError(target.string() + " has been made meanwhile");
  std::vector<StepEntry> steps;
  int after = -1;
  for (std::size_t n = 0; n < archives.size(); ++n) {
    const int last = n + 1 < archives.size() ? restart_step(archives[n + 1]) : -1;
    for (StepEntry s : steps_between(archives[n], after, last)) {
      require_referenced_archive(s, archives[n].folder());
      const fs::path source = (archives[n].folder() / s.href).parent_path();
      copy_tree(source, target / step_folder_name(s.step), move);
      s.href = fs::path(step_folder_name(s.step)) / "timestep.xml";
      steps.push_back(std::move(s));
    }
    after = last;
  }
  copy_rest(archives.back(), target, move);
  merge_histories(archives, target);
  write_index(archives, steps, target);
  if (move)
    for (const Archive& archive : archives) remove_tree(archive.folder());
  fmt::print("Successfully created {}\n", target.string());
  return 0;
}

}  // namespace sluice
