// SPDX-License-Identifier: MIT
#include "renderer/io/deflate.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <stdexcept>

namespace minkray {

struct Deflater::Stream {
  z_stream z = {};
  std::vector<unsigned char> out;

  /// Takes what is to be taken and gives all that there is to give.
  void run(std::span<const unsigned char> bytes, int flush) {
    // zlib promises not to write to it.
    z.next_in = const_cast<unsigned char*>(bytes.data());
    std::size_t left = bytes.size();
    std::array<unsigned char, 1 << 15> block;
    for (;;) {
      const auto given = static_cast<unsigned>(std::min<std::size_t>(left, 1u << 30));
      left -= given;
      z.avail_in = given;
      do {
        z.next_out = block.data();
        z.avail_out = static_cast<unsigned>(block.size());
        if (deflate(&z, left > 0 ? Z_NO_FLUSH : flush) == Z_STREAM_ERROR)
          throw std::logic_error("deflate: the stream has ended");
        out.insert(out.end(), block.data(), z.next_out);
      } while (z.avail_out == 0);
      if (left == 0) return;
    }
  }
};

Deflater::Deflater() : stream_(std::make_unique<Stream>()) {
  if (deflateInit(&stream_->z, Z_BEST_COMPRESSION) != Z_OK)
    throw std::runtime_error("deflate: there is no memory");
}

Deflater::~Deflater() {
  deflateEnd(&stream_->z);
}

void Deflater::add(std::span<const unsigned char> bytes) {
  if (!bytes.empty()) stream_->run(bytes, Z_NO_FLUSH);
}

void Deflater::add(std::string_view text) {
  add(std::span(reinterpret_cast<const unsigned char*>(text.data()), text.size()));
}

std::size_t Deflater::size() {
  stream_->run({}, Z_SYNC_FLUSH);
  return stream_->out.size();
}

std::vector<unsigned char> Deflater::finish() {
  stream_->run({}, Z_FINISH);
  return std::move(stream_->out);
}

}  // namespace minkray
