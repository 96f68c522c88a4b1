// SPDX-License-Identifier: MIT
// minkray man: man page of one command, or of all.
#include <iostream>
#include <memory>

#include "core/files/text.h"
#include "renderer/base/errors.h"
#include "renderer/cli/man_page.h"
#include "renderer/cli/options.h"
#include "renderer/cli/verbs.h"
#include "renderer/json/mistakes.h"

namespace minkray {
namespace {

std::string page_of(const std::vector<VerbDescription>& all, const std::string& name) {
  if (name.empty()) return man_page(all);
  for (const VerbDescription& verb : all)
    if (verb.name == name) return man_page(verb);
  throw WrongUsage("man: must be one of " + listed(all, &VerbDescription::name) + " (got " +
                   printable(name, 40) + ")");
}

}  // namespace

void add_man(Parser& parser, ExitCode&) {
  const Verb verb = parser.add_verb("man");
  const auto name = std::make_shared<std::string>();
  verb.add_option("verb", *name, "Command (default: page of all commands)").takes("NAME");
  verb.on_call([name, &parser] { std::cout << page_of(parser.verbs(), *name); });
}

}  // namespace minkray
