// SPDX-License-Identifier: MIT
#include "renderer/share/merge.h"

#include <cstdlib>
#include <filesystem>
#include <map>
#include <utility>

#include "core/files/text.h"
#include "renderer/base/errors.h"
#include "renderer/base/of_file.h"

namespace minkray {
namespace {

/// The part of the picture in a file.
struct PictureShare {
  Share tile, sample_share;

  /// Sorts by tile, then by samples.
  std::pair<int, int> place() const { return {tile.index, sample_share.index}; }
};

std::string name_of(const PictureShare& held) {
  const std::string tile = "tile " + held.tile.text();
  const std::string samples = "samples " + held.sample_share.text();
  if (held.sample_share.is_all()) return tile;
  return held.tile.is_all() ? samples : samples + " of " + tile;
}

PictureShare picture_share_of(const Facts& facts) {
  const auto share = [&](const char* name) {
    const std::string text = text_of(facts, name);
    if (text.empty()) throw BadInput("not a tile or share of a picture (minkray render --tile)");
    try {
      return parse_share(text, std::string("its header's ") + name);
    } catch (const WrongUsage& error) {
      throw BadInput(error.what());
    }
  };
  return {share(fact::tile), share(fact::sample_share)};
}

/// Facts of the picture as a whole.
Facts whole_facts(const Facts& facts) {
  Facts whole;
  for (const std::string& name : common_facts())
    if (facts.contains(name)) whole[name] = facts.at(name);
  if (const std::string labels = text_of(facts, labels_fact); !labels.empty())
    whole[labels_fact] = labels;
  return whole;
}

/// The share's file as it should be: `picture` are the pixels of all shares together.
void check(const ExrImage& exr, const PictureShare& held, const PixelRect& picture) {
  if (exr.window.empty() || exr.window != tile_of(picture, held.tile))
    throw BadInput("data window does not match the header");
}

/// Copies all planes of a tile to their places in the picture.
class Picture {
 public:
  Picture(const PixelRect& display, const PixelRect& window) : exr_{display, window, {}, {}} {}

  void put(const ExrImage& tile) {
    if (exr_.planes.empty()) {
      const auto size = static_cast<std::size_t>(exr_.window.width()) *
                        static_cast<std::size_t>(exr_.window.height());
      for (const ExrPlane& plane : tile.planes)
        exr_.planes.push_back(
            {plane.name, std::visit(
                             [&](const auto& values) -> decltype(ExrPlane::values) {
                               return std::remove_cvref_t<decltype(values)>(size);
                             },
                             plane.values)});
    }
    const auto same = [](const ExrPlane& a, const ExrPlane& b) {
      return a.name == b.name && a.values.index() == b.values.index();
    };
    if (!std::equal(tile.planes.begin(), tile.planes.end(), exr_.planes.begin(), exr_.planes.end(),
                    same))
      throw BadInput("has other channels than the first part file");
    for (std::size_t i = 0; i < tile.planes.size(); ++i)
      std::visit(
          [&](const auto& from) {
            auto& to = std::get<std::remove_cvref_t<decltype(from)>>(exr_.planes[i].values);
            copy_rows(from, tile.window, to);
          },
          tile.planes[i].values);
  }

  ExrImage take() { return std::move(exr_); }

 private:
  template <class Numbers>
  void copy_rows(const Numbers& from, const PixelRect& tile, Numbers& to) const {
    const auto width = static_cast<std::ptrdiff_t>(tile.width());
    for (std::ptrdiff_t row = 0; row < tile.height(); ++row) {
      const std::ptrdiff_t start =
          (row + tile.y0 - exr_.window.y0) * exr_.window.width() + (tile.x0 - exr_.window.x0);
      std::copy_n(from.begin() + row * width, width, to.begin() + start);
    }
  }

  ExrImage exr_;
};

/// Adds the shares of one tile's samples, in order.
class SampleSum {
 public:
  SampleSum(const ExrImage& like, int samples)
      : blocks_{samples},
        exr_{like.display, like.window, {}, {}},
        totals_(static_cast<std::size_t>(like.window.width()) *
                static_cast<std::size_t>(like.window.height())),
        met_(totals_.size()) {}

  void add(const ExrImage& exr, const Share& share) {
    const std::vector<std::uint32_t>& met = integers_of(exr, met_plane);
    for (std::size_t i = 0; i < met_.size(); ++i) met_[i] += met[i];
    for (int block = blocks_.first_of(share); block < blocks_.end_of(share); ++block) {
      const Image sums = image_of(exr, block_plane_name(block, 'R'), block_plane_name(block, 'G'),
                                  block_plane_name(block, 'B'));
      for (std::size_t i = 0; i < totals_.size(); ++i) totals_[i].add(sums.pixels[i]);
      samples_ += blocks_.begin(block + 1) - blocks_.begin(block);
    }
  }

  ExrImage mean() && {
    Image image(exr_.window.width(), exr_.window.height());
    for (std::size_t i = 0; i < totals_.size(); ++i) image.pixels[i] = totals_[i].mean(samples_);
    add_colour_planes(exr_, image);
    exr_.planes.push_back({"A", coverage(met_, samples_)});
    return std::move(exr_);
  }

