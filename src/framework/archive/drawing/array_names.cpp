// Names from the deck in the archive: solids are numbered first, then fluids, in the deck's order.
#include "framework/archive/drawing/array_names.hpp"

#include <algorithm>
#include <set>

#include "framework/archive/posix_file.hpp"

namespace sluice {
namespace fs = std::filesystem;
namespace {

void add_names(const XmlElement& deck, const char* method, std::vector<std::string>& names) {
  for (const XmlElement& properties : deck.children) {
    if (properties.name != "MaterialProperties") continue;
    for (const XmlElement& of_method : properties.children) {
      if (of_method.name != method) continue;
      for (const XmlElement& material : of_method.children)
        if (material.name == "material") names.push_back(material.attribute("name").value_or(""));
    }
  }
}

std::vector<std::string> names_in(const fs::path& deck) {
  std::vector<std::string> names;
  std::error_code error;
  if (!fs::exists(deck, error)) return names;
  try {
    const XmlElement root = parse_xml(read_text(deck), deck.string());
    for (const char* method : {"MPM", "ICE"}) add_names(root, method, names);
  } catch (const Error&) {
    // A deck that cannot be read gives no names; the fields of the archive are there all the same.
  }
  return names;
}

}  // namespace

ArrayNames::ArrayNames(const Archive& archive) {
  // The deck of a switcher names the decks of its components, which have the materials.
  for (const char* deck : {"input.xml", "input_1.xml"})
    if (materials_.empty()) materials_ = names_in(archive.folder() / deck);
  const std::vector<std::string> all = materials_;
  for (std::string& name : materials_)
    if (std::count(all.begin(), all.end(), name) > 1) name.clear();
  for (const VariableEntry& v : archive.index().variables) several_[v.name] = v.materials > 1;
  if (archive.format() != ArchiveFormat::raw || archive.outputs().empty()) return;
  // The index of a raw archive need not tell.
  const ArchiveStep step = archive.read_output(archive.outputs().back());
  std::map<std::string, std::set<int>> found;
  for (const auto* fields : {&step.fields(), &step.particle_fields()})
    for (const FieldInfo& f : *fields) found[f.name].insert(f.material);
  for (const auto& [name, materials] : found)
    several_[name] = several_[name] || materials.size() > 1;
}

std::string ArrayNames::of(const std::string& label, int number) const {
  const auto it = several_.find(label);
  return it != several_.end() && it->second ? label + "_" + material(number) : label;
}

bool ArrayNames::named(int number) const {
  return number >= 0 && static_cast<std::size_t>(number) < materials_.size() &&
         !materials_[number].empty();
}

std::string ArrayNames::material(int number) const {
  return named(number) ? materials_[number] : std::to_string(number);
}

std::string ArrayNames::described(int number) const {
  return named(number) ? materials_[number] : "material " + std::to_string(number);
}

}  // namespace sluice
