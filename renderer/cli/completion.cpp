// SPDX-License-Identifier: MIT
#include "renderer/cli/completion.h"

#include "core/files/text.h"
#include "renderer/cli/shell_quoted.h"

namespace minkray {
namespace {

/// First sentence or line, which fits next to a name.
std::string first_line(const std::string& doc) {
  return doc.substr(0, doc.find_first_of("\n;:"));
}

std::vector<std::string> flags_of(const VerbDescription& verb) {
  std::vector<std::string> flags;
  for (const OptionDescription& option : verb.options)
    flags.insert(flags.end(), option.flags.begin(), option.flags.end());
  return flags;
}

/// True if the value is a file or a folder; a scan pattern may be one.
bool takes_file(const OptionDescription& option) {
  return option.value == "FILE" || option.value == "OUTPUT" || option.value == "FOLDER" ||
         option.value == "PATTERN";
}

/// Escapes text for the specifications of zsh's _arguments.
std::string zsh_text(const std::string& text) {
  std::string out;
  for (const char c : first_line(text)) {
    if (c == '[' || c == ']' || c == ':' || c == '\\') out += '\\';
    out += c;
  }
  return out;
}

}  // namespace

std::string bash_completion(std::span<const VerbDescription> verbs) {
  std::vector<std::string> names;
  for (const VerbDescription& verb : verbs) names.push_back(verb.name);
  std::string text =
      "# bash completion of minkray; made by: minkray completion bash\n"
      "_minkray() {\n"
      "  local word=\"${COMP_WORDS[COMP_CWORD]}\" before=\"${COMP_WORDS[COMP_CWORD-1]}\" flags=\n"
      "  COMPREPLY=()\n"
      "  if ((COMP_CWORD == 1)); then\n"
      "    COMPREPLY=($(compgen -W " +
      in_single_quotes(listed(names, {}, " ") + " --help --version") +
      " -- \"$word\"))\n"
      "    return\n"
      "  fi\n"
      "  case \"${COMP_WORDS[1]} $before\" in\n";
  for (const VerbDescription& verb : verbs)
    for (const OptionDescription& option : verb.options) {
      if (option.choices.empty() || option.is_value_optional) continue;
      std::vector<std::string> patterns;
      for (const std::string& flag : option.flags)
        patterns.push_back(in_single_quotes(verb.name + " " + flag));
      if (patterns.empty()) continue;
      text += "    " + listed(patterns, {}, " | ") + ")\n      COMPREPLY=($(compgen -W " +
              in_single_quotes(listed(option.choices, {}, " ")) +
              " -- \"$word\"))\n      return ;;\n";
    }
  text += "  esac\n  case \"${COMP_WORDS[1]}\" in\n";
  for (const VerbDescription& verb : verbs)
    text += "    " + verb.name + ") flags=" + in_single_quotes(listed(flags_of(verb), {}, " ")) +
            " ;;\n";
  for (const VerbDescription& verb : verbs)
    for (const OptionDescription& option : verb.options)
      if (option.flags.empty() && !option.choices.empty())
        text += "  esac\n  case \"${COMP_WORDS[1]}\" in\n    " + verb.name +
                ") flags+=" + in_single_quotes(" " + listed(option.choices, {}, " ")) + " ;;\n";
  return text +
         "  esac\n"
         "  COMPREPLY=($(compgen -W \"$flags\" -- \"$word\"))\n"
         "  ((${#COMPREPLY[@]})) || COMPREPLY=($(compgen -f -- \"$word\"))\n"
         "}\n"
         "complete -o filenames -F _minkray minkray\n";
}

std::string zsh_completion(std::span<const VerbDescription> verbs) {
  std::string text =
      "#compdef minkray\n"
      "# zsh completion of minkray; made by: minkray completion zsh\n"
      "_minkray() {\n"
      "  if ((CURRENT == 2)); then\n"
      "    local -a verbs=(\n";
  for (const VerbDescription& verb : verbs)
    text += "      " + in_single_quotes(verb.name + ":" + first_line(verb.doc)) + "\n";
  text +=
      "    )\n"
      "    _describe verb verbs\n"
      "    return\n"
      "  fi\n"
      "  local verb=\"$words[2]\"\n"
      "  shift words\n"
      "  ((CURRENT--))\n"
      "  case \"$verb\" in\n";
  for (const VerbDescription& verb : verbs) {
    text += "    " + verb.name + ")\n      _arguments";
    for (const OptionDescription& option : verb.options) {
      std::string action;
      if (!option.value.empty())
        action = std::string(option.is_value_optional ? "::" : ":") + "value:" +
                 (!option.choices.empty() ? "(" + listed(option.choices, {}, " ") + ")"
                  : takes_file(option)    ? "_files"
                                          : " ");
      if (option.flags.empty()) {
        text +=
            " \\\n        " +
            in_single_quotes(
                (option.is_repeated ? "*:" : ":") + option.place + ":" +
                (option.choices.empty() ? "_files" : "(" + listed(option.choices, {}, " ") + ")"));
        continue;
      }
      for (const std::string& flag : option.flags)
        text += " \\\n        " + in_single_quotes((option.is_repeated ? "*" : "") + flag +
                                                   (option.is_value_optional ? "=-" : "") + "[" +
                                                   zsh_text(option.doc) + "]" + action);
    }
    text += " ;;\n";
  }
  return text +
         "  esac\n"
         "}\n"
         "_minkray \"$@\"\n";
}

std::string fish_completion(std::span<const VerbDescription> verbs) {
  std::string text = "# fish completion of minkray; made by: minkray completion fish\n";
  for (const VerbDescription& verb : verbs)
    text += "complete -c minkray -n __fish_use_subcommand -f -a " + verb.name + " -d " +
            in_single_quotes(first_line(verb.doc)) + "\n";
  for (const VerbDescription& verb : verbs)
    for (const OptionDescription& option : verb.options) {
      text +=
          "complete -c minkray -n " + in_single_quotes("__fish_seen_subcommand_from " + verb.name);
      for (const std::string& flag : option.flags)
        text += flag.starts_with("--") ? " -l " + flag.substr(2) : " -s " + flag.substr(1);
      if (!option.flags.empty() && !option.value.empty() && !option.is_value_optional)
        text += " -r";
      if (!option.choices.empty())
        text += " -f -a " + in_single_quotes(listed(option.choices, {}, " "));
      text += " -d " + in_single_quotes(first_line(option.doc)) + "\n";
    }
  return text;
}

}  // namespace minkray
