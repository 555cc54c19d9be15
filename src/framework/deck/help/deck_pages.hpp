// The reference of all tags as Markdown: an index, a page for each block, a table for each law.
#pragma once
#include <string>
#include <vector>

#include "framework/deck/schema.hpp"

namespace sluice {

struct ReferencePage {
  std::string file;  // below the folder of the documentation; the index is the first
  std::string text;
};

std::vector<ReferencePage> reference_pages(const Schema& schema);

}  // namespace sluice
