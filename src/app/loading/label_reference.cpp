// Writing the tables of labels.
#include "app/loading/label_reference.hpp"

#include <fmt/format.h>

#include <functional>

#include "app/loading/components.hpp"
#include "framework/field/label.hpp"

namespace sluice {
namespace {

constexpr const char* head = R"(# Labels

What `<save label="..."/>` in the `<DataArchiver>` of a deck may name: definition and unit of each.
This page is written by `sluice help --labels` from the table that the code itself uses. Vectors
have three components. Units are those of a deck in SI; nothing is converted. NAME stands for the
name of a scalar of the deck's models.
)";

bool is_state(Label label) {
  return label.name().rfind("state.", 0) == 0;
}

// A bar would end the column.
std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '|') out += '\\';
    out += c;
  }
  return out;
}

std::string table(const char* title, const char* text, const std::function<bool(Label)>& belongs) {
  std::string page = fmt::format(
      "\n## {}\n\n{}\n\n| label | value | place | unit | definition |\n"
      "| --- | --- | --- | --- | --- |\n",
      title, text);
  for (const Label label : all_labels()) {
    if (!belongs(label)) continue;
    const LabelInfo& l = label.info();
    page += fmt::format("| {} | {} | {} | {} | {} |\n", l.name, name_of(l.type),
                        name_of(l.centring), l.unit, escaped(l.definition));
  }
  return page;
}

}  // namespace

std::string label_reference() {
  declare_all_labels();
  std::string page = head;
  page += table("Cells", "Values at the centres of cells, after the step unless stated otherwise.",
                [](Label l) { return l.info().centring == Centring::cell && !is_state(l); });
  page += table("Faces",
                "Values on faces between cells: index i is the low face of cell i; the closing "
                "faces of the domain are stored too.",
                [](Label l) { return face_direction(l.info().centring) >= 0; });
  page += table("Nodes",
                "Values at the corners of cells: index i is the low corner of cell i; the closing "
                "nodes of the domain are stored too.",
                [](Label l) { return l.info().centring == Centring::node; });
  page += table("Histories",
                "One number (or vector) per step, written to a `.dat` file in the archive.",
                [](Label l) { return l.info().centring == Centring::reduction; });
  page += table("Particles",
                "Values of particles, in no particular order; positions and numbers are saved with "
                "any of them.",
                [](Label l) { return l.info().centring == Centring::particle; });
  page += table("Conserved state",
                "Content of checkpoints. These labels are not for `<save>`; they are listed "
                "because `sluice info` shows them.",
                is_state);
  return page;
}

}  // namespace sluice
