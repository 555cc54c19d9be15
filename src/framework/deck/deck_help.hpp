// The schema in words: help on one tag, and the whole as Markdown.
#pragma once
#include <string>

#include "framework/deck/schema.hpp"

namespace sluice {

// Everything about a tag, named alone ("cfl") or by its path ("CFD/ICE/advection"); all tags of
// that name when it stands in several places. InputError with the nearest name when there is none.
std::string help_on(const Schema& schema, const std::string& name_or_path);

// The blocks and what stands directly in them.
std::string help_overview(const Schema& schema);

// The reference of all tags as one Markdown page.
std::string markdown_reference(const Schema& schema);

}  // namespace sluice
