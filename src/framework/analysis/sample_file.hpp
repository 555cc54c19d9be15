// A text file that an analysis appends to: header lines with #, then one line a sample.
//
// Lines are kept in memory until flush(), which the run calls before each output and checkpoint
// and at its end. A restarted run copies the file of the earlier archive up to the restart. Times
// in s.
#pragma once
#include <filesystem>
#include <string>

namespace sluice {

class AnalysisFile {
 public:
  // `name`: path below the archive's folder. `header`: whole lines. `time_column`: which word of a
  // line (from 0) is the time.
  AnalysisFile(std::filesystem::path name, std::string header, int time_column);

  void append(const std::string& line);  // without its end
  std::size_t pending_bytes() const { return pending_.size(); }
  // Appends to the file in `folder`; a new file gets the header first. When the disk is full the
  // file is left as it was and SystemError is thrown.
  void flush(const std::filesystem::path& folder);
  // Takes over the lines up to `time` of the same file of an earlier archive, if it has any.
  void adopt(const std::filesystem::path& earlier, const std::filesystem::path& folder,
             double time) const;

  const std::filesystem::path& name() const { return name_; }

 private:
  std::filesystem::path name_;
  std::string header_;
  int time_column_;
  std::string pending_;
};

// A folder and those above it, where they are not there yet.
void make_folders(const std::filesystem::path& folder);

// The part of a text up to and including the last whole line whose time is at most `time`.
std::string lines_up_to(const std::string& text, int time_column, double time);

}  // namespace sluice
