// libFuzzer: no text in lists that users write may crash their readers; only Error may come out.
//
// The first byte chooses the list: a study, a hard case, regression cases, the small file beside a
// deck, a list of the public suite's tester, or a golden result.
#include <cstddef>
#include <cstdint>
#include <fstream>

#include "app/regress/golden.hpp"
#include "app/regress/regress_folder.hpp"
#include "app/regress/suite_list.hpp"
#include "app/stability/stability_case.hpp"
#include "app/study/study.hpp"
#include "framework/base/error.hpp"
#include "framework/base/temporary_folder.hpp"

namespace {

using namespace sluice;

// A folder with a deck, which lists may name.
struct Lists {
  TemporaryFolder folder;
  std::string deck = folder / "deck.ups";

  Lists() { write("deck.ups", "<Uintah_specification/>\n"); }
  std::string write(const std::string& name, std::string_view text) const {
    const std::string file = folder / name;
    std::ofstream(file, std::ios::binary | std::ios::trunc) << text;
    return file;
  }
};

void read(const Lists& lists, int kind, std::string_view text) {
  switch (kind) {
    case 0:
      points_of(read_study(lists.write("a.study", text)));
      return;
    case 1:
      points_of(read_stability_case(lists.write("a.stability", text)));
      return;
    case 2:
      read_regress_cases(lists.write("cases.json", text));
      return;
    case 3:
      lists.write("deck.json", text);
      read_regress_folder(lists.folder.path());
      return;
    case 4:
      read_suite_list(lists.write("tests.py", text));
      return;
    default:
      read_golden(lists.write("golden.csv", text));
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const Lists lists;
  if (size < 1) return 0;
  try {
    read(lists, data[0] % 6, {reinterpret_cast<const char*>(data + 1), size - 1});
  } catch (const Error&) {
    // A message to the user: what must come of a bad list.
  }
  for (const char* name : {"deck.json", "tests.py"})
    std::filesystem::remove(lists.folder.path() / name);
  return 0;
}
