// What a series of runs has found so far, kept in a file, so that a series that was killed goes on
// where it was.
//
// One JSON object a line: {"key": ..., "found": ...}. A line that was cut short by the kill is
// dropped. The key of a run holds all that its result depends on: program, command line, deck.
#pragma once
#include <filesystem>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "framework/base/json.hpp"

namespace sluice {

class RunJournal {
 public:
  // Reads what an earlier series left in the folder, if any.
  explicit RunJournal(const std::filesystem::path& folder);

  std::size_t size() const { return found_.size(); }  // of what was left
  std::optional<Json> find(const std::string& key) const;
  // On the disk before it returns; several threads may call it. SystemError where the file cannot
  // be written.
  void add(const std::string& key, const Json& found);
  // The series is complete: the next one starts anew.
  void finish();

  // Of a run with these words of the command line; `deck`: a file.
  static std::string key_of(const std::vector<std::string>& words, const std::string& deck);

 private:
  std::filesystem::path file_;
  std::map<std::string, Json> found_;
  std::mutex mutex_;
};

}  // namespace sluice
