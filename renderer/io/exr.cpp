// SPDX-License-Identifier: MIT
#include "renderer/io/exr.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <OpenEXR/ImfVersion.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <deque>
#include <new>
#include <stdexcept>

#include "core/files/regular_file.h"
#include "renderer/base/errors.h"
#include "renderer/base/of_file.h"
#include "renderer/io/exr_header.h"

namespace minkray {
namespace {

/// Far more than the largest picture that can be rendered at once has pixels (2^27).
constexpr std::int64_t most_pixels = std::int64_t{1} << 30;
constexpr std::size_t most_planes = 4096;
constexpr std::size_t most_exr_bytes = std::size_t{16} << 30;
constexpr std::size_t most_header_bytes = std::size_t{256} << 20;

class ToMemory : public Imf::OStream {
 public:
  ToMemory() : Imf::OStream("memory") {}

  void write(const char bytes[], int count) override {
    const auto size = static_cast<std::size_t>(count);
    if (bytes_.size() < at_ + size) bytes_.resize(at_ + size);
    std::memcpy(bytes_.data() + at_, bytes, size);
    at_ += size;
  }
  std::uint64_t tellp() override { return at_; }
  void seekp(std::uint64_t position) override { at_ = position; }

  std::vector<unsigned char> take() { return std::move(bytes_); }

 private:
  std::vector<unsigned char> bytes_;
  std::size_t at_ = 0;
};

class FromMemory : public Imf::IStream {
 public:
  FromMemory(std::string_view bytes, const std::string& name)
      : Imf::IStream(name.c_str()), bytes_(bytes) {}

  bool read(char bytes[], int count) override {
    const auto size = static_cast<std::size_t>(count);
    if (at_ > bytes_.size() || size > bytes_.size() - at_)
      throw std::runtime_error("the file ends too early");
    std::memcpy(bytes, bytes_.data() + at_, size);
    at_ += size;
    return at_ < bytes_.size();
  }
  std::uint64_t tellg() override { return at_; }
  void seekg(std::uint64_t position) override { at_ = position; }

 private:
  std::string_view bytes_;
  std::size_t at_ = 0;
};

/// Reads only as far as requested: a header, without the data behind it.
class FromFile : public Imf::IStream {
 public:
  FromFile(RegularFile& file, const std::string& name) : Imf::IStream(name.c_str()), file_(file) {}

  bool read(char bytes[], int count) override {
    const auto size = static_cast<std::size_t>(count);
    if (size > most_header_bytes - at_) throw std::runtime_error("its header is too long");
    if (file_.read({bytes, size}) < size) throw std::runtime_error("the file ends too early");
    at_ += size;
    return true;
  }
  std::uint64_t tellg() override { return at_; }
  void seekg(std::uint64_t) override { throw std::logic_error("a header is read in order"); }

