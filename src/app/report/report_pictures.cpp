#include "app/report/report_pictures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <iterator>

#include "app/command/archive_picture.hpp"
#include "framework/archive/samples.hpp"
#include "framework/base/error.hpp"
#include "framework/base/temporary_folder.hpp"

namespace sluice {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t in_one_picture = 6;
constexpr std::size_t most_samples = 48;

std::string bytes_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

ReportPicture draw(const std::string& title, PictureRequest request) {
  const TemporaryFolder folder(TemporaryFolder::Place::disk);
  const fs::path file = folder / "picture.png", said = folder / "said.txt";
  request.options.set("--output", {file.string()});
  request.options.set("--dpi", {"110"});
  ReportPicture picture{title, "", ""};
  try {
    if (draw_archives(request, PictureCommand::plot, said) == 0) picture.png = bytes_of(file);
  } catch (const Error& error) {
    picture.fault = error.what();
  }
  if (picture.png.empty() && picture.fault.empty()) picture.fault = bytes_of(said);
  return picture;
}

}  // namespace

std::vector<ReportPicture> field_pictures(const Archive& archive,
                                          const std::vector<std::string>& labels) {
  std::vector<ReportPicture> pictures;
  if (archive.outputs().empty()) return pictures;
  const auto add = [&](const StepEntry& step, const char* which) {
    PictureRequest request;
    request.archives = {archive.folder().string()};
    if (!labels.empty()) request.options.set("--var", labels);
    request.options.set("--time", {which});
    pictures.push_back(
        draw(fmt::format("{} output: step {}, t = {:.6g} s",
                         which == std::string("first") ? "First" : "Last", step.step, step.time),
             std::move(request)));
  };
  if (archive.outputs().size() > 1) add(archive.outputs().front(), "first");
  add(archive.outputs().back(), "last");
  return pictures;
}

std::vector<ReportPicture> history_pictures(const Archive& archive) {
  std::vector<std::string> names;
  for (const Sample& sample : find_samples(archive))
    if (sample.kind != "effects") names.push_back(sample.name);
  names.resize(std::min(names.size(), most_samples));
  std::vector<ReportPicture> pictures;
  for (std::size_t first = 0; first < names.size(); first += in_one_picture) {
    const std::size_t last = std::min(first + in_one_picture, names.size());
    const std::vector<std::string> these(names.begin() + static_cast<std::ptrdiff_t>(first),
                                         names.begin() + static_cast<std::ptrdiff_t>(last));
    PictureRequest request;
    request.archives = {archive.folder().string()};
    request.options.set("--history", these);
    pictures.push_back(draw(fmt::format("{}", fmt::join(these, ", ")), std::move(request)));
  }
  return pictures;
}

}  // namespace sluice
