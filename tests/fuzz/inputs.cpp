// SPDX-License-Identifier: MIT
#include "tests/fuzz/inputs.h"

#include "renderer/import/mesh/gltf_text.h"
#include "renderer/json/json.h"

namespace minkray::fuzz {
namespace {

/// A text is the list of its lines, anything else a string of base64.
std::string unpacked(const Json& item) {
  if (item.is_string()) return from_base64(item.text()).value();
  std::string text;
  for (const Json& line : item) text += (&line == item.begin() ? "" : "\n") + line.text();
  return text;
}

}  // namespace

std::vector<SourceFile> kept_inputs(const std::string& target, const std::string& kind) {
  const std::string file = "tests/fuzz/inputs/" + target + ".json";
  const Json packed = Json::parse(text_of_file(source_folder() / file));
  std::vector<SourceFile> inputs;
  for (const auto& [name, item] : packed.at(kind).members())
    inputs.push_back({file + ": " + kind + "/" + name, unpacked(item)});
  return inputs;
}

}  // namespace minkray::fuzz
