#include "app/regress/regress_folder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>

#include "app/regress/regress_keys.hpp"
#include "app/regress/suite_list.hpp"
#include "framework/base/error.hpp"
#include "framework/base/json.hpp"

namespace sluice {
namespace {

namespace fs = std::filesystem;

constexpr const char* kept_deck = "input_as_run.xml";

bool is_archive(const fs::path& path) {
  std::error_code error;
  return fs::exists(path / "index.xml", error);
}

bool is_deck(const fs::path& path) {
  return path.extension() == ".ups" || path.filename() == kept_deck;
}

std::vector<fs::path> entries_of(const fs::path& folder) {
  std::vector<fs::path> entries;
  for (const auto& entry : fs::directory_iterator(folder)) entries.push_back(entry.path());
  std::sort(entries.begin(), entries.end());
  return entries;
}

// Folders below, but not those of archives.
void find_decks(const fs::path& folder, std::vector<fs::path>& decks,
                std::vector<fs::path>& lists) {
  for (const fs::path& entry : entries_of(folder)) {
    if (fs::is_directory(entry) && !fs::is_symlink(entry)) {
      if (!is_archive(entry)) find_decks(entry, decks, lists);
    } else if (is_deck(entry)) {
      decks.push_back(entry);
    } else if (entry.extension() == ".py") {
      lists.push_back(entry);
    }
  }
}

// Archives in a folder; a link NAME.uda to NAME.uda.000 counts as one.
std::vector<fs::path> archives_in(const fs::path& folder) {
  std::vector<fs::path> found;
  for (const fs::path& entry : entries_of(folder))
    if (is_archive(entry) && !fs::is_symlink(entry)) found.push_back(entry);
  return found;
}

void find_gold(RegressCase& c, bool only_deck) {
  const fs::path folder = c.deck.parent_path(), stem = folder / c.deck.stem();
  const fs::path by_name = stem.string() + ".uda";
  if (is_archive(by_name)) {
    c.gold_archive = by_name;
  } else if (only_deck) {
    const std::vector<fs::path> archives = archives_in(folder);
    if (archives.size() == 1) c.gold_archive = archives.front();
  }
  if (!c.gold_archive.empty()) {
    c.gold_histories = c.gold_archive;
    return;
  }
  const std::vector<fs::path> entries = entries_of(folder);
  if (only_deck && std::any_of(entries.begin(), entries.end(),
                               [](const fs::path& e) { return e.extension() == ".dat"; }))
    c.gold_histories = folder;
}

void read_small_file(const fs::path& file, RegressCase& c) {
  std::ifstream in(file);
  if (!in) return;
  try {
    const Json json =
        Json::parse({std::istreambuf_iterator<char>(in), {}}, Json::Comments::skipped);
    read_regress_keys(json, KeyPlace::beside_deck, c);
    const fs::path folder = c.deck.parent_path();
    for (const auto& [key, target] :
         {std::pair{"gold", &c.gold_archive}, std::pair{"histories", &c.gold_histories}})
      if (json.contains(key)) {
        *target = folder / json.at(key).get<std::string>();
        if (!fs::exists(*target))
          throw InputError(fmt::format("{}: there is no {}", key, target->string()));
      }
    if (json.contains("gold") && !json.contains("histories")) c.gold_histories = c.gold_archive;
  } catch (const InputError& fault) {
    throw InputError(fmt::format("{}: {}", file.string(), fault.what()));
  } catch (const JsonError& fault) {
    throw InputError(fmt::format("{}: {}", file.string(), fault.what()));
  }
}

}  // namespace

std::vector<RegressCase> read_regress_folder(const fs::path& folder) {
  std::vector<fs::path> decks, lists;
  find_decks(folder, decks, lists);
  if (decks.empty())
    throw InputError(fmt::format("{} holds no deck (*.ups, {})", folder.string(), kept_deck));
  std::vector<SuiteTest> tests;
  for (const fs::path& list : lists)
    for (SuiteTest& test : read_suite_list(list)) tests.push_back(std::move(test));
  std::vector<RegressCase> cases;
  for (const fs::path& deck : decks) {
    RegressCase c;
    c.of_folder = true;
    c.restart_in_the_middle = true;
    c.deck = deck;
    const fs::path relative = deck.lexically_relative(folder);
    c.name = (deck.filename() == kept_deck ? relative.parent_path()
                                           : relative.parent_path() / relative.stem())
                 .string();
    if (c.name.empty()) c.name = fs::absolute(folder).lexically_normal().filename().string();
    const auto beside = std::count_if(decks.begin(), decks.end(), [&](const fs::path& other) {
      return other.parent_path() == deck.parent_path();
    });
    find_gold(c, beside == 1);
    for (const SuiteTest& test : tests) test.apply(c);
    const fs::path stem = deck.parent_path() / deck.stem();
    read_small_file(stem.string() + ".json", c);
    c.golden = stem.string() + ".csv";
    cases.push_back(std::move(c));
  }
  return cases;
}

}  // namespace sluice