 private:
  SampleBlocks blocks_;
  ExrImage exr_;
  std::vector<BlockTotal> totals_;
  std::vector<std::uint32_t> met_;
  int samples_ = 0;  ///< those that are there
};

/// File of each share, by its tile and its share of the samples.
using FileOfShare = std::map<std::pair<int, int>, std::string>;

/// The first of the shares that have no file, of `missing`: "a, b, c and 5 more".
std::string names_of_missing(const FileOfShare& file_of, const PictureShare& split,
                             std::uint64_t missing) {
  constexpr std::uint64_t most = 20;
  std::string names;
  std::uint64_t named = 0;
  for (int tile = 1; tile <= split.tile.count && named < std::min(missing, most); ++tile)
    for (int share = 1; share <= split.sample_share.count && named < std::min(missing, most);
         ++share)
      if (!file_of.contains({tile, share}))
        names += (named++ == 0 ? "" : ", ") +
                 name_of({{tile, split.tile.count}, {share, split.sample_share.count}});
  if (missing > most) names += " and " + std::to_string(missing - most) + " more";
  return names;
}

}  // namespace

Merged merge_part_files(const std::vector<std::string>& files, bool allow_partial) {
  if (files.empty()) throw WrongUsage("merge: needs part files");

  // Overview of all parts, from the headers.
  Merged merged;
  Facts facts;
  PictureShare first_share;
  FileOfShare file_of;
  for (const std::string& file : files)
    of_file(file, [&] {
      const Facts found = read_exr_texts(file);
      const PictureShare held = picture_share_of(found);
      if (file_of.empty()) {
        facts = whole_facts(found);
        first_share = held;
      }
      if (const std::string differs = difference(found, facts, common_facts()); !differs.empty())
        throw BadInput("is a part file of another picture than " + files.front() + ": " + differs);
      if (held.tile.count != first_share.tile.count ||
          held.sample_share.count != first_share.sample_share.count)
        throw BadInput("is a part file of another split than " + files.front() + ": " +
                       name_of(held) + " and " + name_of(first_share));
      const auto [at, is_new] = file_of.emplace(held.place(), file);
      if (!is_new) throw BadInput("holds the same share as " + at->second + ": " + name_of(held));
      merged.counts += counts_of(found);
      std::error_code error;
      merged.costs.push_back({name_of(held),
                              finite_number(text_of(found, cpu_seconds_fact)).value_or(0),
                              std::filesystem::file_size(file, error)});
    });

  PixelRect picture, display;
  int samples = 0;
  of_file(files.front(), [&] {
    const Resolution size = resolution_of(facts);
    picture = crop_of(facts);
    display = {0, 0, size.width, size.height};
    samples = samples_of(facts);
  });
  const Share& split = first_share.sample_share;
  if (!can_be_tiled(picture, first_share.tile.count) || split.count > SampleBlocks{samples}.count())
    throw BadInput(files.front() + ": its header contradicts itself");
  // Each file is another share of this split.
  merged.missing =
      static_cast<std::uint64_t>(first_share.tile.count) * static_cast<std::uint64_t>(split.count) -
      file_of.size();
  merged.missing_names = names_of_missing(file_of, first_share, merged.missing);
  if (merged.missing > 0 && !allow_partial)
    throw BadInput("merge: missing: " + merged.missing_names +
                   "; --allow-partial makes a picture without them");

  // One part file in memory at a time.
  Picture whole(display, picture);
  std::optional<SampleSum> sum;
  for (auto at = file_of.begin(); at != file_of.end(); ++at) {
    const auto& place = at->first;
    const std::string& file = at->second;
    const PictureShare held{{place.first, first_share.tile.count}, {place.second, split.count}};
    of_file(file, [&] {
      const ExrImage exr = read_exr(file);
      if (const std::string differs = difference(exr.texts, facts, common_facts());
          !differs.empty())
        throw BadInput("changed while it was read");
      check(exr, held, picture);
      if (split.is_all()) return whole.put(exr);
      if (!sum) sum.emplace(exr, samples);
      sum->add(exr, held.sample_share);
      const auto next = std::next(at);
      if (next != file_of.end() && next->first.first == place.first) return;
      whole.put(std::move(*sum).mean());
      sum.reset();
    });
  }
  merged.exr = whole.take();
  merged.exr.texts = std::move(facts);
  if (merged.missing > 0) merged.exr.texts["minkray.missing"] = merged.missing_names;
  return merged;
}

bool is_part_file_of(const std::string& file, const Facts& facts) {
  std::error_code error;
  if (!std::filesystem::exists(file, error)) return false;
  const Facts found = read_exr_texts(file);
  std::vector<std::string> names = common_facts();
  names.insert(names.end(), {fact::tile, fact::sample_share});
  if (const std::string differs = difference(found, facts, names); !differs.empty())
    throw BadInput(file + ": is of another picture: " + differs +
                   "; remove it, or render without --resume");
  return true;
}

}  // namespace minkray
