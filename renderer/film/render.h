// SPDX-License-Identifier: MIT
// Renders whole pictures: tiles on all cores, each pixel by itself, so pictures are bit-identical
// for any number of threads and any crop.
#pragma once

#include "renderer/film/share.h"
#include "renderer/film/tiles.h"
#include "renderer/image/image.h"
#include "renderer/paths/integrator.h"

namespace minkray {

/// The scene's objects, then its particles, in order.
World make_world(const Scene& scene, const CastOptions& options = {},
                 BvhBuild build = BvhBuild::quality);

/// Moves a world's instances to the current poses of its scene.
void follow(World& world, const Scene& scene);

struct RenderOptions {
  Resolution resolution;
  PixelRect crop;      ///< the picture that is wanted; empty: all
  Share tile;          ///< of the picture: which share of its pixels to render
  Share sample_share;  ///< of each pixel: which share of its samples to render
  int samples = 16;    ///< of a pixel, all shares together
  std::uint64_t seed = 0;
  /// A pixel takes no more samples when its standard error, over its brightness, is below this; 0:
  /// all of them. Not with shares of the samples.
  double noise = 0;
  /// Also computes Rendering::direct and variance. Not with shares of the samples.
  bool light_channels = false;
  IntegratorOptions integrator;

  /// Region of all tiles together.
  PixelRect picture() const {
    return crop.empty() ? PixelRect{0, 0, resolution.width, resolution.height} : crop;
  }
  /// Region to render.
  PixelRect region() const { return tile_of(picture(), tile); }
};

struct Rendering {
  Image image;  ///< linear radiance, of the requested region; empty for a share of the samples
  std::vector<Image> block_sums;   ///< of a share of the samples: the sums of its blocks, in order
  std::vector<std::uint32_t> met;  ///< by pixel: how many of the samples' rays met an object
  Image direct;    ///< of the light, what was scattered at most once; empty unless wanted
  Image variance;  ///< the squared standard error of the light, likewise
  /// The mean of the pixels' standard errors, each over the pixel's brightness, of those that were
  /// rendered here and have two samples or more; negative if none has.
  double noise = -1;
  RayCounts counts;
  bool complete = false;  ///< false if the watch stopped it
};

/// A rendering to continue, and callbacks for its progress.
struct RenderJournal {
  Rendering begun;         ///< if any tile is done
  std::vector<bool> done;  ///< flags of its tiles, in the order of TileGrid; empty: none
  /// Called after each tile, one at a time; other tiles may be written to meanwhile.
  std::function<void(const Rendering&, std::size_t tile)> finished;
  /// If set, the picture is made in passes of 1, 2, 4 ... samples per pixel, all together; called
  /// after each but the last, with their number. The last picture has the same bits as without.
  /// Not with shares of the samples. Uses 200 bytes per pixel.
  std::function<void(const Rendering&, int samples)> passed;
};

/// Refers to `world` made of `scene`.
Rendering render(const Scene& scene, const World& world, const RenderOptions& options,
                 const RenderWatch& watch = {}, RenderJournal journal = {});

}  // namespace minkray
