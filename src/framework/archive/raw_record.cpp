// index.xml, timestep.xml and pNNNNN.xml of raw archives; old versions leave some elements out.
#include "framework/archive/raw_record.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>

#include "framework/archive/posix_file.hpp"

namespace sluice {
namespace fs = std::filesystem;
namespace {

struct ElementType {
  std::string_view name;
  ValueType type;
  StoredType stored;
};
constexpr std::array<ElementType, 11> element_types = {{
    {"double", ValueType::real, StoredType::float64},
    {"float", ValueType::real, StoredType::float32},
    {"int", ValueType::integer, StoredType::int32},
    {"short int", ValueType::integer, StoredType::int16},
    {"bool", ValueType::integer, StoredType::uint8},
    {"uchar", ValueType::integer, StoredType::uint8},
    {"long64", ValueType::long_integer, StoredType::int64},
    {"Point", ValueType::vector, StoredType::float64},
    {"Vector", ValueType::vector, StoredType::float64},
    {"IntVector", ValueType::vector, StoredType::int32},
    {"Matrix3", ValueType::tensor, StoredType::float64},
}};

// "CCVariable" and so on, as archives of Sluice name them too.
std::optional<Centring> parse_kind(std::string_view text) {
  for (int c = 0; c <= static_cast<int>(Centring::reduction); ++c) {
    const std::string name = type_text(ValueType::real, static_cast<Centring>(c));
    if (text == std::string_view(name).substr(0, name.find('<'))) return static_cast<Centring>(c);
  }
  // What all ranks share is stored like a sum over them.
  if (text == "SoleVariable") return Centring::reduction;
  return std::nullopt;
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
  while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
  return text;
}

// What <Meta> says of the bytes; what it leaves out stays as it was.
void parse_meta(const XmlElement* meta, bool& big_endian, int& word_bits,
                const std::string& context) {
  if (meta == nullptr) return;
  if (const XmlElement* order = meta->child("endianness")) {
    if (order->text != "little_endian" && order->text != "big_endian")
      throw DamageError(fmt::format("{}: '{}' is not a byte order (little_endian, big_endian)",
                                    context, order->text));
    big_endian = order->text == "big_endian";
  }
  if (const XmlElement* bits = meta->child("nBits")) {
    word_bits = parse_int(bits->text, context);
    if (word_bits != 32 && word_bits != 64)
      throw DamageError(fmt::format("{}: words of {} bits, not 32 or 64", context, word_bits));
  }
}

std::string text_of(const XmlElement& parent, const char* name) {
  const XmlElement* e = parent.child(name);
  return e == nullptr ? std::string() : e->text;
}

void parse_restarts(const XmlElement& parent, const std::string& context, ArchiveIndex& index) {
  for (const XmlElement& e : parent.children) {
    if (e.name == "restarts") parse_restarts(e, context, index);
    if (e.name == "restart")
      index.restarts.push_back({e.need_attribute("from", context),
                                parse_int(e.need_attribute("timestep", context), context)});
  }
}

VariableEntry parse_raw_variable(const XmlElement& e, const std::string& context) {
  VariableEntry v;
  v.name = e.need_attribute("name", context);
  v.type_name = e.need_attribute("type", context);
  v.materials = parse_int(e.attribute("numMaterials").value_or("1"), context);
  const std::optional<RawType> type = parse_raw_type(v.type_name);
  v.readable = type.has_value();
  if (type) {
    v.type = type->type;
    v.centring = type->centring;
  }
  return v;
}

double attribute_real(const XmlElement& e, const char* name, const std::string& context) {
  const auto text = e.attribute(name);
  return text ? parse_real(*text, context) : 0;
}

// A file beside timestep.xml that replaces one of its sections; none: nullopt.
std::optional<std::string> read_beside(const fs::path& timestep_xml, const char* name) {
  const fs::path path = timestep_xml.parent_path() / name;
  std::error_code error;
  if (!fs::exists(path, error)) return std::nullopt;
  return read_text(path);
}

// l0/p00000.xml, and global.xml.
RawDataFile parse_raw_file(const std::string& href, const fs::path& folder,
                           const std::string& context) {
  RawDataFile file;
  file.record = folder / href;
  if (fs::path(href).is_absolute() || href.find("..") != href.npos)
    throw DamageError(fmt::format("{}: the data file {} lies outside the step", context, href));
  const std::size_t slash = href.find('/');
  if (slash != href.npos && slash > 1 && href[0] == 'l') {
    file.level = parse_int(href.substr(1, slash - 1), context);
    if (file.level < 0) throw DamageError(fmt::format("{}: there is no level {}", context, href));
  }
  return file;
}

std::vector<RawLevel> read_grid(const fs::path& timestep_xml, const XmlElement& root,
                                bool big_endian) {
  const auto beside = read_beside(timestep_xml, "grid.xml");
  if (!beside)
    return parse_raw_grid(root.need("Grid", timestep_xml.string()), timestep_xml.string());
  const std::string context = (timestep_xml.parent_path() / "grid.xml").string();
  if (is_binary_grid(*beside)) return parse_binary_grid(*beside, big_endian, context);
  return parse_raw_grid(parse_xml(*beside, context), context);
}

std::vector<RawDataFile> read_data_files(const fs::path& timestep_xml, const XmlElement& root) {
  const auto beside = read_beside(timestep_xml, "data.xml");
  const std::string context =
      beside ? (timestep_xml.parent_path() / "data.xml").string() : timestep_xml.string();
  const XmlElement data = beside ? parse_xml(*beside, context) : root.need("Data", context);
  std::vector<RawDataFile> files;
  for (const XmlElement& e : data.children)
    if (e.name == "Datafile")
      files.push_back(
          parse_raw_file(e.need_attribute("href", context), timestep_xml.parent_path(), context));
  return files;
}

std::int64_t integer_of(const XmlElement& e, const char* name, const std::string& context) {
  return parse_integer(e.need(name, context).text, context);
}

std::optional<RawBlock> parse_raw_block(const XmlElement& e, const RawDataFile& file) {
  const std::string context = file.record.string();
  const std::optional<RawType> type = parse_raw_type(e.need_attribute("type", context));
  if (!type) return std::nullopt;
  RawBlock block;
  block.type = *type;
  block.variable = e.need("variable", context).text;
  block.level = file.level;
  block.material = parse_int(e.need("index", context).text, context);
  const XmlElement* patch = e.child("patch");
  block.patch = parse_int((patch ? *patch : e.need("region", context)).text, context);
  block.begin = integer_of(e, "start", context);
  block.end = integer_of(e, "end", context);
  block.gzip = text_of(e, "compression") == "gzip";
  if (e.child("numParticles")) block.particles = integer_of(e, "numParticles", context);
  if (e.child("boundaryLayer"))
    block.layers = parse_int_triple(e.need("boundaryLayer", context).text, context);
  block.file = file.record.parent_path() / fs::path(e.need("filename", context).text).filename();
  constexpr int most_layers = 1000;
  bool good = block.begin >= 0 && block.end >= block.begin && block.particles >= 0;
  for (int d = 0; d < 3; ++d) good = good && block.layers[d] >= 0 && block.layers[d] < most_layers;
  if (!good)
    throw DamageError(fmt::format("{}: {} of patch {} has bytes {} to {}, {} particles, {} layers",
                                  context, block.variable, block.patch, block.begin, block.end,
                                  block.particles, triple_text(block.layers)));
  return block;
}

}  // namespace

std::optional<RawType> parse_raw_type(std::string_view text) {
  const std::size_t angle = text.find('<');
  text = trimmed(text);
  if (angle == text.npos || text.empty() || text.back() != '>') return std::nullopt;
  const std::optional<Centring> centring = parse_kind(trimmed(text.substr(0, angle)));
  const std::string_view element = trimmed(text.substr(angle + 1, text.size() - angle - 2));
  const auto found = std::find_if(element_types.begin(), element_types.end(),
                                  [&](const ElementType& t) { return t.name == element; });
  if (!centring || found == element_types.end()) return std::nullopt;
  return RawType{*centring, found->type, found->stored};
}

bool is_raw_index(std::string_view text) {
  const bool of_archive = text.find("<Uintah_DataArchive") != text.npos;
  // An index of Sluice says HDF5 and ends with a checksum, also when it is damaged elsewhere.
  const bool own = text.find("crc32c") != text.npos;
  const std::size_t format = text.find("<outputFormat>");
  const bool raw = format == text.npos || text.substr(format + 14, 4) == "UDA<";
  return of_archive && !own && raw;
}

ArchiveIndex parse_raw_index(const XmlElement& root, const std::string& context) {
  ArchiveIndex index;
  ArchiveStorage& storage = index.storage;
  storage.format = ArchiveFormat::raw;
  const XmlElement* meta = root.child("Meta");
  parse_meta(meta, storage.big_endian, storage.word_bits, context);
  if (const std::string name = text_of(root, "ParticlePosition"); !name.empty())
    storage.position_name = name;
  if (const XmlElement* ranks = root.child("numberOfProcessors"))
    index.ranks = parse_int(ranks->text, context);
  index.program = "Uintah";
  index.created = meta == nullptr ? "" : text_of(*meta, "date");
  parse_restarts(root, context, index);
  if (const XmlElement* globals = root.child("globals"))
    for (const XmlElement& g : globals->children)
      if (const auto file = g.attribute("href"))
        index.histories.push_back(
            {g.need_attribute("name", context), *file, g.attribute("type").value_or(""), ""});
  if (const XmlElement* variables = root.child("variables"))
    for (const XmlElement& v : variables->children)
      if (v.name == "variable") index.variables.push_back(parse_raw_variable(v, context));
  if (const XmlElement* steps = root.child("timesteps"))
    for (const XmlElement& s : steps->children)
      if (s.name == "timestep")
        index.steps.push_back(
            {parse_int(s.text, context), parse_real(s.need_attribute("time", context), context),
             attribute_real(s, "oldDelt", context), s.need_attribute("href", context)});
  return index;
}

RawStepRecord read_raw_step(const fs::path& timestep_xml, const ArchiveStorage& storage) {
  const std::string context = timestep_xml.string();
  const XmlElement root = parse_xml(read_text(timestep_xml), context);
  RawStepRecord record;
  record.big_endian = storage.big_endian;
  record.word_bits = storage.word_bits;
  const XmlElement* meta = root.child("Meta");
  parse_meta(meta, record.big_endian, record.word_bits, context);
  StepRecord& step = record.step;
  if (meta != nullptr && meta->child("numProcs"))
    step.ranks = parse_int(meta->child("numProcs")->text, context);
  const XmlElement& time = root.need("Time", context);
  step.info.step = parse_int(time.need("timestepNumber", context).text, context);
  step.info.time = parse_real(time.need("currentTime", context).text, context);
  if (const XmlElement* delt = time.child("oldDelt"))
    step.info.old_delt = parse_real(delt->text, context);
  record.levels = read_grid(timestep_xml, root, record.big_endian);
  for (const RawLevel& raw : record.levels) {
    step.grid.levels.push_back(raw.level);
    step.level_ids.push_back(raw.id);
    std::vector<PatchRecord>& patches = step.patches.emplace_back();
    for (const RawPatch& p : raw.patches) patches.push_back({p.id, p.interior, p.outer});
  }
  record.files = read_data_files(timestep_xml, root);
  for (const RawDataFile& file : record.files) {
    if (file.level >= static_cast<int>(record.levels.size()))
      throw DamageError(fmt::format("{}: {} is of level {}, which the grid does not have", context,
                                    file.record.string(), file.level));
    step.data_files.push_back(file.record.string());
  }
  return record;
}

std::vector<RawBlock> read_raw_blocks(const RawDataFile& file) {
  std::vector<RawBlock> blocks;
  const XmlElement root = parse_xml(read_text(file.record), file.record.string());
  std::set<std::string> zipped;
  for (const XmlElement& e : root.children) {
    if (e.name != "Variable") continue;
    std::optional<RawBlock> block = parse_raw_block(e, file);
    if (!block) continue;
    // Old archives do not say it of blocks that are empty but for the length of what is zipped.
    if (block->gzip) zipped.insert(block->variable);
    block->gzip = block->gzip || (block->particles == 0 && zipped.contains(block->variable) &&
                                  block->type.centring == Centring::particle);
    blocks.push_back(std::move(*block));
  }
  return blocks;
}

}  // namespace sluice
