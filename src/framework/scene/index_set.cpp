// Index sets of decks: "0, 2-4, -1"; empty means everything.
#include "framework/scene/index_set.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "framework/base/error.hpp"

namespace sluice {

bool IndexSet::contains(int index, int count) const {
  return all() || std::any_of(intervals_.begin(), intervals_.end(), [&](IndexInterval i) {
           return (i.low <= index && index <= i.high) ||
                  (i.low <= index - count && index - count <= i.high);
         });
}

IndexSet read_index_set(std::string_view text) {
  ParsedValue<std::vector<IndexInterval>> parsed = parse_index_set(text);
  if (!parsed)
    throw InputError(
        fmt::format("index set {}: {}; write it like \"0, 2-4, -1\", or leave it empty for all",
                    in_quotes(text), parsed.problem));
  return IndexSet(std::move(*parsed.value));
}

}  // namespace sluice
