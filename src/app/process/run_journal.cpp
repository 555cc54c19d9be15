#include "app/process/run_journal.hpp"

#include <fmt/format.h>

#include <fstream>
#include <functional>

#include "framework/base/error.hpp"
#include "sluice_version.hpp"

namespace sluice {

RunJournal::RunJournal(const std::filesystem::path& folder) : file_(folder / "journal.jsonl") {
  std::ifstream in(file_);
  for (std::string line; std::getline(in, line);) {
    const Json entry = Json::parse_or_null(line);
    if (!entry.is_object() || !entry.contains("key") || !entry.contains("found")) continue;
    if (entry.at("key").is_text()) found_[entry.at("key").get<std::string>()] = entry.at("found");
  }
}

std::optional<Json> RunJournal::find(const std::string& key) const {
  const auto found = found_.find(key);
  return found == found_.end() ? std::nullopt : std::optional(found->second);
}

void RunJournal::add(const std::string& key, const Json& found) {
  const std::scoped_lock lock(mutex_);
  // A line that a kill cut short ends here.
  std::ofstream out(file_, std::ios::app);
  out << "\n" << Json{{"key", key}, {"found", found}}.dump() << "\n";
  if (!out.flush())
    throw SystemError(
        fmt::format("cannot write {}: is the disk full or the folder read-only?", file_.string()));
}

void RunJournal::finish() {
  std::error_code ignored;
  std::filesystem::remove(file_, ignored);
}

std::string RunJournal::key_of(const std::vector<std::string>& words, const std::string& deck) {
  std::ifstream in(deck, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  std::string key = fmt::format("{} {:x}", version::kText, std::hash<std::string>{}(text));
  for (const std::string& word : words) key += " " + word;
  return key;
}

}  // namespace sluice
