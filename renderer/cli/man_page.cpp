// SPDX-License-Identifier: MIT
#include "renderer/cli/man_page.h"
#include "core/files/text.h"

namespace minkray {
namespace {

/// Escapes text for roff, in which backslashes and leading dots are commands and plain hyphens are
/// not minus signs.
std::string roff(const std::string& text) {
  std::string out;
  bool begins_line = true;
  for (const char c : text) {
    if (begins_line && (c == '.' || c == '\'')) out += "\\&";
    out += c == '\\' ? std::string("\\e") : c == '-' ? std::string("\\-") : std::string(1, c);
    begins_line = c == '\n';
  }
  return out;
}

/// Escapes text and keeps its line breaks.
std::string roff_lines(const std::string& text) {
  std::string out;
  for (const char c : roff(text)) out += c == '\n' ? std::string("\n.br\n") : std::string(1, c);
  return out;
}

std::string heading(const std::string& name) {
  return ".TH \"" + roff(name) + "\" 1 \"\" \"Minkray " MINKRAY_VERSION "\" \"Minkray\"\n";
}

std::string name_of(const OptionDescription& option) {
  if (option.flags.empty()) return option.place;
  return listed(option.flags);
}

std::string synopsis(const VerbDescription& verb) {
  std::string text = ".B minkray " + roff(verb.name) + "\n";
  for (const OptionDescription& option : verb.options)
    if (option.flags.empty())
      text += ".RI " + std::string(option.is_required ? "" : "[ ") + "\"" + roff(option.place) +
              "\"" + (option.is_repeated ? " ..." : "") + (option.is_required ? "" : " ]") + "\n";
  return text + "[\n.I options\n]\n";
}

std::string entry(const OptionDescription& option) {
  std::string text = ".TP\n.B " + roff(name_of(option)) + "\n";
  if (!option.value.empty() && !option.flags.empty()) {
    const std::string values =
        option.choices.empty() ? option.value : listed(option.choices, {}, "|");
    text = ".TP\n.BR \"" + roff(name_of(option)) + "\" \" " +
           roff(option.is_value_optional ? "[=" + values + "]" : values) + "\"\n";
  }
  return text + roff_lines(whole_doc(option)) + "\n";
}

constexpr const char* exit_status =
    ".SH EXIT STATUS\n"
    "0 done, 1 a comparison or certificate failed (verify: collision), 2 wrong usage, 3 bad\n"
    "scene or input, 4 could not write, 6 verify: undecided. Results go to standard output,\n"
    "everything else to standard error.\n";

}  // namespace

std::string man_page(const VerbDescription& verb) {
  const std::string name = "minkray-" + verb.name;
  std::string page = heading(name) + ".SH NAME\n" + roff(name) + " \\- " + roff(verb.doc) +
                     "\n.SH SYNOPSIS\n" + synopsis(verb) + ".SH OPTIONS\n";
  for (const OptionDescription& option : verb.options) page += entry(option);
  page += ".SH EXAMPLES\n";
  for (const std::string& example : verb.examples) page += ".PP\n.B " + roff(example) + "\n";
  return page + exit_status + ".SH SEE ALSO\n.BR minkray (1)\n";
}

std::string man_page(std::span<const VerbDescription> verbs) {
  std::string page = heading("minkray") +
                     ".SH NAME\nminkray \\- cast rays at exact convex shapes\n.SH SYNOPSIS\n"
                     ".B minkray\n.I verb\n[\n.I options\n]\n.SH VERBS\n";
  for (const VerbDescription& verb : verbs)
    page += ".TP\n.BR minkray\\-" + roff(verb.name) + " (1)\n" + roff(verb.doc) + "\n";
  return page + exit_status;
}

}  // namespace minkray
