// SPDX-License-Identifier: MIT
#include "renderer/jobs/render_arguments.h"

#include "core/support/named_kind.h"
#include "renderer/arguments/choices.h"
#include "renderer/base/errors.h"
#include "renderer/cli/options.h"
#include "renderer/film/data_channels.h"
#include "renderer/share/checkpoint.h"

namespace minkray {
namespace {

constexpr const char* picture_suffix = ".png";
constexpr const char* several_machines = "Several machines";

}  // namespace

void RenderArguments::choose_output(const Ranks& ranks) {
  if (image.outputs.empty() && (is_share() || frames || ranks.count() > 1))
    throw WrongUsage("--output: required with --tile, --sample-share, --frames and MPI");
  image.choose_output(picture_suffix);
  const bool has_checkpoint = checkpoint_seconds > 0 || resume;
  if (!frames && ranks.count() == 1 && has_checkpoint)
    image.files->write(Checkpoint::path_for(image.outputs.front()), "--output");
}

void RenderArguments::add_to(const Verb& verb) {
  image.samples = 16;
  image.add_to(verb, picture_suffix);
  add_solver_option(verb, image.solver);
  verb.add_option("--exposure", exposure, "Exposure in stops; not applied to .pfm and .exr")
      .show_default();
  verb.add_option("--integrator", integrator, "Rendering method:" + lines_of_help(integrators))
      .one_of(names_in(integrators))
      .show_default();
  verb.add_option(
          "--max-depth", max_depth,
          "Maximum bounces per path, with --integrator path; 0: only emissive objects are visible")
      .between(0, 1000)
      .show_default();
  verb.add_option("--bounces", bounces,
                  "Diffuse bounces, with --integrator ambient; 0: only ambient occlusion")
      .between(0, 64)
      .show_default();
  verb.add_option(
          "--clamp", clamp,
          "Maximum radiance of each contribution of indirect light, with --integrator path; "
          "0: unlimited\n"
          "A limit gives fewer fireflies, but a slightly darker picture")
      .between(0.0, 1e30)
      .show_default();
  verb.add_option(
          "--noise", noise,
          "Adaptive sampling: stop sampling a pixel when its relative error is below this; 0: off")
      .between(0.0, 1.0)
      .show_default();
  verb.add_flag("--denoise", denoise, "Denoise (best at few samples per pixel)");
  verb.add_flag("--half", has_halfs, "Write the colours of .exr as 16-bit floats");
  verb.add_option("--tonemap", tone_map, "Tone mapping of PNG output:" + lines_of_help(tone_maps))
      .one_of(names_in(tone_maps))
      .show_default();
  verb.add_option("--ray-group", ray_group,
                  "Number of camera rays traced together; does not change the picture")
      .between(1, most_in_ray_group)
      .show_default()
      .group(research_group);
  verb.add_option(
          "--build",
          [this](const std::string& name) {
            build = name == "speed" ? BvhBuild::speed : BvhBuild::quality;
          },
          "How to build the BVH (default quality):\nquality: for faster rays\n"
          "speed: for a faster build")
      .one_of({"quality", "speed"})
      .group(research_group);
  verb.add_option("--aov", aov,
                  "Extra EXR channels (AOVs), comma-separated, or all\n"
                  "The channels direct, indirect, variance and cryptomatte come from all samples; "
                  "the others come from one unfiltered ray per pixel\nChannels:" +
                      lines_of_help(data_channels))
      .takes("NAMES");
  verb.add_option(
          "--tile", tile,
          "Split the picture into N tiles and render only tile I (1 to N); minkray merge joins the "
          "tiles")
      .takes("I/N")
      .group(several_machines);
  verb.add_option("--sample-share", sample_share,
                  "Split each pixel's samples into N shares and render only share I (1 to N); "
                  "minkray merge joins the shares")
      .takes("I/N")
      .group(several_machines);
  verb.add_option("--tiles", tiles,
                  "Number of tiles under mpirun; default: tiles of about 64 x 64 pixels")
      .between(1, 999999)
      .group(several_machines);
  verb.add_option(
          "--checkpoint", checkpoint_seconds,
          "Seconds between checkpoints, which are written next to the first output; 0: none")
      .between(0.0, 1e9)
      .show_default();
  verb.add_flag("--resume", resume, "Resume from the last checkpoint, if one exists");
  verb.add_flag("--progressive", progressive,
                "Render in passes of 1, 2, 4 ... samples per pixel and show each pass");
  verb.add_option("--tev", tev,
                  "Show the picture in the viewer tev while rendering (default port 14158)")
      .takes("HOST:PORT");
  verb.add_option(
          "--frames", frames,
          "Frames to render, such as 0..47; #### in the output's name becomes the frame number\n"
          "With --resume, frames that are already done are skipped; render lists them in a file "
          "next to the output, such as x-####.png.frames")
      .takes("A..B");
  verb.add_option("--rate", rate, "Frame rate in frames per second, fps")
      .between(1e-6, 1e6)
      .show_default();
  verb.add_option("--contact-sheet", contact_sheet, "Picture to write: thumbnails of all frames")
      .writes_file();
  verb.add_flag("--stats", stats,
                "Print statistics: rays, speed, work and memory; --stats=json prints JSON")
      .group(research_group);
  verb.add_flag("--certify", certify, "Prove the result of every ray; exit with 1 if a proof fails")
      .group(research_group);
}

}  // namespace minkray
