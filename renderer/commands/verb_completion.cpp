// SPDX-License-Identifier: MIT
// minkray completion: scripts for shells to complete minkray's commands and options.
#include <iostream>
#include <memory>

#include "renderer/cli/completion.h"
#include "renderer/cli/options.h"
#include "renderer/cli/verbs.h"

namespace minkray {

void add_completion(Parser& parser, ExitCode&) {
  const Verb verb = parser.add_verb("completion");
  const auto shell = std::make_shared<std::string>();
  verb.add_option("shell", *shell, "Shell").required().one_of({"bash", "zsh", "fish"});
  verb.on_call([shell, &parser] {
    const std::vector<VerbDescription> all = parser.verbs();
    std::cout << (*shell == "bash"  ? bash_completion(all)
                  : *shell == "zsh" ? zsh_completion(all)
                                    : fish_completion(all));
  });
}

}  // namespace minkray
