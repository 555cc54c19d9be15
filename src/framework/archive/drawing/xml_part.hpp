// Elements of large texts, which are put together one after another.
#pragma once
#include <string>

#include "framework/archive/xml_text.hpp"

namespace sluice {

// Without the line that declares XML, and without indentation.
std::string to_part(const XmlElement& element);

}  // namespace sluice
