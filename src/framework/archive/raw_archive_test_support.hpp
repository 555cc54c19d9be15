// Small archives in Uintah's raw layout, for tests: in either byte order, gzip or not. Numbers have
// no unit.
#pragma once
#include <zlib.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <vector>

#include "framework/archive/xml_text.hpp"
#include "framework/grid/index_box.hpp"

namespace sluice::raw_test {

namespace fs = std::filesystem;

struct Patch {
  int id = 0, rank = 0;
  IndexBox interior, outer;
};

struct Level {
  Vec3 anchor{}, spacing{1, 1, 1};
  IntVec3 periodic{};
  std::vector<Patch> patches;
};

// Patches over `domain`, whose sides have `extra` cells around them.
inline Level make_level(const IndexBox& domain, IntVec3 pieces, IntVec3 extra, Vec3 spacing,
                        int first_id = 0) {
  Level level;
  level.spacing = spacing;
  const IntVec3 n = domain.size();
  for (int i = 0; i < pieces.x; ++i)
    for (int j = 0; j < pieces.y; ++j)
      for (int k = 0; k < pieces.z; ++k) {
        Patch p;
        p.id = first_id + static_cast<int>(level.patches.size());
        p.interior = {
            domain.lower + IntVec3{n.x * i / pieces.x, n.y * j / pieces.y, n.z * k / pieces.z},
            domain.lower + IntVec3{n.x * (i + 1) / pieces.x, n.y * (j + 1) / pieces.y,
                                   n.z * (k + 1) / pieces.z}};
        p.outer = p.interior;
        for (int d = 0; d < 3; ++d) {
          p.outer.lower[d] -= p.interior.lower[d] == domain.lower[d] ? extra[d] : 0;
          p.outer.upper[d] += p.interior.upper[d] == domain.upper[d] ? extra[d] : 0;
        }
        level.patches.push_back(p);
      }
  return level;
}

// What stands in the file of a rank: values by index and component, x fastest, or by particle.
struct Variable {
  std::string name, type;  // press_CC, CCVariable<double>
  int material = 0;
  std::function<double(IntVec3, int)> value = {};         // of cells, nodes, faces
  std::function<int(const Patch&)> particles = {};        // how many
  std::function<double(const Patch&, int, int)> of = {};  // particle, component
  std::string more = {};                                  // further XML of each block
};

class Writer {
 public:
  explicit Writer(const fs::path& folder) : folder_(folder) { fs::create_directories(folder); }

  bool big_endian = false, gzip = false;
  std::string head = "<outputFormat>UDA</outputFormat>";  // of index.xml
  std::string tail;                                       // likewise

  void add_step(int step, double time, const std::vector<Level>& levels,
                const std::vector<Variable>& variables) {
    const fs::path folder = folder_ / step_name(step);
    fs::create_directories(folder);
    std::string data;
    for (std::size_t l = 0; l < levels.size(); ++l) {
      int ranks = 1;
      for (const Patch& p : levels[l].patches) ranks = std::max(ranks, p.rank + 1);
      fs::create_directories(folder / ("l" + std::to_string(l)));
      for (int rank = 0; rank < ranks; ++rank) {
        const std::string name = "l" + std::to_string(l) + "/p0000" + std::to_string(rank);
        write_files(folder / name, levels[l], rank, variables);
        data += "<Datafile href=\"" + name + ".xml\" proc=\"" + std::to_string(rank) + "\"/>\n";
      }
    }
    std::ofstream(folder / "timestep.xml")
        << "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<Uintah_timestep>" << meta()
        << "<Time><timestepNumber>" << step << "</timestepNumber><currentTime>" << real_text(time)
        << "</currentTime><oldDelt>0.5</oldDelt></Time>" << grid_xml(levels) << "<Data>" << data
        << "</Data></Uintah_timestep>\n";
    for (const Variable& v : variables)
      if (names_.find("\"" + v.name + "\"") == std::string::npos)
        names_ += "<variable type=\"" + escaped(v.type) + "\" name=\"" + v.name + "\"/>\n";
    steps_ += "<timestep href=\"" + step_name(step) + "/timestep.xml\" time=\"" + real_text(time) +
              "\" oldDelt=\"0.5\">" + std::to_string(step) + "</timestep>\n";
  }
  void add_reference(int step, double time, const std::string& href) {
    steps_ += "<timestep href=\"" + href + "\" time=\"" + real_text(time) + "\">" +
              std::to_string(step) + "</timestep>\n";
  }
  void write_index() const {
    std::ofstream(folder_ / "index.xml")
        << "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<Uintah_DataArchive>\n"
        << "<numberOfProcessors>1</numberOfProcessors>" << head << meta() << "<variables>" << names_
        << "</variables>\n<timesteps>" << steps_ << "</timesteps>" << tail
        << "</Uintah_DataArchive>\n";
  }
  const fs::path& folder() const { return folder_; }
  static std::string step_name(int step) {
    std::string number = std::to_string(step);
    return "t" + std::string(5 - number.size(), '0') + number;
  }
  std::string grid_xml(const std::vector<Level>& levels) const {
    std::string text = "<Grid><numLevels>" + std::to_string(levels.size()) + "</numLevels>";
    for (std::size_t l = 0; l < levels.size(); ++l) {
      const Level& level = levels[l];
      text += "<Level><anchor>" + triple_text(level.anchor) + "</anchor><id>" + std::to_string(l) +
              "</id><cellspacing>" + triple_text(level.spacing) + "</cellspacing><periodic>" +
              triple_text(level.periodic) + "</periodic>";
      for (const Patch& p : level.patches)
        text += "<Patch><id>" + std::to_string(p.id) + "</id><proc>" + std::to_string(p.rank) +
                "</proc><lowIndex>" + triple_text(p.outer.lower) + "</lowIndex><highIndex>" +
                triple_text(p.outer.upper) + "</highIndex><interiorLowIndex>" +
                triple_text(p.interior.lower) + "</interiorLowIndex><interiorHighIndex>" +
                triple_text(p.interior.upper) + "</interiorHighIndex></Patch>\n";
      text += "</Level>";
    }
    return text + "</Grid>";
  }

