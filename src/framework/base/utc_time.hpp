// The time of day, for what people read.
#pragma once
#include <string>

namespace sluice {

std::string utc_now();  // 2026-01-31T23:59:59Z

}  // namespace sluice
