// Looking for the data files of a deck.
#include "mpm/deck/data_file.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "framework/deck/faults.hpp"
#include "framework/deck/schema.hpp"
#include "mpm/deck/schema.hpp"

namespace sluice::mpm {
namespace {

namespace fs = std::filesystem;

bool is_file(const fs::path& path) {
  std::error_code failed;
  return fs::is_regular_file(path, failed);
}

void locate_below(DeckNode& node, std::vector<Fault>& faults) {
  for (const auto& child : node.children) {
    locate_below(*child, faults);
    const bool piece =
        child->name == "file" || child->name == "tri" || child->name == "line_segment";
    DeckNode* name = piece ? child->child("name") : nullptr;
    if (name == nullptr) continue;
    const std::string path =
        find_data_file(name->text, child->name == "tri" ? ".tri" : "", name->where, faults);
    if (!path.empty()) name->text = path;
  }
}

}  // namespace

std::string find_data_file(const std::string& name, const std::string& extension,
                           const Location& where, std::vector<Fault>& faults) {
  if (name.empty()) return {};
  const fs::path folder = fs::path(where.file).parent_path();
  for (const fs::path& place : {fs::path(name), folder / name})
    if (is_file(place.string() + extension)) return place.string();
  const fs::path bare = folder / fs::path(name).filename();
  for (const fs::path& place : {fs::path(name), folder / name, bare})
    for (const char* packed : {"", ".gz"}) {
      const std::string path = place.string() + packed;
      if (!is_file(path + extension)) continue;
      add_warning(faults, where,
                  fmt::format("'{}' is not there; '{}' is taken", name + extension,
                              path + extension),
                  "correct the name");
      return path;
    }
  return {};
}

std::string data_file(const DeckNode& node, std::vector<Fault>& faults) {
  std::string path = find_data_file(node.text, "", node.where, faults);
  if (!path.empty()) return path;
  const fs::path folder = fs::path(node.where.file).parent_path();
  add_error(faults, node.where,
            fmt::format("<{}>: there is no file '{}', neither from the working directory nor "
                        "beside the deck, in '{}'",
                        node.name, node.text, folder.empty() ? "." : folder.string()),
            "names are relative to one of the two, without quotation marks");
  return {};
}

void locate_pieces(DeckNode& root, std::vector<Fault>& faults) {
  if (!runs_solids(root)) return;
  for (const auto& block : root.children)
    if (block->name == "MaterialProperties" || block->name == "PhysicalBC")
      locate_below(*block, faults);
}

}  // namespace sluice::mpm
