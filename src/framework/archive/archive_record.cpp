// index.xml and pNNNNN.xml to and from their records.
#include "framework/archive/archive_record.hpp"

#include <fmt/format.h>

#include <array>

#include "framework/archive/particle_table.hpp"

namespace sluice {
namespace {

// The first four are those that HDF5 files hold.
constexpr std::array<std::string_view, 6> stored_names = {"float64", "float32", "int32",
                                                          "int64",   "int16",   "uint8"};
constexpr std::array<std::string_view, 7> kind_names = {
    "CCVariable",   "NCVariable",       "SFCXVariable",     "SFCYVariable",
    "SFCZVariable", "ParticleVariable", "ReductionVariable"};
constexpr std::array<std::string_view, 5> value_names = {"double", "Vector", "int", "long64",
                                                         "Matrix3"};
// What positions are called; archives of before call them vectors.
constexpr std::string_view point = "Point";

// The place of `text` in a list of names.
template <class E, std::size_t N>
E find_name(const std::array<std::string_view, N>& names, std::string_view text,
            const std::string& context) {
  for (std::size_t n = 0; n < N; ++n)
    if (names[n] == text) return static_cast<E>(n);
  throw DamageError(fmt::format("{}: unknown name '{}'", context, text));
}

void parse_type(std::string_view text, const std::string& context, ValueType& type,
                Centring& centring) {
  const std::size_t angle = text.find('<');
  if (angle == text.npos || text.back() != '>')
    throw DamageError(fmt::format("{}: '{}' is not a variable type", context, text));
  centring = find_name<Centring>(kind_names, text.substr(0, angle), context);
  const std::string_view value = text.substr(angle + 1, text.size() - angle - 2);
  type = value == point ? ValueType::vector : find_name<ValueType>(value_names, value, context);
}

// Of a VariableEntry or a StoredVariable.
template <class Variable>
std::string type_of(const Variable& v) {
  const bool is_position = v.centring == Centring::particle && v.name == particle_position_name;
  if (is_position) return fmt::format("ParticleVariable<{}>", point);
  return type_text(v.type, v.centring);
}

int attribute_int(const XmlElement& e, const char* name, const std::string& context) {
  return parse_int(e.need_attribute(name, context), context);
}

}  // namespace

std::string StoredVariable::group() const {
  return fmt::format("/l{}/{}/m{}", level, name, material);
}

void require_referenced_archive(const StepEntry& step, const std::filesystem::path& archive) {
  namespace fs = std::filesystem;
  std::error_code error;
  const fs::path parent = (archive / step.href).parent_path().parent_path().lexically_normal();
  if (parent == archive.lexically_normal() || fs::exists(parent / "index.xml", error)) return;
  throw InputError(fmt::format(
      "{}: step {} is in the archive {}, which this run continues and which is missing\n  restore "
      "it there; a restart with --copy makes archives that need no other",
      archive.string(), step.step, parent.string()));
}

std::string step_folder_name(int step) {
  return fmt::format("t{:05}", step);
}
std::string_view name_of(StoredType t) {
  return stored_names[static_cast<std::size_t>(t)];
}
std::size_t size_of(StoredType t) {
  constexpr std::array<std::size_t, 6> bytes = {8, 4, 4, 8, 2, 1};
  return bytes[static_cast<std::size_t>(t)];
}
std::string type_text(ValueType type, Centring centring) {
  return fmt::format("{}<{}>", kind_names[static_cast<std::size_t>(centring)],
                     value_names[static_cast<std::size_t>(type)]);
}

XmlElement to_xml(const ArchiveIndex& index) {
  XmlElement root("Uintah_DataArchive");
  root.add("numberOfProcessors", std::to_string(index.ranks));
  root.add("outputFormat", "HDF5");
  XmlElement& meta = root.add("Meta");
  meta.add("program", index.program);
  meta.add("date", index.created);
  meta.add("endianness", "little_endian");
  meta.add("nBits", "64");
  XmlElement& restarts = root.add("restarts");
  for (const RestartEntry& r : index.restarts)
    restarts.add("restart").set("from", r.from).set("timestep", std::to_string(r.step));
  XmlElement& globals = root.add("globals");
  for (const HistoryEntry& h : index.histories)
    globals.add("variable").set("href", h.file).set("type", h.type).set("name", h.name);
  XmlElement& variables = root.add("variables");
  for (const VariableEntry& v : index.variables)
    variables.add("variable")
        .set("type", type_of(v))
        .set("name", v.name)
        .set("unit", v.unit)
        .set("numMaterials", std::to_string(v.materials));
  XmlElement& steps = root.add("timesteps");
  for (const StepEntry& s : index.steps)
    steps.add("timestep", std::to_string(s.step))
        .set("href", s.href.string())
        .set("time", real_text(s.time))
        .set("oldDelt", real_text(s.old_delt));
  return root;
}

ArchiveIndex parse_index(const XmlElement& root, const std::string& context) {
  if (root.name != "Uintah_DataArchive")
    throw InputError(
        fmt::format("{}: the root element is <{}>, not <Uintah_DataArchive>; is this "
                    "the index of an archive?",
                    context, root.name));
  const XmlElement* format = root.child("outputFormat");
  if (!format || format->text != "HDF5")
    throw InputError(fmt::format("{}: the archive's format is {}; Sluice knows HDF5 and UDA",
                                 context, format ? format->text : "not given"));
  ArchiveIndex index;
  index.ranks = parse_int(root.need("numberOfProcessors", context).text, context);
  const XmlElement& meta = root.need("Meta", context);
  if (const XmlElement* e = meta.child("program")) index.program = e->text;
  if (const XmlElement* e = meta.child("date")) index.created = e->text;
  if (const XmlElement* restarts = root.child("restarts"))
    for (const XmlElement& r : restarts->children)
      index.restarts.push_back(
          {r.need_attribute("from", context), attribute_int(r, "timestep", context)});
  if (const XmlElement* globals = root.child("globals"))
    for (const XmlElement& g : globals->children)
      index.histories.push_back({g.need_attribute("name", context),
                                 g.need_attribute("href", context),
                                 g.need_attribute("type", context)});
  for (const XmlElement& v : root.need("variables", context).children) {
    VariableEntry entry;
    entry.name = v.need_attribute("name", context);
    parse_type(v.need_attribute("type", context), context, entry.type, entry.centring);
    entry.unit = v.attribute("unit").value_or("");
    entry.materials = attribute_int(v, "numMaterials", context);
    entry.type_name = type_of(entry);
    index.variables.push_back(std::move(entry));
  }
  for (const XmlElement& s : root.need("timesteps", context).children)
    index.steps.push_back({parse_int(s.text, context),
                           parse_real(s.need_attribute("time", context), context),
                           parse_real(s.need_attribute("oldDelt", context), context),
                           s.need_attribute("href", context)});
  return index;
}

XmlElement to_xml(const DataFileRecord& record) {
  XmlElement root("Uintah_Output");
  root.add("Datafile")
      .set("href", record.href)
      .set("bytes", std::to_string(record.bytes))
      .set("metadataCrc32c", fmt::format("{:08x}", record.metadata_crc));
  for (const StoredVariable& v : record.variables)
    root.add("Variable")
        .set("type", type_of(v))
        .set("name", v.name)
        .set("unit", v.unit)
        .set("level", std::to_string(v.level))
        .set("material", std::to_string(v.material))
        .set("group", v.group())
        .set("stored", std::string(name_of(v.stored)))
        .set("compression", v.gzip ? "gzip" : "")
        .set("offset", std::to_string(v.offset))
        .set("bytes", std::to_string(v.bytes));
  return root;
}

DataFileRecord parse_data_file(const XmlElement& root, const std::string& context) {
  DataFileRecord record;
  const XmlElement& file = root.need("Datafile", context);
  record.href = file.need_attribute("href", context);
  record.bytes = parse_integer(file.need_attribute("bytes", context), context);
  const std::string crc = file.need_attribute("metadataCrc32c", context);
  record.metadata_crc = static_cast<std::uint32_t>(std::strtoul(crc.c_str(), nullptr, 16));
  for (const XmlElement& e : root.children) {
    if (e.name != "Variable") continue;
    StoredVariable v;
    v.name = e.need_attribute("name", context);
    parse_type(e.need_attribute("type", context), context, v.type, v.centring);
    v.unit = e.attribute("unit").value_or("");
    v.level = attribute_int(e, "level", context);
    v.material = attribute_int(e, "material", context);
    v.stored = find_name<StoredType>(stored_names, e.need_attribute("stored", context), context);
    if (v.stored > StoredType::int64)
      throw DamageError(fmt::format("{}: HDF5 files hold no {}", context, name_of(v.stored)));
    v.gzip = e.attribute("compression").value_or("") == "gzip";
    v.offset = parse_integer(e.need_attribute("offset", context), context);
    v.bytes = parse_integer(e.need_attribute("bytes", context), context);
    const bool inside =
        v.offset >= 0 && v.offset <= record.bytes && v.bytes <= record.bytes - v.offset;
    if (v.bytes < 0 || (!v.gzip && !inside))
      throw DamageError(fmt::format("{}: {} lies outside the data file", context, v.group()));
    record.variables.push_back(std::move(v));
  }
  return record;
}

}  // namespace sluice
