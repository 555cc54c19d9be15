// Making archive folders and writing steps into them, so that a kill at any moment harms nothing.
#include "framework/archive/archive_writer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "framework/base/communicator.hpp"
#include "framework/base/console.hpp"
#include "framework/base/error.hpp"

namespace sluice {
namespace fs = std::filesystem;
namespace {

// Merges the variables of a step into the list of the archive.
void merge_variables(std::vector<VariableEntry>& known, const std::vector<StoredVariable>& stored) {
  std::map<std::string, std::set<int>> materials;
  for (const StoredVariable& v : stored) materials[v.name].insert(v.material);
  for (const StoredVariable& v : stored) {
    auto it = std::lower_bound(known.begin(), known.end(), v.name,
                               [](const VariableEntry& e, const auto& n) { return e.name < n; });
    if (it == known.end() || it->name != v.name)
      it = known.insert(it, {v.name, v.type, v.centring, v.unit, 0});
    it->materials = std::max(it->materials, static_cast<int>(materials[v.name].size()));
  }
}

void raise(char status, const std::string& message) {
  if (status == '1') throw PhysicsError(message);
  if (status == '2') throw InputError(message);
  throw SystemError(message);
}

}  // namespace

WriterRanks writer_ranks(Communicator& communicator) {
  return {communicator.rank(), communicator.size(),
          [&](const std::string& text) { return communicator.gather_to_all(text); }};
}

void ArchiveWriter::together(const std::function<void()>& work) {
  std::string failure;  // exit status and message; empty when all is well
  try {
    work();
  } catch (const Error& e) {
    failure = fmt::format("{}{}", static_cast<int>(e.status()), e.what());
  } catch (const std::exception& e) {
    failure = fmt::format("3{}", e.what());
  }
  for (const std::string& f : ranks_.gather_to_all(failure))
    if (!f.empty()) raise(f[0], f.substr(1));
}

void ArchiveWriter::on_root(const std::function<void()>& work) {
  together([&] {
    if (ranks_.rank == 0) work();
  });
}

ArchiveWriter::~ArchiveWriter() {
  try {
    write_histories();
  } catch (const Error&) {
    // finish() is where a failure is reported; a destructor only tries.
  }
}

WriteReport ArchiveWriter::write_output(const StepInfo& info, const Grid& grid,
                                        std::span<const FieldPiece> pieces) {
  return write_step(outputs_, info, grid, pieces, setup_.outputs);
}

WriteReport ArchiveWriter::write_checkpoint(const StepInfo& info, const Grid& grid,
                                            std::span<const FieldPiece> pieces) {
  on_root([&] { make_folder(checkpoints_.folder); });
  return write_step(checkpoints_, info, grid, pieces, StorageOptions{});
}

WriteReport ArchiveWriter::write_step(Store& store, const StepInfo& info, const Grid& grid,
                                      std::span<const FieldPiece> pieces,
                                      const StorageOptions& options) {
  const fs::path partial = store.folder / (step_folder_name(info.step) + ".partial");
  WriteReport report;
  try {
    // 1. A fresh folder that no index names.
    on_root([&] {
      remove_tree(partial);
      make_folder(partial);
    });
    // 2. Every rank its own files, flushed: the values here, so that a failure is this file's; the
    //    rest with the file system, which on rank 0 the index does.
    together([&] {
      const FieldFileResult r = write_field_file(partial, ranks_.rank, pieces, options);
      if (ranks_.rank != 0) flush_file_system(partial);
      report = {r.record.bytes, r.float_overflows};
    });
    warn_of_overflows(info.step, report.float_overflows);
    // 3. The step gets its name and, all of it flushed, its line in the index.
    on_root([&] { publish(store, info, grid); });
  } catch (const Error& e) {
    std::error_code ignored;
    if (ranks_.rank == 0) fs::remove_all(partial, ignored);
    raise(static_cast<char>('0' + static_cast<int>(e.status())),
          fmt::format("{}\n  while writing step {} ({} on this rank); the incomplete step was "
                      "removed, the archive {} remains valid up to the step before",
                      e.what(), info.step,
                      human_bytes(static_cast<double>(stored_bytes(pieces, options))),
                      folder_.string()));
  }
  return report;
}

// Said once: what is too large for a float stays so.
void ArchiveWriter::warn_of_overflows(int step, std::int64_t count) {
  if (count == 0 || overflow_warned_) return;
  overflow_warned_ = true;
  warnings_.push_back(fmt::format(
      "outputDoubleAsFloat: {} values of step {} are too large for a float and are stored as "
      "infinite; leave the tag out of the deck to keep them",
      count, step));
}

void ArchiveWriter::publish(Store& store, const StepInfo& info, const Grid& grid) {
  const std::string name = step_folder_name(info.step);
  const fs::path partial = store.folder / (name + ".partial"), complete = store.folder / name;
  StepRecord record;
  record.info = info;
  record.grid = grid;
  record.ranks = ranks_.size;
  std::vector<StoredVariable> stored;
  for (int rank = 0; rank < ranks_.size; ++rank) {
    record.data_files.push_back(fmt::format("p{:05}.xml", rank));
    const fs::path path = partial / record.data_files.back();
    const DataFileRecord file = parse_data_file(read_sealed(path), path.string());
    stored.insert(stored.end(), file.variables.begin(), file.variables.end());
  }
  write_sealed(partial / "timestep.xml", to_xml(record));
  ArchiveIndex before = store.index;
  std::erase_if(store.index.steps, [&](const StepEntry& s) { return s.step == info.step; });
  if (store.index.steps.size() != before.steps.size()) write_index(store);
  remove_tree(complete);  // of an earlier, unindexed or replaced, writing of this step
  rename_path(partial, complete);
  std::vector<fs::path> retired;
  try {
    write_histories();
    merge_variables(store.index.variables, stored);
    store.index.steps.push_back(
        {info.step, info.time, info.old_delt, fs::path(name) / "timestep.xml"});
    retired = retire(store);
    write_index(store);
  } catch (...) {
    store.index = std::move(before);
    std::error_code ignored;
    fs::remove_all(complete, ignored);
    throw;
  }
  for (const fs::path& old : retired) remove_tree(old);
}

// Takes the checkpoints beyond the cycle out of the index; their folders go once it is written.
std::vector<fs::path> ArchiveWriter::retire(Store& store) const {
  auto& steps = store.index.steps;
  const std::size_t keep = setup_.checkpoint_cycle;
  std::vector<fs::path> retired;
  if (&store != &checkpoints_ || setup_.checkpoint_cycle <= 0) return retired;
  while (steps.size() > keep) {
    retired.push_back((store.folder / steps.front().href).parent_path());
    steps.erase(steps.begin());
  }
  return retired;
}

void ArchiveWriter::write_index(const Store& store) {
  publish_sealed(store.folder / "index.xml", to_xml(store.index));
}

HistoryFile& ArchiveWriter::history_file(const std::string& label, int material, const char* type) {
  const std::string name = history_file_name(label, material);
  auto it = histories_.find(name);
  if (it != histories_.end()) return it->second;
  auto& known = outputs_.index.histories;
  if (std::none_of(known.begin(), known.end(), [&](const auto& h) { return h.file == name; }))
    known.push_back({label, name, fmt::format("ReductionVariable<{}>", type)});
  checkpoints_.index.histories = known;
  return histories_.emplace(name, HistoryFile(folder_ / name, setup_.histories)).first->second;
}

void ArchiveWriter::history(const std::string& label, int material, int step, double time,
                            double value) {
  if (ranks_.rank == 0) history_file(label, material, "double").append(step, time, value);
}
void ArchiveWriter::history(const std::string& label, int material, int step, double time,
                            Vec3 value) {
  if (ranks_.rank == 0) history_file(label, material, "Vector").append(step, time, value);
}

void ArchiveWriter::write_histories() {
  for (auto& [name, file] : histories_) file.write();
}

void ArchiveWriter::write_text(const std::string& name, const std::string& text) {
  on_root([&] { write_text_atomically(folder_ / name, text); });
}

void ArchiveWriter::finish() {
  on_root([&] {
    write_histories();
    if (!histories_.empty()) write_index(outputs_);
    flush_file_system(folder_);  // the last names, too
  });
}

}  // namespace sluice