  template <class T>
  void put(std::string& bytes, T value) const {
    char own[sizeof(T)];
    std::memcpy(own, &value, sizeof(T));
    if (big_endian) std::reverse(own, own + sizeof(T));
    bytes.append(own, sizeof(T));
  }

 private:
  std::string meta() const {
    return std::string("<Meta><endianness>") + (big_endian ? "big" : "little") +
           "_endian</endianness><nBits>64</nBits></Meta>";
  }
  static std::string escaped(const std::string& type) {
    const std::size_t angle = type.find('<');
    return type.substr(0, angle) + "&lt;" + type.substr(angle + 1, type.size() - angle - 2) +
           "&gt;";
  }
  static int components(const std::string& type) {
    if (type.find("Matrix3") != type.npos) return 9;
    const bool three = type.find("Vector>") != type.npos || type.find("Point>") != type.npos;
    return three ? 3 : 1;
  }
  void put_as(const std::string& type, std::string& bytes, double value) const {
    if (type.find("<float>") != type.npos) return put(bytes, static_cast<float>(value));
    if (type.find("<int>") != type.npos) return put(bytes, static_cast<std::int32_t>(value));
    if (type.find("<long64>") != type.npos) return put(bytes, static_cast<std::int64_t>(value));
    put(bytes, value);
  }
  // Faces and nodes have one more layer on the high sides that no patch follows.
  static IndexBox window(const Level& level, const Patch& p, const std::string& type) {
    IndexBox box = p.outer;
    for (int d = 0; d < 3; ++d) {
      const bool closes = type.starts_with("NC") || type.starts_with(std::string("SFC") + "XYZ"[d]);
      bool followed = false;
      for (const Patch& q : level.patches) {
        IndexBox beyond = p.interior;
        beyond.lower[d] = p.interior.upper[d];
        beyond.upper[d] = beyond.lower[d] + 1;
        IndexBox image = beyond;
        if (level.periodic[d] != 0) {
          image.lower[d] = level.patches.front().interior.lower[d];
          image.upper[d] = image.lower[d] + 1;
        }
        followed = followed || !intersection(q.interior, beyond).empty() ||
                   !intersection(q.interior, image).empty();
      }
      if (closes && !followed) ++box.upper[d];
    }
    return box;
  }
  std::string block(const Level& level, const Patch& p, const Variable& v) const {
    std::string bytes;
    const int n = components(v.type);
    if (v.particles)
      for (int i = 0; i < v.particles(p); ++i)
        for (int c = 0; c < n; ++c) put_as(v.type, bytes, v.of(p, i, c));
    else
      for_each_cell(window(level, p, v.type), [&](IntVec3 index) {
        for (int c = 0; c < n; ++c) put_as(v.type, bytes, v.value(index, c));
      });
    if (!gzip) return bytes;
    uLongf size = compressBound(bytes.size());
    std::string zipped(size, '\0'), all;
    compress(reinterpret_cast<Bytef*>(zipped.data()), &size,
             reinterpret_cast<const Bytef*>(bytes.data()), bytes.size());
    put(all, static_cast<std::uint64_t>(bytes.size()));
    return all + zipped.substr(0, size);
  }
  // Each block begins at a multiple of 1024 bytes.
  void write_files(const fs::path& name, const Level& level, int rank,
                   const std::vector<Variable>& variables) const {
    std::string bytes, xml = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<Uintah_Output>\n";
    for (const Variable& v : variables)
      for (const Patch& p : level.patches) {
        if (p.rank != rank) continue;
        bytes.resize((bytes.size() + 1023) / 1024 * 1024);
        const std::size_t start = bytes.size();
        bytes += block(level, p, v);
        xml += "<Variable type=\"" + escaped(v.type) + "\"><variable>" + v.name +
               "</variable><index>" + std::to_string(v.material) + "</index><patch>" +
               std::to_string(p.id) + "</patch>" + v.more + "<start>" + std::to_string(start) +
               "</start>";
        if (v.particles)
          xml += "<numParticles>" + std::to_string(v.particles(p)) + "</numParticles>";
        if (gzip) xml += "<compression>gzip</compression>";
        xml += "<end>" + std::to_string(bytes.size()) + "</end><filename>" +
               name.filename().string() + ".data</filename></Variable>\n";
      }
    std::ofstream(name.string() + ".xml") << xml << "</Uintah_Output>\n";
    std::ofstream(name.string() + ".data", std::ios::binary) << bytes;
  }

  fs::path folder_;
  std::string names_, steps_;
};

}  // namespace sluice::raw_test
