// SPDX-License-Identifier: MIT
// minkray paper: reproduces the claims of the papers and prints them next to our results.
#include <algorithm>
#include <filesystem>
#include <iostream>
#include <memory>
#include <span>

#include "renderer/base/errors.h"
#include "renderer/claims/claim.h"
#include "renderer/cli/options.h"
#include "renderer/cli/verbs.h"
#include "renderer/io/output_file.h"

namespace minkray {
namespace {

struct PaperVerbOptions {
  std::string only;
  std::string out;
  ClaimOptions claim;
};

void write_plot(const Plot& plot, const std::filesystem::path& folder) {
  const std::string svg = plot_svg(plot);
  write_file((folder / plot.file).string(), svg);
}

/// Prints text in lines of at most 96 characters, after a label.
void print_row(const std::string& label, const std::string& text) {
  constexpr std::size_t width = 96, indent = 12;
  std::string line = "    " + label;
  line.resize(indent, ' ');
  std::size_t start = 0;
  while (start < text.size()) {
    const std::size_t end = std::min(text.find(' ', start), text.size());
    const std::string word = text.substr(start, end - start);
    if (line.size() + word.size() > width && line.size() > indent) {
      std::cout << line << '\n';
      line.assign(indent, ' ');
    }
    line += word + " ";
    start = end + 1;
  }
  while (!line.empty() && line.back() == ' ') line.pop_back();
  std::cout << line << '\n';
}

void paper(const PaperVerbOptions& options) {
  if (!options.out.empty()) {
    std::error_code error;
    std::filesystem::create_directories(options.out, error);
    if (!std::filesystem::is_directory(options.out, error))
      throw CannotWrite("--out: must be a folder that exists or can be made (got " + options.out +
                        ")");
  }
  std::cout
      << "An iteration is one pass of the loop, with one call of the support mapping; the last\n"
         "pass counts. Rays, shapes and motions are random with a fixed seed.\n";
  for (const PaperClaim& claim : claims) {
    if (!options.only.empty() && claim.id != options.only) continue;
    const ClaimResult result = claim.run(options.claim);
    std::cout << "\n(" << claim.id << ") " << claim.title << '\n';
    print_row("paper", std::string(claim.paper));
    for (std::size_t i = 0; i < result.ours.size(); ++i)
      print_row(i == 0 ? "ours" : "", result.ours[i]);
    print_row("verdict", result.verdict);
    print_row("command", "minkray paper --only " + std::string(claim.id) + " --rays " +
                             std::to_string(options.claim.rays) + " --seed " +
                             std::to_string(options.claim.seed));
    std::cout.flush();
    if (options.out.empty()) continue;
    for (const Plot& plot : result.plots) {
      write_plot(plot, options.out);
      print_row("plot", (std::filesystem::path(options.out) / plot.file).string());
    }
  }
}

}  // namespace

void add_paper(Parser& parser, ExitCode&) {
  const Verb verb = parser.add_verb("paper");
  const auto options = std::make_shared<PaperVerbOptions>();
  std::vector<std::string> ids;
  for (const PaperClaim& claim : claims) ids.emplace_back(claim.id);
  verb.add_option("--only", options->only, "Rerun only this experiment (its letter in the report)")
      .one_of(ids);
  verb.add_option("--out", options->out, "Folder to write plots to (SVG); default: no plots")
      .takes_folder();
  verb.add_option("--rays", options->claim.rays, "Random rays per measured value")
      .between(100, 100000000)
      .show_default();
  verb.add_option("--seed", options->claim.seed, "Random seed").show_default();
  verb.on_call([options] { paper(*options); });
}

}  // namespace minkray
