// SPDX-License-Identifier: MIT
// minkray inspect: page that shows the solver, pixel by pixel and step by step.
#include <memory>

#include "core/parallel/parallel.h"
#include "renderer/arguments/choices.h"
#include "renderer/arguments/import_arguments.h"
#include "renderer/arguments/inspect_options.h"
#include "renderer/cli/options.h"
#include "renderer/cli/verbs.h"
#include "renderer/paper/solvers.h"

namespace minkray {

void add_inspect(Parser& parser, ExitCode& exit_code) {
  const Verb verb = parser.add_verb("inspect");
  const auto options = std::make_shared<InspectArguments>();
  ImageArguments& image = options->image;
  image.samples = 16;
  image.files = &verb.files();
  add_scene_option(verb, image.scene);
  add_other_files(verb, image.import);
  add_import_options(verb, image.import);
  const Option output =
      verb.add_option("-o,--output", image.outputs,
                      "HTML file to write; default: the scene's name + -inspect.html")
          .one_value_each()
          .writes_file();
  verb.add_option("-r,--resolution", image.resolution,
                  "Picture size in pixels (default: the scene's)")
      .takes("WxH");
  add_camera_file_option(verb, image.camera_file);
  verb.add_option("-s,--spp", image.samples, "Samples per pixel of the picture")
      .between(1, 1 << 16)
      .show_default();
  verb.add_option("-t,--threads", image.threads, "Threads; 0: one per core")
      .between(0, 1024)
      .show_default();
  add_solver_option(verb, image.solver);
  verb.add_option("--beside", options->beside, "Second solver, shown for comparison")
      .one_of(names_in(named_solvers))
      .show_default();
  verb.add_option("--pairs", options->pairs, "Number of object pairs whose distance the page shows")
      .between(std::size_t{0}, std::size_t{1000})
      .show_default();
  verb.add_option(
          "--megabytes", options->megabytes,
          "Maximum page size in MB\n"
          "The larger the page, the more pixels can be replayed\n"
          "0 (default): 6 MB for up to 640x360 pixels, proportionally more for larger pictures")
      .between(0.0, 2000.0);
  verb.add_flag("--serve", options->serve,
                "Serve the page at 127.0.0.1 until Ctrl-C\n"
                "A served page can replay every pixel, a file only as many as fit into --megabytes")
      .excludes(output);
  verb.add_option("--port", options->port, "Port for --serve; 0: any free port")
      .between(0, 65535)
      .show_default();
  verb.add_flag("-q,--quiet", image.quiet, "Print neither progress nor a report");
  verb.on_call([options, &exit_code] {
    with_threads(options->image.threads, [&] { inspect(*options, exit_code); });
  });
}

}  // namespace minkray
