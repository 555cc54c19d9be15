// Histories: NAME.dat or NAME_MATERIAL.dat, one line a step.
//
//   [step, ten wide<TAB>]time<TAB>value
//
// with 17 significant digits; a vector is three numbers with blanks between. No header. Lines are
// kept in memory until the archive writes an output or a checkpoint, or the run ends; the flush
// before that step enters the index takes them to the disk.
#pragma once
#include <filesystem>
#include <string>

#include "framework/base/vec3.hpp"

namespace sluice {

// Which steps get a line, and which columns: what <DataArchiver> says about global variables.
struct HistoryControl {
  int frequency = 1;  // a line when step modulo frequency equals on_step
  int on_step = 0;
  bool step_column = false;
  bool time_column = true;

  bool selects(int step) const { return frequency <= 1 || step % frequency == on_step % frequency; }
};

// `time`: s; `value`: in the unit of the label.
class HistoryFile {
 public:
  // An existing file is continued.
  HistoryFile(std::filesystem::path path, HistoryControl control);

  void append(int step, double time, double value);
  void append(int step, double time, Vec3 value);
  // Appends to the file. When the disk is full the file is left as it was.
  void write();

  const std::filesystem::path& path() const { return path_; }

 private:
  void append_line(int step, double time, const std::string& value);

  std::filesystem::path path_;
  HistoryControl control_;
  std::string pending_;
};

// Name of the file of a label; material < 0: of the whole run.
std::string history_file_name(const std::string& label, int material);

// Drops the lines after a restart's step and time, and a last line that was cut short.
void cut_history(const std::filesystem::path& path, const HistoryControl& control, int step,
                 double time);

}  // namespace sluice
