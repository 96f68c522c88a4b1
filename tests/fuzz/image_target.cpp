// SPDX-License-Identifier: MIT
// Image files that Minkray reads. The first byte selects how the others are read: one of the
// formats of pictures, an OpenEXR file of planes, part files or a checkpoint; or, of the last two,
// edits of what Minkray writes (edited_parts.h).
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <optional>

#include "renderer/base/errors.h"
#include "renderer/io/image_file.h"
#include "renderer/io/read_image.h"
#include "renderer/share/checkpoint.h"
#include "renderer/share/merge.h"
#include "tests/fuzz/edited_parts.h"
#include "tests/fuzz/target.h"
#include "tests/support/temporary_folder.h"

namespace minkray::fuzz {
namespace {

/// Pictures whose headers claim more pixels, but not too many, are not read here: that takes that
/// much memory and time.
constexpr std::int64_t most_tried = 1 << 18, most_allowed = std::int64_t{1} << 27;

const TemporaryFolder& folder() {
  static const TemporaryFolder folder;
  return folder;
}

/// Made once: Minkray writes them itself.
const PartsOfPicture& parts(int kind) {
  static const std::array kept = {parts_of_kind(0), parts_of_kind(1), parts_of_kind(2)};
  return kept[static_cast<std::size_t>(kind)];
}
const PartsOfPicture& checkpoint(int kind) {
  static const std::array kept = {checkpoint_of_kind(0), checkpoint_of_kind(1),
                                  checkpoint_of_kind(2)};
  return kept[static_cast<std::size_t>(kind)];
}

std::string_view text_of(const std::vector<unsigned char>& bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

/// Number of pixels in the header of a PNG, JPEG or Radiance file; nothing if it has no complete
/// header.
std::optional<std::int64_t> said_pixels(std::string_view bytes) {
  const auto number = [&](std::size_t at, std::size_t count) {
    std::int64_t value = 0;
    for (std::size_t i = at; i < at + count && i < bytes.size(); ++i)
      value = value * 256 + static_cast<unsigned char>(bytes[i]);
    return value;
  };
  if (bytes.starts_with("\x89PNG") && bytes.size() >= 24)
    return number(16, 4) * std::min(number(20, 4), most_allowed);
  std::int64_t most = -1;
  for (std::size_t at = 0; at + 9 < bytes.size(); ++at)
    if (const unsigned marker = static_cast<unsigned char>(bytes[at + 1]);
        bytes[at] == '\xff' && marker >= 0xc0 && marker <= 0xc2)
      most = std::max(most, number(at + 5, 2) * number(at + 7, 2));
  const std::size_t y = bytes.find("-Y ");
  const std::size_t x = bytes.find("+X ");
  if (y != std::string_view::npos && x != std::string_view::npos)
    most = std::max(most, std::int64_t{std::atoi(std::string(bytes.substr(y + 3, 9)).c_str())} *
                              std::atoi(std::string(bytes.substr(x + 3, 9)).c_str()));
  return most < 0 ? std::nullopt : std::optional(most);
}

std::string check_message(const std::string& message, const std::string& file) {
  if (message.empty()) return "an error that says nothing";
  if (!file.empty() && message.find(file) == std::string::npos)
    return "an error that does not name the file: " + message;
  return "";
}

std::string check_picture(const std::string& ending, std::string_view bytes) {
  const auto said = said_pixels(bytes);
  if (ending != ".exr" && said && *said > most_tried && *said <= most_allowed) return "";
  const std::string file = folder().write("picture" + ending, bytes);
  Image image;
  try {
    image = read_image(file);
  } catch (const std::runtime_error& error) {
    return check_message(error.what(), "");
  }
  const std::size_t count = image.pixels.size();
  if (count == 0 || static_cast<std::int64_t>(count) > most_allowed) return "no size of a picture";
  if (count != static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height))
    return "a picture of another size than it says";
  if (ending == ".png" && said != static_cast<std::int64_t>(count))
    return "a picture of another size than its file says";
  for (const Vec3<float>& pixel : image.pixels)
    if (!pixel.allFinite() || pixel.minCoeff() < 0) return "a pixel that is no light";
  const std::string again = folder().write("again.exr", text_of(encode_image(image, "again.exr")));
  if (read_image(again).pixels != image.pixels) return "another picture when it is read again";
  return "";
}

bool same_bits(const ExrPlane& a, const ExrPlane& b) {
  if (a.name != b.name || a.values.index() != b.values.index()) return false;
  if (const auto* floats = std::get_if<std::vector<float>>(&a.values))
    return std::ranges::equal(
        *floats, std::get<std::vector<float>>(b.values), {},
        [](float x) { return std::bit_cast<std::uint32_t>(x); },
        [](float x) { return std::bit_cast<std::uint32_t>(x); });
  return a.values == b.values;
}

/// Texts that Minkray writes; names that OpenEXR has a use for are not ours to write.
bool is_own(const std::string& name) {
  return name == fact::software || name.starts_with("minkray.");
}

std::string check_again(const ExrImage& exr) {
  if (exr.window.empty()) return "an empty window";
  const auto size =
      static_cast<std::size_t>(exr.window.width()) * static_cast<std::size_t>(exr.window.height());
  for (const ExrPlane& plane : exr.planes)
    if (std::visit([](const auto& values) { return values.size(); }, plane.values) != size)
      return "a plane of another size than the window";
  if (exr.display.empty()) return "";  // written by others
  ExrImage own = exr;
  std::erase_if(own.texts, [](const auto& text) { return !is_own(text.first); });
  const ExrImage again = decode_exr(text_of(encode_exr(own)), "again.exr");
  if (again.window != own.window || again.display != own.display || again.texts != own.texts)
    return "another header when it is read again";
  if (again.planes.size() != own.planes.size()) return "other planes when they are read again";
  for (const ExrPlane& plane : own.planes)
    if (const ExrPlane* same = again.find(plane.name); !same || !same_bits(*same, plane))
      return "another plane when it is read again: " + plane.name;
  return "";
}

std::string check_planes(std::string_view bytes) {
  const std::string file = folder().write("planes.exr", bytes);
  try {
    return check_again(read_exr(file));
  } catch (const BadInput& error) {
    return check_message(error.what(), file);
  }
}

std::string check_parts(const std::vector<std::string>& files, bool allow_partial) {
  try {
    const Merged merged = merge_part_files(files, allow_partial);
    if (!allow_partial && merged.missing > 0) return "parts are missing, and nothing is said";
    if (merged.costs.size() != files.size()) return "a part that has no cost";
    labels_of(merged.exr.texts);
    return check_again(merged.exr);
  } catch (const BadInput& error) {
    const std::string message = error.what();
    const bool is_named = std::ranges::any_of(
        files, [&](const std::string& file) { return message.find(file) != std::string::npos; });
    return is_named || message.starts_with("merge: ") || message.starts_with("its header")
               ? check_message(message, "")
               : "an error that names no file: " + message;
  }
}

std::string check_checkpoint(const std::string& file, const PartsOfPicture& of) {
  constexpr double never = 0;  // no checkpoint is written
  try {
    const RenderJournal journal = Checkpoint(file, of.options, of.facts, never).load();
    const PixelRect region = of.options.region();
    const auto size =
        static_cast<std::size_t>(region.width()) * static_cast<std::size_t>(region.height());
    if (journal.begun.met.size() != size) return "a checkpoint of another size";
    if (of.options.sample_share.is_all() && journal.begun.image.pixels.size() != size)
      return "a checkpoint without the picture";
    for (const Image& sums : journal.begun.block_sums)
      if (sums.pixels.size() != size) return "a checkpoint whose sums are of another size";
    if (journal.done.size() != TileGrid(region).count()) return "a checkpoint of other tiles";
    return "";
  } catch (const BadInput& error) {
    return check_message(error.what(), file);
  }
}

/// The edited images as files; nothing if no such file can be written.
std::vector<std::string> files_of(std::vector<ExrImage> images, std::string_view lines) {
  edit(images, lines);
  std::vector<std::string> files;
  try {
    for (std::size_t i = 0; i < images.size(); ++i)
      files.push_back(
          folder().write("part-" + std::to_string(i) + ".exr", text_of(encode_exr(images[i]))));
  } catch (const std::exception&) {  // OpenEXR's, of what Minkray would never write
    return {};
  }
  return files;
}

}  // namespace

std::string check_image(std::string_view bytes) {
  if (bytes.empty()) return "";
  static constexpr std::array endings = {".exr", ".hdr", ".png", ".jpg"};
  constexpr int pictures = endings.size(), planes = pictures, raw_parts = planes + 1,
                raw_checkpoint = raw_parts + 1, shares = raw_checkpoint + 1,
                checkpoints = shares + 2 * kinds_of_parts, end = checkpoints + kinds_of_checkpoints;
  const int kind = static_cast<unsigned char>(bytes.front()) % end;
  bytes.remove_prefix(1);
  if (kind < pictures) return check_picture(endings[static_cast<std::size_t>(kind)], bytes);
  if (kind == planes) return check_planes(bytes);
  if (kind == raw_parts) return check_parts({folder().write("part.exr", bytes)}, true);
  if (kind == raw_checkpoint)
    return check_checkpoint(folder().write("raw.checkpoint", bytes), checkpoint(0));
  if (kind < checkpoints) {
    const auto files = files_of(parts((kind - shares) / 2).images, bytes);
    return files.empty() ? "" : check_parts(files, (kind - shares) % 2 == 1);
  }
  const PartsOfPicture& of = checkpoint(kind - checkpoints);
  const auto files = files_of(of.images, bytes);
  return files.empty() ? "" : check_checkpoint(files.front(), of);
}

}  // namespace minkray::fuzz
