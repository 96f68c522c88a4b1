// SPDX-License-Identifier: MIT
#include <algorithm>
#include <filesystem>
#include <iostream>

#include "renderer/arguments/inspect_options.h"
#include "renderer/base/errors.h"
#include "renderer/base/interrupt.h"
#include "renderer/cli/command_files.h"
#include "renderer/cli/file_ending.h"
#include "renderer/inspect/page.h"
#include "renderer/inspect/served_scene.h"
#include "renderer/io/output_file.h"
#include "renderer/jobs/progress_line.h"
#include "renderer/json/mistakes.h"

namespace minkray {
namespace {

/// Default size of a page of 640x360 pixels; larger ones in proportion.
constexpr double bytes_for_pixels = 6e6, pixels_for_bytes = 640 * 360;

std::size_t bytes_for(const InspectArguments& arguments, const Resolution& resolution) {
  if (arguments.megabytes > 0) return static_cast<std::size_t>(arguments.megabytes * 1e6);
  const double pixels = double(resolution.width) * resolution.height;
  return static_cast<std::size_t>(bytes_for_pixels * std::max(1.0, pixels / pixels_for_bytes));
}

/// The page's file, which must end in .html. An existing file is only replaced if -o names it.
std::string output_of(const InspectArguments& arguments) {
  if (arguments.image.outputs.size() > 1) throw WrongUsage("--output: the page is one file");
  if (!arguments.image.outputs.empty()) return arguments.image.outputs.front();
  const std::string output =
      std::filesystem::path(arguments.image.scene).stem().string() + "-inspect.html";
  std::error_code error;
  if (std::filesystem::exists(output, error))
    throw WrongUsage("--output: " + output + " exists; name it with -o to replace it");
  arguments.image.files->write(output, "--output");
  return output;
}

void serve(const Scene& scene, const std::vector<InspectedSolver>& solvers,
           const InspectOptions& options, std::string page, int port) {
  const InterruptGuard guard;
  {
    LoopbackServer server(port);
    ServedScene served(scene, solvers, options, std::move(page), {{}, InterruptGuard::interrupted});
    std::cout << server.address() << std::endl;
    server.serve([&](const WebRequest& request) { return served.answer(request); },
                 InterruptGuard::interrupted);
  }
}

}  // namespace

void inspect(const InspectArguments& arguments, ExitCode&) {
  const std::string output = arguments.serve ? "" : output_of(arguments);
  if (!arguments.serve) {
    check_ending(output, ".html", "--output");
    check_writable(output);
  }
  const Scene scene = arguments.image.load_scene();
  InspectOptions options;
  options.name = std::filesystem::path(arguments.image.scene).stem().string();
  options.picture = arguments.image.render_options(scene);
  options.pairs = arguments.pairs;
  options.most_bytes = bytes_for(arguments, options.picture.resolution);
  options.is_served = arguments.serve;

  std::vector<InspectedSolver> solvers;
  solvers.push_back(
      {arguments.image.solver, SceneCasts(scene, cast_options(arguments.image.solver))});
  if (arguments.beside != arguments.image.solver)
    solvers.push_back(
        {arguments.beside, SceneCasts(scene, cast_options(arguments.beside, "--beside"))});

  InspectPage page;
  {
    const InterruptGuard guard;
    {
      ProgressLine line(!arguments.image.quiet);
      page = inspect_page(scene, solvers, options,
                          {[&](double fraction, std::uint64_t rays) { line.show(fraction, rays); },
                           InterruptGuard::interrupted});
    }
    InterruptGuard::end_if_interrupted();
    if (!arguments.serve) write_file(output, page.html);
  }
  if (arguments.serve) return serve(scene, solvers, options, std::move(page.html), arguments.port);
  if (!arguments.image.quiet)
    std::cerr << printable(output) << ": " << page.html.size() << " bytes; the casts of "
              << page.replayed << " of " << page.pixels << " pixels can be replayed\n";
}

}  // namespace minkray
