// SPDX-License-Identifier: MIT
#include "renderer/scene_json/scene_files.h"

#include <algorithm>

#include "core/files/regular_file.h"
#include "renderer/base/of_file.h"
#include "renderer/json/object_reader.h"
#include "renderer/json/parse.h"
#include "renderer/json/values.h"
#include "renderer/scene_json/scene_json.h"
#include "renderer/scene_json/version_one.h"

namespace minkray {
namespace {

namespace fs = std::filesystem;

/// One file under all its names, or the name itself where there is no such file.
fs::path identity_of(const fs::path& file) {
  std::error_code error;
  fs::path found = fs::canonical(file, error);
  return error ? file.lexically_normal() : found;
}

/// Returns the version of a file, or 0 and a mistake.
int version_of(const Json& json, Mistakes& mistakes) {
  ObjectReader file(json, JsonPath(), mistakes);
  const Json* version = file.require("version", "1 or 2");
  if (!version) return 0;
  for (int known = 1; known <= newest_scene_version; ++known)
    if (version->is_number() && version->get<double>() == known) return known;
  mistakes.add(file.path("version"), "must be 1 or 2 (" + found(*version) + ")");
  return 0;
}

}  // namespace

SceneFiles::SceneFiles(std::string_view text, fs::path folder, Mistakes& mistakes)
    : folder_(std::move(folder)), mistakes_(mistakes) {
  const std::string& shown = mistakes.file();
  chain_.push_back({identity_of(folder_ / fs::path(shown).filename()), shown});
  main_ = read(text, shown, {});
}

const SceneFile* SceneFiles::read(std::string_view text, const std::string& shown,
                                  const fs::path& relative_folder) {
  const Uncommented plain = without_comments(text);
  const std::size_t before = mistakes_.messages().size();
  auto json = parse_json(plain.text, mistakes_);
  if (!json) return nullptr;
  auto file = std::make_unique<SceneFile>();
  file->shown = shown;
  file->folder = relative_folder;
  file->json = std::move(*json);
  file->version = version_of(file->json, mistakes_);
  if (file->version == 1) {
    if (!plain.first_comment.empty())
      mistakes_.add(JsonPath(), "not valid JSON at line:column " + plain.first_comment +
                                    ": JSON has no comments; write \"version\": 2 for them");
    refuse_version_two(file->json, mistakes_);
  }
  if (file->version != 1) include_all(*file);
  // Nothing follows from a file that is no scene at all.
  if (!file->json.is_object() && mistakes_.messages().size() > before) return nullptr;
  files_.push_back(std::move(file));
  return files_.back().get();
}

void SceneFiles::include_all(SceneFile& file) {
  if (const Json* names = file.json.find("include")) {
    const JsonPath path = JsonPath() / "include";
    const auto add = [&](const Json& name, const JsonPath& at) {
      if (const SceneFile* included = include(file, name, at))
        file.included_by_file.push_back(included);
    };
    if (names->is_array())
      for (std::size_t i = 0; i < names->size(); ++i) add((*names)[i], path / i);
    else
      add(*names, path);
  }
  if (const Json* objects = file.json.find("objects"))
    include_in_groups(file, *objects, JsonPath() / "objects");
}

void SceneFiles::include_in_groups(SceneFile& file, const Json& objects, const JsonPath& path) {
  if (!objects.is_array()) return;
  for (std::size_t i = 0; i < objects.size(); ++i) {
    const Json& item = objects[i];
    if (!item.is_object()) continue;
    if (const Json* name = item.find("include")) include(file, *name, path / i / "include");
    if (const Json* inner = item.find("objects"))
      include_in_groups(file, *inner, path / i / "objects");
  }
}

const SceneFile* SceneFiles::include(SceneFile& file, const Json& name, const JsonPath& path) {
  if (!name.is_string() || name.text().empty()) {
    mistakes_.add(path, "must be a scene file's name, relative to this file (" + found(name) + ")");
    return nullptr;
  }
  const fs::path relative = (file.folder / name.text()).lexically_normal();
  const fs::path named = folder_ / relative, identity = identity_of(named);
  std::string shown = (fs::path(chain_.front().shown).parent_path() / relative).string();
  const auto again = std::ranges::find(chain_, identity, &Link::file);
  if (again != chain_.end()) {
    std::string chain;
    for (auto link = again; link != chain_.end(); ++link) chain += link->shown + " includes ";
    mistakes_.add(path, "must not lead back to a file that includes it (" +
                            printable(chain + again->shown, 400) + ")");
    return nullptr;
  }
  const auto known = known_.find(identity);
  if (known != known_.end()) return file.included[&name] = known->second;
  if (chain_.size() >= deepest_includes || files_.size() >= most_included_files) {
    mistakes_.add(path, "must not bring the number of included files above " +
                            std::to_string(most_included_files) + ", or their nesting above " +
                            std::to_string(deepest_includes));
    return nullptr;
  }
  std::string text;
  try {
    text = read_regular_file(named, most_json_bytes - bytes_);
  } catch (const std::exception& error) {
    mistakes_.add(path, printable(shown, 200) + ": " + what_of(error));
    return nullptr;
  }
  bytes_ += text.size();
  paths_.push_back(named);
  hash_.add(relative.string());
  hash_.add(text);
  const MistakesIn naming(mistakes_, shown);
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  if (first != text.npos && text[first] == '<') {
    mistakes_.add("must be a scene file (found XML: minkray import makes a scene of a robot)");
    return nullptr;
  }
  chain_.push_back({identity, shown});
  const SceneFile* const made = read(text, shown, relative.parent_path());
  chain_.pop_back();
  known_[identity] = made;
  return file.included[&name] = made;
}

void SceneFiles::add_to(Hash& hash) const {
  if (!paths_.empty()) hash.add(hash_.text());
}

}  // namespace minkray
