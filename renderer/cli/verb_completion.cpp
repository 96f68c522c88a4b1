// SPDX-License-Identifier: MIT
// minkray completion: what shells source to complete minkray's verbs and options.
#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>

#include "renderer/cli/completion.h"
#include "renderer/cli/verbs.h"

namespace minkray {

void add_completion(CLI::App& app, ExitCode&) {
  CLI::App* verb = app.add_subcommand("completion", "Print completions for a shell");
  const auto shell = std::make_shared<std::string>();
  verb->add_option("shell", *shell, "Which shell's")
      ->required()
      ->check(CLI::IsMember({"bash", "zsh", "fish"}));
  verb->callback([shell, &app] {
    const std::vector<VerbDescription> all = describe_verbs(app);
    std::cout << (*shell == "bash"  ? bash_completion(all)
                  : *shell == "zsh" ? zsh_completion(all)
                                    : fish_completion(all));
  });
}

}  // namespace minkray
