// sluice info UDA: what an archive holds, and with --verify whether every byte is as written.
#include <fmt/format.h>

#include <functional>
#include <memory>
#include <set>

#include "app/command/command_line.hpp"
#include "app/command/extremes_report.hpp"
#include "app/process/text_sink.hpp"
#include "framework/archive/archive.hpp"
#include "framework/archive/samples.hpp"
#include "framework/base/console.hpp"
#include "framework/base/json.hpp"

namespace sluice {
namespace {

namespace fs = std::filesystem;
struct Verification {
  bool done = false;
  std::int64_t values = 0;
  std::vector<std::string> damage;
};

std::int64_t bytes_in(const fs::path& folder) {
  std::int64_t bytes = 0;
  std::error_code error;
  for (const auto& entry : fs::recursive_directory_iterator(folder, error))
    if (entry.is_regular_file(error)) bytes += static_cast<std::int64_t>(entry.file_size(error));
  return bytes;
}

void verify_step(const std::function<ArchiveStep()>& open, Verification& v) {
  try {
    for (std::string& d : open().verify(v.values)) v.damage.push_back(std::move(d));
  } catch (const Error& error) {
    v.damage.push_back(error.what());
  }
}

Verification verify(const Archive& archive) {
  Verification v;
  v.done = true;
  v.damage = archive.damage();
  for (const StepEntry& e : archive.outputs())
    verify_step([&] { return archive.read_output(e); }, v);
  for (const StepEntry& e : archive.checkpoints())
    verify_step([&] { return archive.read_checkpoint(e); }, v);
  return v;
}

std::vector<FieldInfo> all_fields(const ArchiveStep& step) {
  std::vector<FieldInfo> all = step.fields();
  all.insert(all.end(), step.particle_fields().begin(), step.particle_fields().end());
  return all;
}

// The last readable state: its grid and labels stand for the archive's.
std::unique_ptr<ArchiveStep> last_step(const Archive& archive, std::vector<std::string>& damage) {
  for (const bool outputs : {true, false}) {
    const auto& entries = outputs ? archive.outputs() : archive.checkpoints();
    for (auto e = entries.rbegin(); e != entries.rend(); ++e) {
      try {
        return std::make_unique<ArchiveStep>(outputs ? archive.read_output(*e)
                                                     : archive.read_checkpoint(*e));
      } catch (const Error& error) {
        damage.push_back(error.what());
      }
    }
  }
  return nullptr;
}

std::string axes(const std::array<bool, 3>& flags) {
  std::string text;
  for (std::size_t d = 0; d < 3; ++d)
    if (flags[d]) text += "xyz"[d];
  return text.empty() ? "none" : text;
}

Vec3 corner(const Level& l, IntVec3 c) {
  return {l.anchor.x + c.x * l.spacing.x, l.anchor.y + c.y * l.spacing.y,
          l.anchor.z + c.z * l.spacing.z};
}

// For reading; --json has all digits.
std::string short_text(Vec3 v) {
  return fmt::format("[{:.6g}, {:.6g}, {:.6g}]", v.x, v.y, v.z);
}

Json steps_json(const std::vector<StepEntry>& entries) {
  Json list = Json::array();
  for (const StepEntry& e : entries) list.push_back({{"step", e.step}, {"time", e.time}});
  return list;
}

Json triple_json(Vec3 v) {
  return {v.x, v.y, v.z};
}
Json triple_json(IntVec3 v) {
  return {v.x, v.y, v.z};
}

Json to_json(const Archive& archive, const ArchiveStep* step, const Verification& v) {
  Json j;
  j["archive"] = archive.folder().string();
  j["format"] = archive.format() == ArchiveFormat::raw ? "raw" : "HDF5";
  j["program"] = archive.index().program;
  j["created"] = archive.index().created;
  j["ranks"] = archive.index().ranks;
  j["bytes"] = bytes_in(archive.folder());
  j["outputs"] = steps_json(archive.outputs());
  j["checkpoints"] = steps_json(archive.checkpoints());
  j["restarts"] = Json::array();
  for (const RestartEntry& r : archive.index().restarts)
    j["restarts"].push_back({{"from", r.from}, {"step", r.step}});
  j["histories"] = Json::array();
  for (const HistoryEntry& h : archive.index().histories) j["histories"].push_back(h.file);
  j["samples"] = Json::array();
  for (const Sample& s : find_samples(archive))
    j["samples"].push_back(
        {{"name", s.name}, {"kind", s.kind}, {"files", s.files.size()}, {"unit", s.unit}});
  j["levels"] = Json::array();
  j["labels"] = Json::array();
  if (step) {
    for (const Level& l : step->grid().levels)
      j["levels"].push_back({{"cells", l.cell_count()},
                             {"boxes", l.boxes.size()},
                             {"spacing", triple_json(l.spacing)},
                             {"index_low", triple_json(l.domain.lower)},
                             {"index_high", triple_json(l.domain.upper)},
                             {"low", triple_json(corner(l, l.domain.lower))},
                             {"high", triple_json(corner(l, l.domain.upper))},
                             {"periodic", l.periodic},
                             {"active", l.active}});
    for (const FieldInfo& f : all_fields(*step))
      j["labels"].push_back({{"name", f.name},
                             {"type", name_of(f.type)},
                             {"centring", name_of(f.centring)},
                             {"unit", f.unit},
                             {"material", f.material},
                             {"level", f.level},
                             {"stored", name_of(f.stored)}});
  }
  j["verified"] = v.done;
  if (v.done) j["good_values"] = v.values;
  j["not_read"] = Json::array();
  for (const VariableEntry& e : archive.index().variables)
    if (!e.readable) j["not_read"].push_back({{"name", e.name}, {"type", e.type_name}});
  j["damage"] = v.damage;
  return j;
}

void print_steps(const char* title, const std::vector<StepEntry>& entries) {
  constexpr std::size_t ends = 4;  // shown at either end of a long list
  fmt::print("{:<12} {}\n", title, entries.size());
  for (std::size_t n = 0; n < entries.size(); ++n) {
    if (entries.size() > 2 * ends + 1 && n == ends) {
      fmt::print("  ...\n");
      n = entries.size() - ends;
    }
    fmt::print("  #{:<5} step {:<8} time {:.10g}\n", n, entries[n].step, entries[n].time);
  }
}

void print_labels(const ArchiveStep& step) {
  struct Row {
    FieldInfo info;
    std::set<int> materials, levels;
  };
  std::map<std::string, Row> rows;
  for (const FieldInfo& f : all_fields(step)) {
    Row& row = rows.try_emplace(f.name, Row{f, {}, {}}).first->second;
    row.materials.insert(f.material);
    row.levels.insert(f.level);
  }
  auto list = [](const std::set<int>& items) {
    std::string text;
    for (const int i : items) text += (text.empty() ? "" : ",") + std::to_string(i);
    return text;
  };
  TextTable table(
      {{"label"}, {"type"}, {"centring"}, {"unit"}, {"materials"}, {"levels"}, {"stored"}});
  for (const auto& [name, row] : rows)
    table.row({name, std::string(name_of(row.info.type)), std::string(name_of(row.info.centring)),
               row.info.unit, list(row.materials), list(row.levels),
               std::string(name_of(row.info.stored))});
  fmt::print("labels of step {}\n{}", step.info().step, table.text("  "));
}

// Snapshots and cells, where there are several.
std::string files_text(const Sample& s) {
  if (s.files.size() < 2) return {};
  return fmt::format("  ({} {})", s.files.size(), s.kind == "line" ? "cells" : "times");
}

void print_text(const Archive& archive, const ArchiveStep* step, const Verification& v) {
  const ArchiveIndex& index = archive.index();
  fmt::print("archive      {}\n", archive.folder().string());
  const bool raw = archive.format() == ArchiveFormat::raw;
  fmt::print("written by   {}{}, {}, {} rank{}\n", index.program, raw ? ", raw layout" : "",
             index.created, index.ranks, index.ranks == 1 ? "" : "s");
  fmt::print("size         {}\n", human_bytes(static_cast<double>(bytes_in(archive.folder()))));
  for (const RestartEntry& r : index.restarts)
    fmt::print("restarted    from {} at step {}\n", r.from, r.step);
  print_steps("outputs", archive.outputs());
  print_steps("checkpoints", archive.checkpoints());
  for (const Sample& s : find_samples(archive))
    fmt::print("{:<12} {}{}\n", s.kind, s.name, files_text(s));
  if (step) {
    for (const Level& l : step->grid().levels)
      fmt::print(
          "level {}      {} cells in {} box{}, {} to {}, spacing {}, active {}, periodic {}\n",
          l.index, human_count(l.cell_count()), l.boxes.size(), l.boxes.size() == 1 ? "" : "es",
          short_text(corner(l, l.domain.lower)), short_text(corner(l, l.domain.upper)),
          short_text(l.spacing), axes(l.active), axes(l.periodic));
    print_labels(*step);
  }
  for (const VariableEntry& e : index.variables)
    if (!e.readable) fmt::print("not read     {}: values of type {}\n", e.name, e.type_name);
  for (const std::string& d : v.damage) fmt::print("DAMAGED      {}\n", d);
  if (v.done)
    fmt::print("verified     {} values {}, {}\n", human_count(v.values),
               raw ? "read (raw files have no checksums)" : "good",
               v.damage.empty() ? "nothing damaged" : "damage as listed");
}

struct InfoRequest {
  std::string archive, time, json;
  bool verify = false, checkpoint = false, extremes = false;
};

int inform(const InfoRequest& r) {
  const Archive archive = Archive::open(r.archive);
  const bool all = r.verify;
  Verification v;
  if (all)
    v = verify(archive);
  else
    v.damage = archive.damage();
  std::vector<std::string> unreadable;
  // One that is asked for is read, or refused.
  const bool asked = r.checkpoint || r.extremes || !r.time.empty();
  const std::unique_ptr<ArchiveStep> step =
      asked ? std::make_unique<ArchiveStep>(
                  archive.read(r.checkpoint ? Stored::checkpoints : Stored::outputs,
                               r.time.empty() ? "last" : r.time))
            : last_step(archive, unreadable);
  if (!all) {
    v.damage.insert(v.damage.end(), unreadable.begin(), unreadable.end());
    if (step) v.damage.insert(v.damage.end(), step->damage().begin(), step->damage().end());
  }
  if (!r.json.empty()) {
    Json j = to_json(archive, step.get(), v);
    if (r.extremes) j["state"] = extremes_json(archive, *step);
    write_text(r.json, j.dump(2) + "\n");
  }
  if (r.json == "-") {
    // Nothing else goes to standard output.
  } else if (r.extremes) {
    fmt::print("{}", extremes_text(archive, *step));
    for (const std::string& d : v.damage) fmt::print("DAMAGED      {}\n", d);
  } else {
    print_text(archive, step.get(), v);
  }
  return v.damage.empty() ? 0 : 1;
}

}  // namespace

void declare_info_command(Command& command) {
  auto r = std::make_shared<InfoRequest>();
  command.option("UDA", r->archive, "The archive").required();
  command.json(r->json, "As JSON");
  command.flag("--verify", r->verify, "Read everything and check every checksum");
  command.flag("--extremes", r->extremes,
               "Least and largest value of every label, material and level with their places; "
               "volume, mass and momentum of each material");
  command.option("--time", r->time,
                 "Labels and extremes of this output: last (default), first, a time, #N");
  command.flag("--checkpoint", r->checkpoint, "Of a checkpoint, not of an output");
  command.action([r] { return inform(*r); });
}

}  // namespace sluice
