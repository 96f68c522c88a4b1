// SPDX-License-Identifier: MIT
// Documents changed by the mutators are still documents of the kind, and seldom the same.
#include <gtest/gtest.h>

#include <set>

#include "tests/fuzz/change/json_changes.h"
#include "tests/fuzz/change/xml_changes.h"
#include "tests/fuzz/inputs.h"

namespace minkray::fuzz {
namespace {

constexpr int draws = 200;

/// Changes the text again and again, as fuzzers do, and restarts when it has grown.
template <class Changes, class IsDocument>
void expect_documents(const std::string& text, Changes& changes, const IsDocument& is_document) {
  constexpr std::size_t longest = 16384;
  std::set<std::string> seen;
  std::string now = text;
  for (unsigned seed = 0; seed < draws; ++seed) {
    Choice choice(seed);
    const auto changed = changes.change(now, choice);
    if (!changed || changed->empty() || changed->size() > longest) {
      now = text;
      continue;
    }
    EXPECT_TRUE(is_document(*changed)) << *changed;
    seen.insert(*changed);
    now = seed % 10 == 0 ? text : *changed;
  }
  EXPECT_GT(seen.size(), draws / 2u) << text;
}

bool is_json(const std::string& text) {
  return !JsonValue::parse(text, nullptr, false).is_discarded();
}

bool is_xml(const std::string& text) {
  tinyxml2::XMLDocument document;
  return document.Parse(text.data(), text.size()) == tinyxml2::XML_SUCCESS;
}

const std::string binary_header = std::string("glTF\x02\0\0\0", 8);

std::string numbered(std::size_t number) {
  std::string bytes;
  for (std::size_t i = 0; i < 4; ++i) bytes += static_cast<char>(number >> 8 * i & 255);
  return bytes;
}

TEST(MutatorsOfStructure, json_stays_json) {
  JsonChanges changes{KnownJson({"radius", "sphere"})};
  for (const SourceFile& file : kept_inputs("scene", "corpus"))
    if (is_json(file.text) && file.text.find('{') != std::string::npos)
      expect_documents(file.text, changes, is_json);
}

TEST(MutatorsOfStructure, xml_stays_xml) {
  for (const char* kind : {"mjcf", "urdf", "sdf"}) {
    XmlChanges changes{KnownXml({"geom", "box"})};
    for (const SourceFile& file : kept_inputs(kind, "corpus"))
      expect_documents(file.text, changes, is_xml);
  }
}

TEST(MutatorsOfStructure, of_lines_one_is_changed) {
  JsonChanges changes{KnownJson({"radius"})};
  const std::string text = "{\"a\":1,\"b\":[1,2]}\nnot JSON\n{\"a\":2,\"b\":[3]}\n";
  int same_lines = 0, all_lines = 0;
  for (unsigned seed = 0; seed < draws; ++seed) {
    Choice choice(seed);
    const auto changed = changes.change(text, choice);
    if (!changed) continue;  // the line that is no JSON
    ++all_lines;
    if (changed->find("not JSON") != std::string::npos) ++same_lines;
  }
  EXPECT_GT(all_lines, draws / 2);
  EXPECT_GT(same_lines, all_lines / 2);
}

TEST(MutatorsOfStructure, the_lengths_in_a_binary_file_stay_right) {
  JsonChanges changes{KnownJson({"nodes"})};
  const std::string json = R"({"asset":{"version":"2.0"},"nodes":[{"mesh":0}]} )";
  const std::string rest = numbered(4) + std::string("BIN\0", 4) + "abcd";
  const std::string padded = json + std::string((4 - json.size() % 4) % 4, ' ');
  const std::string text = binary_header + numbered(20 + padded.size() + rest.size()) +
                           numbered(padded.size()) + "JSON" + padded + rest;
  for (unsigned seed = 0; seed < draws; ++seed) {
    Choice choice(seed);
    const auto changed = changes.change(text, choice);
    ASSERT_TRUE(changed.has_value());
    ASSERT_TRUE(changed->ends_with(rest));
    EXPECT_EQ(changed->substr(8, 4), numbered(changed->size()));
    EXPECT_EQ(changed->substr(12, 4), numbered(changed->size() - 20 - rest.size()));
    EXPECT_TRUE(is_json(changed->substr(20, changed->size() - 20 - rest.size())));
  }
}

TEST(MutatorsOfStructure, what_a_schema_describes_is_known) {
  KnownJson known({});
  known.learn_schema(JsonValue::parse(R"({"properties":{"shape":{"$ref":"#/$defs/shape"}},
    "$defs":{"shape":{"oneOf":[
      {"type":"object","properties":{"type":{"const":"ball"},"radius":{"type":"number"}}},
      {"type":"object","properties":{"type":{"const":"grown"},
                                     "shape":{"$ref":"#/$defs/shape"}}}]}}})"));
  std::set<std::string> kinds, keys;
  for (unsigned seed = 0; seed < draws; ++seed) {
    Choice choice(seed);
    const JsonValue shape = known.value("shape", choice);
    if (shape.is_object() && shape.contains("type")) kinds.insert(shape["type"]);
    keys.insert(known.key("shape", choice));
  }
  EXPECT_TRUE(kinds.contains("ball") && kinds.contains("grown"));
  EXPECT_TRUE(keys.contains("radius") && keys.contains("shape"));
}

}  // namespace
}  // namespace minkray::fuzz
