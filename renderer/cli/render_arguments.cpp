// SPDX-License-Identifier: MIT
#include "renderer/cli/render_arguments.h"

#include "renderer/base/errors.h"
#include "renderer/cli/choices.h"
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
    throw WrongUsage("--output: is needed with --tile, --sample-share, --frames and MPI");
  image.choose_output(picture_suffix);
  const bool has_checkpoint = checkpoint_seconds > 0 || resume;
  if (!frames && ranks.count() == 1 && has_checkpoint)
    image.files->write(Checkpoint::path_for(image.outputs.front()), "--output");
}

void RenderArguments::add_to(const Verb& verb) {
  image.samples = 16;
  image.add_to(verb, picture_suffix);
  add_solver_option(verb, image.solver);
  verb.add_option("--exposure", exposure,
                  "Exposure in stops (.pfm and .exr keep the scene's light)")
      .show_default();
  std::string kinds = "Rendering method:";
  std::vector<std::string> names;
  for (const IntegratorDescription& kind : integrators) {
    kinds += "\n" + std::string(kind.name) + ": " + std::string(kind.doc);
    names.emplace_back(kind.name);
  }
  verb.add_option("--integrator", integrator, kinds).one_of(names).show_default();
  verb.add_option("--max-depth", max_depth,
                  "With --integrator path: how often light is scattered, mirrored or refracted on "
                  "its way; 0 for shining bodies alone")
      .between(0, 1000)
      .show_default();
  verb.add_option("--bounces", bounces,
                  "With --integrator ambient: how often light is scattered between objects; 0 for "
                  "ambient occlusion")
      .between(0, 64)
      .show_default();
  verb.add_option("--clamp", clamp,
                  "Clamp indirect light of --integrator path: fewer fireflies, slightly darker "
                  "(biased). 0: no limit")
      .between(0.0, 1e30)
      .show_default();
  verb.add_option("--noise", noise,
                  "A pixel takes no more samples when its standard error, over its brightness, is "
                  "below this. 0: all samples")
      .between(0.0, 1.0)
      .show_default();
  verb.add_flag(
      "--denoise", denoise,
      "Less noise: pixels are averaged with others that are of the same thing and about as "
      "bright; made for few samples");
  verb.add_flag("--half", has_halfs, "Write the colors of .exr with 16-bit floats");
  std::string maps = "Tone mapping of PNG output:";
  for (const ToneMapDescription& map : tone_maps)
    maps += "\n" + std::string(map.name) + ": " + std::string(map.doc);
  verb.add_option("--tonemap", tone_map, maps).one_of(tone_map_names()).show_default();
  verb.add_option("--ray-group", ray_group,
                  "Camera rays that are traced together; the picture is the same for any number")
      .between(1, most_in_ray_group)
      .show_default()
      .group(research_group);
  verb.add_option(
          "--build",
          [this](const std::string& name) {
            build = name == "speed" ? BvhBuild::speed : BvhBuild::quality;
          },
          "BVH build, for faster rays or for a faster build")
      .one_of({"quality", "speed"})
      .group(research_group);
  std::string channels;
  for (const DataChannelDescription& channel : data_channels)
    channels += "\n" + std::string(channel.name) + ": " + std::string(channel.doc);
  verb.add_option(
          "--aov", aov,
          "AOVs (extra EXR channels), comma-separated, or all; one unfiltered ray per pixel:" +
              channels)
      .takes("NAMES");
  verb.add_option("--tile", tile, "Just the i-th of n tiles of the picture, for minkray merge")
      .takes("I/N")
      .group(several_machines);
  verb.add_option("--sample-share", sample_share,
                  "Just the i-th of n shares of each pixel's samples, for minkray merge")
      .takes("I/N")
      .group(several_machines);
  verb.add_option("--tiles", tiles,
                  "Under mpirun: into how many tiles the picture is split; by default each has "
                  "about 64 x 64 pixels")
      .between(1, 999999)
      .group(several_machines);
  verb.add_option("--checkpoint", checkpoint_seconds,
                  "Seconds between checkpoints beside the first output; 0 for none")
      .between(0.0, 1e9)
      .show_default();
  verb.add_flag("--resume", resume, "Go on from the checkpoint, if there is one");
  verb.add_flag(
      "--progressive", progressive,
      "In passes of 1, 2, 4 ... samples a pixel: each is written to the outputs, and shown "
      "by --preview and --tev; the last picture has the same bits as without");
  verb.add_option(
          "--tev", tev,
          "Show the picture while it grows in the viewer tev that listens there; the port is "
          "14158 if it is left out")
      .takes("HOST:PORT");
  verb.add_option("--frames", frames,
                  "Pictures of these frames, into files with the frame's number in the "
                  "place of #### in the output's name; frame 0 is at 0 s. A record beside them, "
                  "####.png.frames, tells which are there: with --resume they are left out")
      .takes("A..B");
  verb.add_option("--rate", rate, "Frames per second (fps)").between(1e-6, 1e6).show_default();
  verb.add_option("--contact-sheet", contact_sheet,
                  "With --frames: all frames, small, in one more picture")
      .writes_file();
  verb.add_flag("--stats", stats, "Print rays, speed, work and memory; --stats=json")
      .group(research_group);
  verb.add_flag("--certify", certify, "Prove the answer to every ray; exit 1 if a proof fails")
      .group(research_group);
}

}  // namespace minkray
