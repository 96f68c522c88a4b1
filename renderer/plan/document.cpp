// SPDX-License-Identifier: MIT
#include "renderer/plan/document.h"

#include <yaml-cpp/yaml.h>

#include <algorithm>

#include "core/files/text.h"
#include "renderer/json/parse.h"

namespace minkray {
namespace {

/// Limit of extra values by aliases. Without aliases each value takes at least one byte; with them,
/// a few lines can make billions of values.
constexpr std::size_t most_values_of_aliases = 100'000;

/// Reads plain scalars by YAML 1.2's core schema; numbers that are not finite stay text.
Json scalar(const YAML::Node& node) {
  const std::string& text = node.Scalar();
  // Quoted text has the tag "!".
  if (node.Tag() == "!" || node.Tag() == "tag:yaml.org,2002:str") return text;
  if (text == "true" || text == "True" || text == "TRUE") return true;
  if (text == "false" || text == "False" || text == "FALSE") return false;
  if (text.empty() || text == "~" || text == "null" || text == "Null" || text == "NULL")
    return nullptr;
  std::int64_t whole = 0;
  if (read_number(bare_number(text), whole)) return whole;
  if (const auto number = finite_number(bare_number(text))) return *number;
  return text;
}

class YamlReader {
 public:
  YamlReader(Document& document, std::size_t bytes, Mistakes& mistakes)
      : document_(document), most_values_(bytes + most_values_of_aliases), mistakes_(mistakes) {}

  Json value(const YAML::Node& node, const JsonPath& path, std::size_t depth) {
    if (++count_ > most_values_ || depth > deepest_json_nesting) {
      if (!is_full_)
        mistakes_.add(count_ > most_values_ ? "must have fewer values"
                                            : "must not be nested more deeply than 256 levels");
      is_full_ = true;
      return nullptr;
    }
    if (is_full_) return nullptr;
    document_.lines.emplace(path.text(), line_of(node));
    switch (node.Type()) {
      case YAML::NodeType::Scalar:
        return scalar(node);
      case YAML::NodeType::Sequence: {
        Json list = Json::array();
        std::size_t index = 0;
        for (const YAML::Node& item : node) list.push_back(value(item, path / index++, depth + 1));
        return list;
      }
      case YAML::NodeType::Map:
        return map(node, path, depth);
      default:
        return nullptr;
    }
  }

 private:
  static std::size_t line_of(const YAML::Node& node) {
    return static_cast<std::size_t>(std::max(node.Mark().line, 0)) + 1;
  }

  Json map(const YAML::Node& node, const JsonPath& path, std::size_t depth) {
    Json object = Json::object();
    for (const auto& member : node) {
      if (is_full_) break;
      if (!member.first.IsScalar()) {
        mistakes_.add("line " + std::to_string(line_of(member.first)) + ": keys must be text");
        continue;
      }
      const std::string key = member.first.Scalar();
      Json read = value(member.second, path / key, depth + 1);
      if (object.contains(key))
        mistakes_.add("line " + std::to_string(line_of(member.first)) + ": duplicate key \"" +
                      printable(key, 60) + "\"");
      else
        object.add_new_member(key, std::move(read));
    }
    return object;
  }

  Document& document_;
  const std::size_t most_values_;
  Mistakes& mistakes_;
  std::size_t count_ = 0;
  bool is_full_ = false;
};

/// Returns the document of a text that is not empty; null if there is not exactly one.
YAML::Node only_document(const std::string& text, Mistakes& mistakes) {
  YAML::Node only;
  std::size_t count = 0;
  for (const YAML::Node& node : YAML::LoadAll(text))
    if (!node.IsNull() && count++ == 0) only.reset(node);
  if (count == 0) mistakes.add("must have a document (the file is empty)");
  if (count > 1)
    mistakes.add("must have one document (got " + std::to_string(count) + ", divided by ---)");
  return only;
}

std::optional<Document> yaml_document(const std::string& text, const std::string& file,
                                      Mistakes& mistakes) {
  Document document{file, {}};
  const std::size_t before = mistakes.messages().size();
  try {
    const YAML::Node node = only_document(text, mistakes);
    if (mistakes.messages().size() == before)
      document.json = YamlReader(document, text.size(), mistakes).value(node, {}, 0);
  } catch (const YAML::Exception& error) {
    mistakes.add("line " + std::to_string(std::max(error.mark.line, 0) + 1) +
                 ": not valid YAML: " + printable(error.msg, 200));
  }
  if (mistakes.messages().size() != before) return std::nullopt;
  return document;
}

/// Parses JSON as YAML, which agrees but for escapes, to find the lines.
std::unordered_map<std::string, std::size_t> lines_of(const Document& document) {
  if (!document.lines.empty() || document.text.find('\n') == std::string::npos)
    return document.lines;
  Mistakes ignored("");
  std::optional<Document> again = yaml_document(document.text, document.file, ignored);
  if (!again) return {};
  return std::move(again->lines);
}

std::size_t line_of(const std::unordered_map<std::string, std::size_t>& lines, std::string path) {
  for (;;) {
    if (const auto at = lines.find(path); at != lines.end()) return at->second;
    const std::size_t slash = path.rfind('/');
    if (slash == path.npos || slash == 0) return 0;
    path.erase(slash);
  }
}

}  // namespace

std::optional<Document> parse_document(const std::string& text, const std::string& file,
                                       Mistakes& mistakes) {
  const std::size_t begin = text.find_first_not_of(" \t\r\n");
  const bool is_json = begin != text.npos && (text[begin] == '{' || text[begin] == '[');
  Mistakes of_json(file);
  if (is_json)
    if (std::optional<Json> json = parse_json(text, of_json); json && of_json.none())
      return Document{file, std::move(*json), text};
  // YAML may begin with lists and objects in brackets, too; if it is not valid either, the mistakes
  // are those of the JSON.
  Mistakes of_yaml(file);
  std::optional<Document> document = yaml_document(text, file, of_yaml);
  if (!document) {
    const std::vector<std::string>& messages = is_json ? of_json.messages() : of_yaml.messages();
    for (const std::string& message : messages) mistakes.add(message.substr(file.size() + 2));
  }
  return document;
}

std::optional<Document> read_document(const std::filesystem::path& file, Mistakes& mistakes) {
  const auto text = read_text_file(file, mistakes);
  if (!text) return std::nullopt;
  return parse_document(*text, file.string(), mistakes);
}

void with_lines(const Document& document, Mistakes& mistakes,
                const std::function<void(Mistakes&)>& read) {
  Mistakes found("");
  read(found);
  if (found.none()) return;
  const std::unordered_map<std::string, std::size_t> lines = lines_of(document);
  // Messages on one line, such as JSON sent through a pipe, need no line numbers.
  const bool has_lines =
      std::ranges::any_of(lines, [](const auto& value) { return value.second > 1; });
  // Each message is ": PATH: TEXT", or ": TEXT" for the document as a whole.
  for (const std::string& message : found.messages()) {
    const std::string rest = message.substr(2);
    std::size_t line = 0;
    if (has_lines && rest.starts_with('/')) line = line_of(lines, rest.substr(0, rest.find(": ")));
    mistakes.add((line > 0 ? "line " + std::to_string(line) + ": " : "") + rest);
  }
}

}  // namespace minkray
