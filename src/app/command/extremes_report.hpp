// What `sluice info --extremes` tells: least and largest values with their places, and sums.
#pragma once
#include <string>

namespace sluice {

class Archive;
class ArchiveStep;
class Json;

// Two tables. `archive`: whose deck says how many materials there are.
std::string extremes_text(const Archive& archive, const ArchiveStep& step);
// {"step", "time", "extremes": [...], "sums": [...]}; what is not saved is null.
Json extremes_json(const Archive& archive, const ArchiveStep& step);

}  // namespace sluice
