// SPDX-License-Identifier: MIT
#include "renderer/share/frames_record.h"

#include <filesystem>
#include <limits>
#include <span>
#include <utility>

#include "core/files/regular_file.h"
#include "renderer/base/errors.h"
#include "renderer/io/folder_lock.h"
#include "renderer/io/output_file.h"
#include "renderer/json/parse.h"

namespace minkray {
namespace {

constexpr std::size_t most_bytes = std::size_t{16} << 20;

struct Content {
  Facts facts;
  std::set<int> frames;
};

bool is_frame(const Json& json) {
  return json.is_number_unsigned() &&
         json.get<std::uint64_t>() <= std::uint64_t{std::numeric_limits<int>::max()};
}

/// Throws BadInput with the file's name.
Content read(const std::string& path) {
  const auto text = [&] {
    try {
      return read_regular_file(path, most_bytes);
    } catch (const std::runtime_error& error) {
      throw BadInput(path + ": " + error.what());
    }
  }();
  Mistakes mistakes(path);
  const std::optional<Json> json = parse_json(text, mistakes);
  const Json* facts = json ? json->find("facts") : nullptr;
  const Json* frames = json ? json->find("frames") : nullptr;
  if (facts == nullptr || !facts->is_object() || frames == nullptr || !frames->is_array())
    throw BadInput(path + ": not a record of frames");
  Content content;
  for (const auto& [name, value] : facts->members())
    if (value.is_string()) content.facts[name] = value.text();
  for (const Json& frame : *frames)
    if (is_frame(frame)) content.frames.insert(frame.get<int>());
  return content;
}

/// Lists the differences between the facts of two renders of frames; empty if there are none.
std::string differences(const Facts& found, const Facts& wanted) {
  std::vector<std::string> names = common_facts();
  names.insert(names.end(), {fact::rate, fact::exposure});
  return difference(found, wanted, names);
}

}  // namespace

FramesRecord::FramesRecord(std::string path, Facts facts, bool resume)
    : path_(std::move(path)), facts_(std::move(facts)) {
  std::error_code error;
  if (std::filesystem::exists(path_, error)) {
    Content found;
    try {
      found = read(path_);
    } catch (const BadInput& mistake) {
      const std::string what = mistake.what();
      if (resume) throw BadInput(what + "; remove it, or render without --resume");
      throw CannotWrite(what + "; the record of frames would replace it: move it away");
    }
    const std::string differs = differences(found.facts, facts_);
    if (resume && !differs.empty())
      throw BadInput(path_ + ": is the record of other frames: " + differs +
                     "; remove it, or render without --resume");
    if (differs.empty()) frames_ = std::move(found.frames);
  }
}

void FramesRecord::add(int frame) {
  frames_.insert(frame);
  const FolderLock lock(std::filesystem::path(path_).parent_path());
  try {
    Content found = read(path_);
    if (differences(found.facts, facts_).empty()) frames_.merge(found.frames);
  } catch (const BadInput&) {
    // Restores the file if it was removed.
  }
  write();
}

void FramesRecord::write() const {
  Json json = {{"facts", Json::object()}, {"frames", Json::array()}};
  for (const auto& [name, value] : facts_) json["facts"][name] = value;
  for (const int frame : frames_) json["frames"].push_back(frame);
  const std::string text = json.dump() + "\n";
  write_file(path_, text);
}

}  // namespace minkray
