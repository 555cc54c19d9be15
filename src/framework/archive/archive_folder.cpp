// The folders of an archive: a new number for a new run, continuing an old one, links.
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>

#include "framework/archive/archive_writer.hpp"
#include "framework/base/error.hpp"
#include "framework/base/utc_time.hpp"

namespace sluice {
namespace fs = std::filesystem;
namespace {

void copy_over(const fs::path& from, const fs::path& to) {
  std::error_code error;
  fs::copy_file(from, to, fs::copy_options::overwrite_existing, error);
  if (error) fail_system("copy " + from.string() + " to", to, error.value());
}

// A step's folder, whole: copied beside its name and renamed.
void copy_step(const fs::path& from, const fs::path& to) {
  const fs::path partial = to.string() + ".partial";
  remove_tree(partial);
  make_folder(partial);
  for (const auto& entry : fs::directory_iterator(from))
    copy_over(entry.path(), partial / entry.path().filename());
  rename_path(partial, to);
}

const StepEntry& find_step(const ArchiveIndex& index, int step, const fs::path& folder) {
  for (const StepEntry& s : index.steps)
    if (s.step == step) return s;
  std::string have;
  for (const StepEntry& s : index.steps) have += fmt::format(" {}", s.step);
  throw InputError(fmt::format("{} has no checkpoint of step {}; it has{}", folder.string(), step,
                               have.empty() ? " none" : have));
}

ArchiveIndex read_index(const fs::path& folder) {
  const fs::path path = folder / "index.xml";
  if (!fs::exists(path))
    throw InputError(fmt::format("{} does not exist: {}", path.string(),
                                 folder.filename() == "checkpoints"
                                     ? "the archive has no checkpoint to restart from"
                                     : "this is not an archive"));
  return parse_index(read_sealed(path), path.string());
}

}  // namespace

ArchiveWriter ArchiveWriter::create(const ArchiveSetup& setup, WriterRanks ranks) {
  ArchiveWriter writer(setup, std::move(ranks));
  writer.on_root([&] { writer.make_archive_folder(); });
  writer.folder_ = writer.ranks_.gather_to_all(writer.folder_.string()).front();
  writer.outputs_.folder = writer.folder_;
  writer.checkpoints_.folder = writer.folder_ / "checkpoints";
  for (Store* store : {&writer.outputs_, &writer.checkpoints_}) {
    store->index.ranks = writer.ranks_.size;
    store->index.program = setup.program;
    store->index.created = utc_now();
  }
  writer.on_root([&] {
    try {
      sluice::write_text(writer.folder_ / "input.xml", setup.deck_xml);
      for (const auto& [name, xml] : setup.other_decks)
        sluice::write_text(writer.folder_ / name, xml);
      for (const auto& [name, file] : setup.kept_files) {
        make_folder((writer.folder_ / name).parent_path());
        copy_over(file, writer.folder_ / name);
      }
      writer.write_index(writer.outputs_);
    } catch (...) {
      std::error_code ignored;  // an archive that cannot even begin leaves nothing behind
      fs::remove_all(writer.folder_, ignored);
      throw;
    }
    writer.link_newest(setup.parent / setup.filebase);
  });
  return writer;
}

void ArchiveWriter::make_archive_folder() {
  const fs::path base = setup_.parent / setup_.filebase;
  std::error_code error;
  if (base.has_parent_path()) fs::create_directories(base.parent_path(), error);
  if (error) fail_system("create folder", base.parent_path(), error.value());
  // mkdir either makes the folder or says that it is there: the number is ours alone.
  for (int number = 0; number < 100000; ++number) {
    const fs::path folder = base.string() + fmt::format(".{:03}", number);
    if (!make_folder(folder)) continue;
    folder_ = folder;
    lock_ = FolderLock(folder);
    return;
  }
  throw SystemError(
      fmt::format("{}.NNN: all numbers up to 99999 are taken; remove old archives or "
                  "choose another folder with -o DIR",
                  base.string()));
}

namespace {

void require_file(const fs::path& file, const std::string& meaning) {
  std::error_code error;
  if (fs::exists(file, error)) return;
  throw SystemError(
      fmt::format("{} is gone ({}): it was removed or renamed while the run was writing, so that "
                  "the archive is "
                  "no longer complete; the run ends here",
                  file.string(), meaning));
}

}  // namespace

// Steps of an earlier archive, to which this one refers, are not the run's own: they are missed
// when they are read.
void ArchiveWriter::require_all_there() const {
  if (!lock_.is_at(folder_))
    throw SystemError(fmt::format(
        "{} is gone (the folder of the archive): it was removed, renamed or replaced while the run "
        "was writing; the run ends here",
        folder_.string()));
  require_file(folder_ / "input.xml", "the deck of the run");
  for (const auto& [name, xml] : setup_.other_decks)
    require_file(folder_ / name, "a deck of the run");
  for (const auto& [name, file] : setup_.kept_files)
    require_file(folder_ / name, "a file that the deck names");
  for (const Store* store : {&outputs_, &checkpoints_})
    for (const StepEntry& s : store->index.steps)
      if (s.href.begin() != s.href.end() && *s.href.begin() != ".." && s.href.is_relative())
        require_file(store->folder / s.href,
                     fmt::format("step {} of {}", s.step, (store->folder / "index.xml").string()));
}

void ArchiveWriter::link_newest(const fs::path& base) {
  std::error_code ignored;
  const fs::file_status there = fs::symlink_status(base, ignored);
  if (fs::exists(there) && !fs::is_symlink(there)) {
    warnings_.push_back(
        fmt::format("{} is a {} and is kept: no link of this name leads to the archive {}",
                    base.string(), fs::is_directory(there) ? "folder" : "file", folder_.string()));
    return;
  }
  const fs::path beside = base.string() + fmt::format(".{}.link", ::getpid());
  ::unlink(beside.c_str());
  const bool linked = ::symlink(folder_.filename().c_str(), beside.c_str()) == 0 &&
                      std::rename(beside.c_str(), base.c_str()) == 0;
  if (linked) return;
  const int error_number = errno;
  ::unlink(beside.c_str());
  warnings_.push_back(fmt::format("{} could not be made a link to {}: {}", base.string(),
                                  folder_.filename().string(),
                                  std::generic_category().message(error_number)));
}

namespace {

// Histories that either index names: a run killed between a checkpoint and its next output has
// named them with the checkpoint only.
std::vector<HistoryEntry> all_histories(const ArchiveIndex& outputs,
                                        const ArchiveIndex& checkpoints) {
  std::vector<HistoryEntry> all = outputs.histories;
  for (const HistoryEntry& h : checkpoints.histories)
    if (std::none_of(all.begin(), all.end(),
                     [&](const HistoryEntry& known) { return known.file == h.file; }))
      all.push_back(h);
  return all;
}

}  // namespace

void ArchiveWriter::adopt(const fs::path& earlier_archive, int restart_step, Earlier mode) {
  on_root([&] {
    const fs::path earlier = fs::canonical(earlier_archive);
    const ArchiveIndex old = read_index(earlier);
    const ArchiveIndex old_checkpoints = read_index(earlier / "checkpoints");
    const StepEntry start = find_step(old_checkpoints, restart_step, earlier);
    const std::vector<HistoryEntry> histories = all_histories(old, old_checkpoints);
    outputs_.index.restarts = old.restarts;
    outputs_.index.restarts.push_back({earlier.filename().string(), restart_step});
    checkpoints_.index.restarts = outputs_.index.restarts;
    if (mode != Earlier::stamp_only) {
      outputs_.index.variables = old.variables;
      outputs_.index.histories = histories;
      for (StepEntry s : old.steps) {
        if (s.step > restart_step) continue;
        const fs::path source = earlier / s.href;
        if (mode == Earlier::copy) {
          require_referenced_archive(s, earlier);
          s.href = fs::path(step_folder_name(s.step)) / "timestep.xml";
          copy_step(source.parent_path(), (folder_ / s.href).parent_path());
        } else {
          s.href = source.lexically_relative(fs::canonical(folder_));
        }
        outputs_.index.steps.push_back(std::move(s));
      }
      for (const HistoryEntry& h : histories) {
        if (!fs::exists(earlier / h.file)) continue;
        copy_over(earlier / h.file, folder_ / h.file);
        cut_history(folder_ / h.file, setup_.histories, restart_step, start.time);
      }
    }
    write_index(outputs_);
  });
}

}  // namespace sluice
