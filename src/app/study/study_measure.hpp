// The error of a run of a study: against the exact solution that the deck names, a formula or a
// number of the study, or a finer run; over all cells or particles, or of one number made of them.
#pragma once
#include <filesystem>
#include <optional>

#include "app/study/study.hpp"
#include "exact/base/error_norms.hpp"

namespace sluice {

// Of the last output of an archive; `reference` is the archive of the study's reference, if it has
// one. Throws InputError where the archive lacks what the study asks.
exact::ErrorNorms measured_error(const Study& study, const std::filesystem::path& archive,
                                 const std::optional<std::filesystem::path>& reference);

// Throws InputError where the deck does not save the study's variable, as far as its saved labels
// tell, or has nothing that errors could be measured against: before any run.
void require_measurable(const Study& study);

}  // namespace sluice
