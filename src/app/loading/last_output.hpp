// Whether the last output of an archive is the end of its run.
#pragma once
#include <filesystem>
#include <optional>
#include <string>

namespace sluice {

class Archive;

// Where the run of an archive ended.
struct RunEnd {
  int step = 0;
  double time = 0;       // s
  bool in_full = false;  // not cut short, and not failed
};
// As the archive keeps it in run.json; none while the run goes on, or where it was killed.
std::optional<RunEnd> run_end(const Archive& archive);

// "output of step 1 (t = 1e-06); the run ended at step 71 (t = 0.0001): ..." and how to see the
// end; empty where the last output is the end. Of a run without an end: compared with its last
// checkpoint.
std::string last_output_note(const std::filesystem::path& archive);

}  // namespace sluice
