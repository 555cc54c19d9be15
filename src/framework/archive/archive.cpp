// Opening archives and choosing among their steps.
#include "framework/archive/archive.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "framework/archive/posix_file.hpp"
#include "framework/archive/raw_record.hpp"

namespace sluice {
namespace fs = std::filesystem;
namespace {

const char* name_of(Stored kind) {
  return kind == Stored::outputs ? "output" : "checkpoint";
}

const StepEntry& nearest(const std::vector<StepEntry>& steps, double time, const fs::path& folder,
                         const char* kind) {
  auto best = std::min_element(steps.begin(), steps.end(), [&](const auto& a, const auto& b) {
    return std::abs(a.time - time) < std::abs(b.time - time);
  });
  // The interval that ends or begins at the nearest output, on the side where the time lies.
  const bool after = time > best->time;
  double interval = 0;
  if (after && best + 1 != steps.end()) interval = (best + 1)->time - best->time;
  if (!after && best != steps.begin()) interval = best->time - (best - 1)->time;
  if (interval == 0 && steps.size() > 1)
    interval =
        best == steps.begin() ? steps[1].time - steps[0].time : best->time - (best - 1)->time;
  const double round_off = 1e-12 * std::max(std::abs(time), std::abs(best->time));
  if (std::abs(best->time - time) <= std::max(interval / 2, round_off)) return *best;
  throw InputError(fmt::format(
      "{} has no {} near time {:.17g}: the nearest is at {:.17g}, {}s go from {:.17g} to {:.17g}; "
      "see sluice info",
      folder.string(), kind, time, best->time, kind, steps.front().time, steps.back().time));
}

// Raw archives have an index of the same name, whose missing checksum is no damage.
ArchiveIndex read_any_index(const fs::path& path) {
  const std::string text = read_text(path);
  if (is_raw_index(text)) return parse_raw_index(parse_xml(text, path.string()), path.string());
  return parse_index(read_sealed(path), path.string());
}

}  // namespace

Archive Archive::open(const fs::path& path) {
  std::error_code error;
  Archive archive;
  archive.folder_ = fs::canonical(path, error);
  if (error)
    throw InputError(fmt::format("cannot open archive {}: {}", path.string(), error.message()));
  const fs::path index = archive.folder_ / "index.xml";
  if (!fs::exists(index, error))
    throw InputError(fmt::format("{} is not an archive: it has no index.xml", path.string()));
  archive.index_ = read_any_index(index);
  const fs::path checkpoints = archive.folder_ / "checkpoints" / "index.xml";
  if (fs::exists(checkpoints, error)) {
    try {
      archive.checkpoint_index_ = read_any_index(checkpoints);
    } catch (const Error& e) {
      archive.damage_.push_back(e.what());
    }
  }
  return archive;
}

const StepEntry& Archive::select(Stored kind, std::string_view text) const {
  if (kind == Stored::checkpoints) select_checkpoint();  // tells when there is none
  const std::vector<StepEntry>& steps = kind == Stored::outputs ? outputs() : checkpoints();
  if (steps.empty()) throw InputError(folder_.string() + " has no output yet");
  if (text == "last") return steps.back();
  if (text == "first") return steps.front();
  try {
    if (text.starts_with('#')) {
      const int n = parse_int(text.substr(1), "--time");
      if (n >= 0 && static_cast<std::size_t>(n) < steps.size()) return steps[n];
      throw InputError(fmt::format("{} has no {} {}: there are #0 to #{}", folder_.string(),
                                   name_of(kind), text, steps.size() - 1));
    }
    const double time = parse_real(text, "--time");
    if (std::isfinite(time)) return nearest(steps, time, folder_, name_of(kind));
  } catch (const DamageError&) {
    // Not a number: said below.
  }
  throw InputError(fmt::format("--time {}: expected last, first, a time, or #N for the N-th {}",
                               text, name_of(kind)));
}

const StepEntry& Archive::select_checkpoint(int step) const {
  const std::vector<StepEntry>& steps = checkpoint_index_.steps;
  for (const std::string& d : damage_) throw DamageError(d);
  if (steps.empty())
    throw InputError(folder_.string() +
                     " has no checkpoint; the deck's <checkpoint> asks for them");
  if (step < 0) return steps.back();
  std::string have;
  for (const StepEntry& s : steps) {
    if (s.step == step) return s;
    have += fmt::format(" {}", s.step);
  }
  throw InputError(
      fmt::format("{} has no checkpoint of step {}; it has{}", folder_.string(), step, have));
}

void require_own_format(const Archive& archive) {
  if (archive.format() == ArchiveFormat::hdf5) return;
  const fs::path deck = archive.folder() / "input.xml.orig";
  throw InputError(fmt::format(
      "{} is an archive in Uintah's raw binary layout: Sluice reads it (info, extract, plot, "
      "compare, norms, export), but does not continue its run\n  run its deck from the start: {}",
      archive.folder().string(),
      (fs::exists(deck) ? deck : archive.folder() / "input.xml").string()));
}

}  // namespace sluice
