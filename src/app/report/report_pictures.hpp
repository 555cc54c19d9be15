// The pictures of a report, drawn by the same program as those of `sluice plot`.
#pragma once
#include <string>
#include <vector>

#include "framework/archive/archive.hpp"

namespace sluice {

struct ReportPicture {
  std::string title;
  std::string png;    // the bytes of the file; empty: it could not be drawn
  std::string fault;  // then why
};

// Fields at the first and the last output. `labels`: none: those of `sluice plot`.
std::vector<ReportPicture> field_pictures(const Archive& archive,
                                          const std::vector<std::string>& labels);
// Histories and samples of the run, several in one picture.
std::vector<ReportPicture> history_pictures(const Archive& archive);

}  // namespace sluice
