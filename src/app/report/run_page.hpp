// One HTML page of a run that stands by itself: pictures are in it, nothing is loaded.
#pragma once
#include <string>
#include <vector>

namespace sluice {

struct RunPageOptions {
  std::string archive;
  std::string title;                // empty: that of the archive
  std::vector<std::string> labels;  // to draw; none: what `sluice plot` draws by itself
  bool pictures = true;
};

struct RunPage {
  std::string html;
  int pictures = 0;
  std::vector<std::string> notes;  // pictures that could not be drawn, a plan that there is not
};

// InputError, DamageError where the archive cannot be read; what else is missing is said on the
// page and in the notes.
RunPage run_page(const RunPageOptions& options);

}  // namespace sluice
