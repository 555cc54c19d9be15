// Where a subcommand writes its result: a file, or standard output for "-".
#pragma once
#include <cstdio>
#include <filesystem>
#include <string>
#include <string_view>

namespace sluice {

// Every write is checked; a full disk or a closed pipe is a SystemError that names the target.
class TextSink {
 public:
  explicit TextSink(const std::string& target);
  TextSink(const TextSink&) = delete;
  TextSink& operator=(const TextSink&) = delete;
  ~TextSink();
  void write(std::string_view text);
  void close();  // to be called at the good end: checks the last bytes

 private:
  [[noreturn]] void fail() const;
  std::string target_;
  std::FILE* file_;
};

// The folder that -o names, with those above it. SystemError where it cannot be made.
void make_output_folder(const std::filesystem::path& folder);
// The whole text at once.
void write_text(const std::string& target, std::string_view text);

}  // namespace sluice