 private:
  RegularFile& file_;
  std::size_t at_ = 0;
};

Imath::Box2i box_of(const PixelRect& rect) {
  return {{rect.x0, rect.y0}, {rect.x1 - 1, rect.y1 - 1}};
}

PixelRect rect_of(const Imath::Box2i& box) {
  // In a damaged file the numbers may be anything; what is too large is no picture of ours.
  constexpr int limit = 1 << 30;
  const auto sane = [](int x) { return x > -limit && x < limit; };
  if (!sane(box.min.x) || !sane(box.min.y) || !sane(box.max.x) || !sane(box.max.y))
    throw std::runtime_error("its windows are too large");
  return {box.min.x, box.min.y, box.max.x + 1, box.max.y + 1};
}

std::size_t pixel_count(const PixelRect& rect) {
  return static_cast<std::size_t>(rect.width()) * static_cast<std::size_t>(rect.height());
}

/// The plane's numbers as the library wants them: the address that pixel (0, 0) would have.
template <class Number>
Imf::Slice slice_of(Imf::PixelType type, const std::vector<Number>& numbers,
                    const PixelRect& window) {
  auto* base = reinterpret_cast<char*>(const_cast<Number*>(numbers.data()));
  return Imf::Slice::Make(type, base, box_of(window), sizeof(Number),
                          sizeof(Number) * static_cast<std::size_t>(window.width()));
}

Imf::Slice slice_of(const ExrPlane& plane, const PixelRect& window) {
  if (const auto* floats = std::get_if<std::vector<float>>(&plane.values))
    return slice_of(Imf::FLOAT, *floats, window);
  return slice_of(Imf::UINT, std::get<std::vector<std::uint32_t>>(plane.values), window);
}

std::map<std::string, std::string> texts_of(const Imf::Header& header) {
  std::map<std::string, std::string> texts;
  for (auto it = header.begin(); it != header.end(); ++it)
    if (const auto* text = dynamic_cast<const Imf::StringAttribute*>(&it.attribute()))
      texts[it.name()] = text->value();
  return texts;
}

BadInput unusable(const std::string& file, const std::exception& error) {
  return BadInput(file + ": cannot be used as an OpenEXR image: " + error.what());
}

BadInput too_large(const std::string& file) {
  return BadInput(file + ": not enough memory to read it");
}

/// First bytes of an OpenEXR file.
constexpr std::array<char, 4> magic = {0x76, 0x2f, 0x31, 0x01};

/// The pixels that a header promises. In a damaged file the numbers may be anything.
PixelRect window_of(const Imf::Header& header) {
  const PixelRect window = rect_of(header.dataWindow());
  if (window.empty() || std::int64_t{window.width()} * window.height() > most_pixels)
    throw std::runtime_error("its data window is empty or too large");
  return window;
}

void check_attributes(const ReadOn& read) {
  if (!has_whole_exr_attributes(read))
    throw std::runtime_error(
        "its header is cut off, or an attribute of it ends where it should not");
}

std::size_t count_channels(const Imf::Header& header) {
  std::size_t channels = 0;
  for (auto it = header.channels().begin(); it != header.channels().end(); ++it) ++channels;
  return channels;
}

/// The first header, from the file's first byte on. Throws if it is of no picture that is read: the
/// library would take memory, or time, on a damaged header's word.
Imf::Header read_header(Imf::IStream& stream, std::size_t file_bytes) {
  std::array<char, 4> begin, version;
  stream.read(begin.data(), begin.size());
  if (begin != magic)
    throw std::runtime_error("it does not begin with the bytes of an OpenEXR file");
  stream.read(version.data(), version.size());
  Imf::Header header;
  int flags = 0;
  std::memcpy(&flags, version.data(), sizeof flags);
  header.readFrom(stream, flags);
  if (Imf::isNonImage(flags) || (header.hasType() && Imf::isDeepData(header.type())))
    throw std::runtime_error("deep images are not read");
  const std::size_t channels = count_channels(header);
  if (channels > most_planes) throw std::runtime_error("it has too many channels");
  // Compression saves at most a factor of about 1000 of two bytes a number, or more.
  constexpr std::size_t best_compression = 2000;
  if (pixel_count(window_of(header)) * channels * 2 / best_compression > file_bytes)
    throw std::runtime_error("the file ends too early");
  return header;
}

/// Reads the header alone. Throws if the file is no OpenEXR file, or far longer than its header
/// implies.
Imf::Header header_of(RegularFile& file, const std::string& name) {
  RegularFile ahead(name);
  std::size_t left = most_header_bytes;
  check_attributes([&](std::span<char> buffer) {
    if (buffer.size() > left) throw std::runtime_error("its header is too long");
    left -= buffer.size();
    return ahead.read(buffer) == buffer.size();
  });
  FromFile stream(file, name);
  const Imf::Header header = read_header(stream, file.size());
  // Uncompressed, twice over, and what else there is in a file.
  const std::size_t most = 8 * pixel_count(window_of(header)) * count_channels(header) +
                           static_cast<std::size_t>(stream.tellg()) + (std::size_t{1} << 20);
  if (file.size() > most)
    throw std::runtime_error("its " + std::to_string(file.size()) +
                             " bytes are far more than its header says");
  return header;
}

}  // namespace

const ExrPlane* ExrImage::find(std::string_view name) const {
  const auto at = std::find_if(planes.begin(), planes.end(),
                               [&](const ExrPlane& plane) { return plane.name == name; });
  return at == planes.end() ? nullptr : &*at;
}

void add_colour_planes(ExrImage& exr, const Image& image, const std::string& before) {
  for (int channel = 0; channel < 3; ++channel) {
    std::vector<float> values;
    values.reserve(image.pixels.size());
    for (const Vec3<float>& pixel : image.pixels) values.push_back(pixel[channel]);
    exr.planes.push_back({before + "RGB"[channel], std::move(values)});
  }
}

std::vector<unsigned char> encode_exr(const ExrImage& image) {
  Imf::Header header(box_of(image.display), box_of(image.window));
  header.compression() = Imf::ZIP_COMPRESSION;
  for (const auto& [name, text] : image.texts) header.insert(name, Imf::StringAttribute(text));
  Imf::FrameBuffer pixels;
  std::deque<std::vector<half>> halfs;
  for (const ExrPlane& plane : image.planes) {
    const auto* floats = std::get_if<std::vector<float>>(&plane.values);
    if (plane.is_half && floats) halfs.emplace_back(floats->begin(), floats->end());
    const Imf::Slice slice = plane.is_half && floats
                                 ? slice_of(Imf::HALF, halfs.back(), image.window)
                                 : slice_of(plane, image.window);
    header.channels().insert(plane.name, Imf::Channel(slice.type));
    pixels.insert(plane.name, slice);
  }
  ToMemory memory;
  {
    Imf::OutputFile file(memory, header, 0);
    file.setFrameBuffer(pixels);
    file.writePixels(image.window.height());
  }
  return memory.take();
}

ExrImage decode_exr(std::string_view bytes, const std::string& file) {
  try {
    std::string_view left = bytes;
    check_attributes([&](std::span<char> buffer) {
      if (left.size() < buffer.size()) return false;
      std::copy_n(left.begin(), buffer.size(), buffer.begin());
      left.remove_prefix(buffer.size());
      return true;
    });
    FromMemory memory(bytes, file);
    const Imf::Header header = read_header(memory, bytes.size());
    memory.seekg(0);
    Imf::InputFile in(memory, 0);
    ExrImage image{rect_of(header.displayWindow()), window_of(header), {}, {}};
    image.texts = texts_of(header);
    for (auto it = header.channels().begin(); it != header.channels().end(); ++it) {
      if (it.channel().xSampling != 1 || it.channel().ySampling != 1)
        throw std::runtime_error(std::string("its channel ") + it.name() + " is subsampled");
      ExrPlane plane{it.name(), std::vector<float>()};
      if (it.channel().type == Imf::UINT) plane.values = std::vector<std::uint32_t>();
      image.planes.push_back(std::move(plane));
    }
    Imf::FrameBuffer target;
    for (ExrPlane& plane : image.planes) {
      std::visit([&](auto& values) { values.resize(pixel_count(image.window)); }, plane.values);
      target.insert(plane.name, slice_of(plane, image.window));
    }
    in.setFrameBuffer(target);
    in.readPixels(image.window.y0, image.window.y1 - 1);
    return image;
  } catch (const std::bad_alloc&) {
    throw too_large(file);
  } catch (const std::exception& error) {
    throw unusable(file, error);
  }
}

bool is_exr(const std::string& file) {
  try {
    std::array<char, magic.size()> begin = {};
    return RegularFile(file).read(begin) == begin.size() && begin == magic;
  } catch (const std::runtime_error&) {
    return false;
  }
}

ExrImage read_exr(const std::string& file) {
  read_exr_texts(file);  // of what is none, no more is read
  return of_file(file, [&] { return decode_exr(read_regular_file(file, most_exr_bytes), file); });
}

std::map<std::string, std::string> read_exr_texts(const std::string& name) {
  return of_file(name, [&] {
    RegularFile file(name);
    try {
      return texts_of(header_of(file, name));
    } catch (const std::bad_alloc&) {
      throw;
    } catch (const std::exception& error) {
      throw unusable(name, error);
    }
  });
}

}  // namespace minkray
