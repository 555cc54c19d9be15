// Looking for the data files of a deck.
#include "framework/deck/data_file.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "framework/deck/faults.hpp"
#include "framework/deck/schema.hpp"

namespace sluice {
namespace {

namespace fs = std::filesystem;

constexpr const char* kept_folder = "input_files";

bool is_file(const fs::path& path) {
  std::error_code failed;
  return fs::is_regular_file(path, failed);
}

bool is_kept(const std::string& name) {
  const fs::path path(name);
  return path.has_parent_path() && *path.begin() == kept_folder;
}

std::vector<fs::path> places_of(const std::string& name, const std::vector<fs::path>& folders) {
  std::vector<fs::path> places;
  for (const fs::path& folder : folders) places.push_back(folder / name);
  places.insert(is_kept(name) ? places.end() : places.begin(), fs::path(name));
  return places;
}

// Calls f(node, endings) for every tag below that names a file.
template <class F>
void visit_files(DeckNode& node, const TagSpec& spec, const Schema& schema, F&& f) {
  for (const auto& child : node.children) {
    const TagSpec* known = schema.child(spec, child->name);
    if (known == nullptr) continue;
    if (!known->value.file_endings.empty() && !child->text.empty())
      f(*child, known->value.file_endings);
    visit_files(*child, *known, schema, f);
  }
}

// A name beside the kept deck that no other file has.
std::string name_to_keep(const fs::path& file, const std::vector<std::string>& endings,
                         const KeptFiles& files) {
  const std::string base = file.filename().string();
  for (int n = 1;; ++n) {
    const std::string name =
        fmt::format("{}/{}{}", kept_folder, n == 1 ? "" : fmt::format("{}_", n), base);
    const bool is_free = std::all_of(endings.begin(), endings.end(), [&](const std::string& end) {
      const auto found = files.find(name + end);
      return found == files.end() || found->second == fs::path(file.string() + end);
    });
    if (is_free) return name;
  }
}

}  // namespace

std::vector<fs::path> search_folders(const Location& where) {
  std::vector<fs::path> folders = {fs::path(where.file).parent_path()};
  std::error_code failed;
  if (fs::is_symlink(where.file, failed)) {
    const fs::path target = fs::canonical(where.file, failed);
    if (!failed) folders.push_back(target.parent_path());
  }
  return folders;
}

std::string find_data_file(const std::string& name, const std::string& ending,
                           const Location& where, std::vector<Fault>& faults) {
  if (name.empty()) return {};
  const std::vector<fs::path> folders = search_folders(where);
  std::vector<fs::path> places = places_of(name, folders);
  for (const fs::path& place : places)
    if (is_file(place.string() + ending)) return place.string();
  for (const fs::path& folder : folders) places.push_back(folder / fs::path(name).filename());
  for (const fs::path& place : places)
    for (const char* packed : {"", ".gz"}) {
      const std::string path = place.string() + packed;
      if (!is_file(path + ending)) continue;
      add_warning(faults, where,
                  fmt::format("'{}' does not exist; '{}' is used", name + ending, path + ending),
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
            fmt::format("<{}>: there is no file '{}', neither in the working directory nor in the "
                        "folder of the deck, '{}'",
                        node.name, node.text, folder.empty() ? "." : folder.string()),
            "names are relative to one of the two, without quotation marks");
  return {};
}

void locate_files(DeckNode& root, const Schema& schema, std::vector<Fault>& faults) {
  visit_files(
      root, schema.root, schema, [&](DeckNode& node, const std::vector<std::string>& endings) {
        const std::string path = find_data_file(node.text, endings.front(), node.where, faults);
        if (!path.empty()) node.text = path;
      });
}

void keep_files(DeckNode& root, const Schema& schema, KeptFiles& files) {
  visit_files(root, schema.root, schema,
              [&](DeckNode& node, const std::vector<std::string>& endings) {
                std::error_code failed;
                const fs::path file = fs::absolute(node.text, failed).lexically_normal();
                if (failed || !is_file(file.string() + endings.front())) return;
                node.text = name_to_keep(file, endings, files);
                for (const std::string& end : endings) files[node.text + end] = file.string() + end;
              });
}

}  // namespace sluice
