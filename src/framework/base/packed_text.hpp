// Text files that may be packed with gzip.
#pragma once
#include <string>

namespace sluice {

// The text of a file, unpacked if gzip has packed it, whatever its name. InputError beginning with
// `what` and the file's name where it cannot be opened, breaks off, or is damaged.
std::string unpacked_text(const std::string& file, const std::string& what);

}  // namespace sluice
