// When the modules of a deck take samples, and which samplers they become on a level.
#pragma once
#include <functional>
#include <memory>
#include <optional>

#include "framework/analysis/sampler.hpp"
#include "framework/scene/analysis_settings.hpp"

namespace sluice {

// The field that an entry names. InputError naming entry and nearest label when there is none.
using FindQuantity = std::function<AnalysedQuantity(const AnalysedVariable&)>;

// May a module take a sample at this time, having taken the last one then.
bool sample_is_due(const AnalysisModule& module, std::optional<double> last, double time);
// Does a module sample labels level by level.
bool samples_levels(const AnalysisModule& module);
// Are its files named after the module alone.
bool writes_one_set_of_files(const AnalysisModule& module);
// InputError for fields that a module cannot take.
void check_fields(const AnalysisModule& module, const FindQuantity& find);
// One for each level that may exist; null where nothing is asked for.
std::vector<std::unique_ptr<LevelSampler>> make_samplers(const AnalysisModule& module,
                                                         const std::vector<Level>& levels,
                                                         const FindQuantity& find);

}  // namespace sluice
