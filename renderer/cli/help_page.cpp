// SPDX-License-Identifier: MIT
#include "renderer/cli/help_page.h"
#include "core/files/text.h"

#include <algorithm>
#include <sstream>
#include <utility>
#include <vector>

namespace minkray {
namespace {

constexpr std::size_t columns = 80, doc_column = 26;

/// Formats the text after a label, in lines that begin in the same column. Each line of the text
/// begins a new line. Words longer than a line are not broken.
std::string entry(const std::string& label, const std::string& text, std::size_t column) {
  std::string page, line = "  " + label;
  const auto begin_line = [&] {
    page += line + "\n";
    line.assign(column, ' ');
  };
  if (line.size() + 1 > column) begin_line();
  line.resize(column, ' ');
  std::istringstream lines(text);
  bool is_first = true;
  for (std::string of_text; std::getline(lines, of_text);) {
    if (!std::exchange(is_first, false)) begin_line();
    std::istringstream words(of_text);
    for (std::string word; words >> word;) {
      const bool is_begin = line.find_first_not_of(' ', column) == line.npos;
      if (!is_begin && line.size() + 1 + word.size() > columns) begin_line();
      line += (line.size() > column ? " " : "") + word;
    }
  }
  page += line;
  while (!page.empty() && page.back() == ' ') page.pop_back();
  return page + "\n";
}

std::string label_of(const OptionDescription& option) {
  std::string label = option.flags.empty() ? option.place : listed(option.flags, {}, ",");
  if (option.is_value_optional) return label + " [=" + listed(option.choices, {}, "|") + "]";
  if (!option.value.empty()) label += " " + option.value;
  return label + (option.is_repeated ? " ..." : "");
}

}  // namespace

std::string help_page(const VerbDescription& verb) {
  std::string usage = "Usage: minkray " + verb.name + " [OPTIONS]";
  std::vector<std::string> groups;
  for (const OptionDescription& option : verb.options) {
    if (option.flags.empty())
      usage += (option.is_required ? " " : " [") + option.place + (option.is_required ? "" : "]") +
               (option.is_repeated ? "..." : "");
    const std::string group = option.flags.empty() ? "Positionals" : option.group;
    if (std::ranges::find(groups, group) == groups.end()) groups.push_back(group);
  }
  // Positional arguments come first, then the most common options.
  std::ranges::stable_sort(groups, {}, [](const std::string& group) {
    return group == "Positionals" ? 0 : group == "Options" ? 1 : group == research_group ? 3 : 2;
  });
  std::string page = verb.doc + "\n" + usage + "\n";
  for (const std::string& group : groups) {
    page += "\n" + group + ":\n";
    for (const OptionDescription& option : verb.options)
      if ((option.flags.empty() ? "Positionals" : option.group) == group)
        page += entry(label_of(option), whole_doc(option), doc_column);
  }
  page += "\nExamples:\n";
  for (const std::string& example : verb.examples) page += "  " + example + "\n";
  if (!verb.exit_codes.empty()) page += "\n" + verb.exit_codes + "\n";
  return page;
}

std::string help_page(std::span<const VerbDescription> verbs, const std::string& doc,
                      const std::string& footer) {
  std::size_t longest = 0;
  for (const VerbDescription& verb : verbs) longest = std::max(longest, verb.name.size());
  const std::size_t column = longest + 4;
  std::string page = doc + "\nUsage: minkray COMMAND [OPTIONS]\n\nOptions:\n";
  page += entry("-h,--help", "Print this help; for a command: minkray help COMMAND", column + 2);
  page += entry("--version", "Print the version", column + 2);
  page += "\nSubcommands:\n";
  for (const VerbDescription& verb : verbs) page += entry(verb.name, verb.doc, column);
  return page + "\n" + footer + "\n";
}

std::string whole_doc(const OptionDescription& option) {
  std::vector<std::string> facts;
  if (option.is_required && !option.flags.empty()) facts.emplace_back("required");
  if (!option.range.empty()) facts.push_back(option.range);
  if (!option.default_value.empty()) facts.push_back("default " + option.default_value);
  const std::string together = listed(facts, {}, "; ");
  std::string doc = option.doc;
  if (!option.choices.empty() && doc.find('\n') == doc.npos && !option.is_value_optional) {
    doc += doc.empty() || doc.back() == '.' ? " " : ": ";
    doc += listed(option.choices);
  }
  if (together.empty()) return doc;
  const std::size_t end = std::min(doc.find('\n'), doc.size());
  std::string first = doc.substr(0, end);
  const bool begins_list = first.ends_with(':');
  if (begins_list) first.pop_back();
  return first + " (" + together + ")" + (begins_list ? ":" : "") + doc.substr(end);
}

}  // namespace minkray
