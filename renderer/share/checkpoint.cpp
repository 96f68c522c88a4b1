// SPDX-License-Identifier: MIT
#include "renderer/share/checkpoint.h"

#include <algorithm>
#include <filesystem>

#include "renderer/base/errors.h"
#include "renderer/film/pixel_loop.h"
#include "renderer/io/output_file.h"
#include "renderer/share/part_file.h"

namespace minkray {
namespace {

/// The plane that marks the finished pixels: 1 or 0.
constexpr const char* done_plane = "done";

/// A checkpoint keeps the counts of rays that met something as they are; the plane A is rounded.
constexpr const char* alpha_plane = "A";

/// Calls visit(first pixel, count) for each row of a tile of the region.
template <class Visit>
void for_rows(const PixelRect& region, const PixelRect& tile, const Visit& visit) {
  for (int y = tile.y0; y < tile.y1; ++y)
    visit(pixel_of(region, tile.x0, y).index, static_cast<std::size_t>(tile.width()));
}

std::vector<unsigned char> encode(const Rendering& rendering, const RenderOptions& options,
                                  const std::vector<bool>& done, Facts facts) {
  facts[counts_fact] = counts_text(rendering.counts);
  ExrImage exr = exr_of(rendering, options, std::move(facts));
  if (options.sample_share.is_all()) {
    std::erase_if(exr.planes, [](const ExrPlane& plane) { return plane.name == alpha_plane; });
    exr.planes.push_back({met_plane, rendering.met});
  }
  if (options.light_channels) {
    add_colour_planes(exr, rendering.direct, std::string(direct_planes) + ".");
    add_colour_planes(exr, rendering.variance, std::string(variance_planes) + ".");
  }
  std::vector<std::uint32_t> is_done(rendering.met.size());
  const PixelRect region = options.region();
  const TileGrid tiles(region);
  for (std::size_t tile = 0; tile < tiles.count(); ++tile)
    if (done[tile])
      for_rows(region, tiles[tile], [&](std::size_t first, std::size_t count) {
        std::fill_n(is_done.begin() + static_cast<std::ptrdiff_t>(first), count, 1u);
      });
  exr.planes.push_back({done_plane, std::move(is_done)});
  return encode_exr(exr);
}

std::vector<std::string> facts_that_must_agree() {
  std::vector<std::string> names = common_facts();
  std::erase(names, fact::aov);  // data channels are quick, and not in a checkpoint
  names.insert(names.end(), {fact::tile, fact::sample_share});
  return names;
}

}  // namespace

Checkpoint::Checkpoint(std::string path, const RenderOptions& options, Facts facts, double seconds)
    : path_(std::move(path)),
      options_(options),
      facts_(std::move(facts)),
      pause_(seconds),
      done_(TileGrid(options.region()).count()) {
  facts_[fact::tile] = options.tile.text();
  facts_[fact::sample_share] = options.sample_share.text();
}

Checkpoint::~Checkpoint() {
  if (writing_.valid()) writing_.wait();
}

bool Checkpoint::exists() const {
  std::error_code error;
  return std::filesystem::exists(path_, error);
}

void Checkpoint::check_replaceable() const {
  if (!exists()) return;
  std::error_code error;
  const std::string remedy = "; the checkpoint would replace it: move it away";
  if (!std::filesystem::is_regular_file(path_, error))
    throw CannotWrite(path_ + ": not a file" + remedy);
  if (!is_exr(path_)) throw CannotWrite(path_ + ": not a checkpoint" + remedy);
}

RenderJournal Checkpoint::load() {
  const ExrImage exr = [&] {
    try {
      return read_exr(path_);
    } catch (const BadInput& error) {
      throw BadInput(std::string(error.what()) + "; remove it, or render without --resume");
    }
  }();
  if (const std::string differs = difference(exr.texts, facts_, facts_that_must_agree());
      !differs.empty())
    throw BadInput(path_ + ": is the checkpoint of another picture: " + differs +
                   "; remove it, or render without --resume");
  const PixelRect region = options_.region();
  if (exr.window != region) throw BadInput(path_ + ": data window does not match the header");

  RenderJournal journal;
  try {
    Rendering& begun = journal.begun;
    begun.counts = counts_of(exr.texts);
    begun.met = integers_of(exr, met_plane);
    if (options_.sample_share.is_all()) {
      begun.image = image_of(exr, "R", "G", "B");
      if (options_.light_channels) {
        begun.direct = image_of(exr, direct_planes);
        begun.variance = image_of(exr, variance_planes);
      }
    } else {
      const SampleBlocks blocks{options_.samples};
      const int end = blocks.end_of(options_.sample_share);
      for (int block = blocks.first_of(options_.sample_share); block < end; ++block)
        begun.block_sums.push_back(image_of(exr, block_plane_name(block, 'R'),
                                            block_plane_name(block, 'G'),
                                            block_plane_name(block, 'B')));
    }
    const std::vector<std::uint32_t>& is_done = integers_of(exr, done_plane);
    const TileGrid tiles(region);
    for (std::size_t tile = 0; tile < tiles.count(); ++tile)
      done_[tile] = is_done[pixel_of(region, tiles[tile].x0, tiles[tile].y0).index] == 1;
  } catch (const BadInput& error) {
    throw BadInput(path_ + ": " + error.what());
  }
  is_ours_ = true;
  journal.done = done_;
  return journal;
}

bool Checkpoint::is_due() const {
  return pause_.count() > 0 && Clock::now() - last_ >= pause_;
}

/// Nothing is read of tiles that other threads may be writing to just now.
Rendering Checkpoint::done_tiles_of(const Rendering& rendering) const {
  Rendering copy;
  copy.counts = rendering.counts;
  copy.met.resize(rendering.met.size());
  copy.image = Image(rendering.image.width, rendering.image.height);
  if (options_.light_channels) copy.direct = copy.variance = copy.image;
  for (const Image& sums : rendering.block_sums)
    copy.block_sums.emplace_back(sums.width, sums.height);
  const PixelRect region = options_.region();
  const TileGrid tiles(region);
  for (std::size_t tile = 0; tile < tiles.count(); ++tile) {
    if (!done_[tile]) continue;
    for_rows(region, tiles[tile], [&](std::size_t first, std::size_t count) {
      const auto copy_row = [&](const auto& from, auto& to) {
        std::copy_n(from.begin() + static_cast<std::ptrdiff_t>(first), count,
                    to.begin() + static_cast<std::ptrdiff_t>(first));
      };
      copy_row(rendering.met, copy.met);
      if (!copy.image.pixels.empty()) copy_row(rendering.image.pixels, copy.image.pixels);
      if (options_.light_channels) {
        copy_row(rendering.direct.pixels, copy.direct.pixels);
        copy_row(rendering.variance.pixels, copy.variance.pixels);
      }
      for (std::size_t i = 0; i < copy.block_sums.size(); ++i)
        copy_row(rendering.block_sums[i].pixels, copy.block_sums[i].pixels);
    });
  }
  return copy;
}

void Checkpoint::write_later(const Rendering& rendering) {
  last_ = Clock::now();
  is_ours_ = true;
  writing_ = std::async(
      std::launch::async,
      [path = path_, options = options_, facts = facts_](const Rendering& copy,
                                                         const std::vector<bool>& done) {
        try {
          write_file(path, encode(copy, options, done, facts));
          return std::string();
        } catch (const std::exception& error) {
          return std::string(error.what());
        }
      },
      done_tiles_of(rendering), done_);
}

void Checkpoint::tile_finished(const Rendering& rendering, std::size_t tile) {
  done_[tile] = true;
  if (!is_due()) return;
  if (writing_.valid()) {
    if (writing_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return;
    if (const std::string text = writing_.get(); !text.empty()) complaint_ = text;
  }
  write_later(rendering);
}

void Checkpoint::interrupted(const Rendering& rendering) {
  if (!is_due() && !is_ours_) return;
  complaint();
  write_later(rendering);
}

void Checkpoint::remove() {
  complaint();
  if (!is_ours_ && !is_exr(path_)) return;
  std::error_code error;
  std::filesystem::remove(path_, error);
}

std::string Checkpoint::complaint() {
  if (writing_.valid())
    if (const std::string text = writing_.get(); !text.empty()) complaint_ = text;
  return complaint_;
}

}  // namespace minkray
