// One output as a collection of XDMF: levels of images, particles of materials.
#pragma once
#include <string>

#include "framework/archive/archive_record.hpp"
#include "framework/archive/drawing/array_names.hpp"
#include "framework/archive/xdmf/covered_file.hpp"

namespace sluice {

// What all outputs of an archive share.
struct XdmfContext {
  const ArrayNames* names;
  std::string covered_file;  // its name beside the XDMF file
  std::int64_t covered_total = 0;
};

// `href`: of the step's folder, as the XDMF file names it; `folder`: where it is.
XmlElement xdmf_step(const XdmfContext& context, const StepRecord& record,
                     const CoveredBoxes& covered, const std::filesystem::path& href,
                     const std::filesystem::path& folder);

}  // namespace sluice
