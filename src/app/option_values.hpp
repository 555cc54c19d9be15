// Values of options that several commands share.
#pragma once
#include <string>

#include "framework/base/vec3.hpp"

namespace sluice {

// "I,J,K", each at least 1; zeros for an empty text. InputError names the option.
IntVec3 positive_triple(const std::string& text, const char* option);

}  // namespace sluice
