// SPDX-License-Identifier: MIT
// Compresses bytes as they arrive (zlib, RFC 1950), in a format that browsers decompress. Only
// deflate.cpp includes zlib.
#pragma once

#include <memory>
#include <span>
#include <string_view>
#include <vector>

namespace minkray {

class Deflater {
 public:
  Deflater();
  ~Deflater();

  void add(std::span<const unsigned char> bytes);
  void add(std::string_view text);

  /// Number of bytes if the data ended here. Each call costs some bytes.
  std::size_t size();

  /// The whole stream; nothing is to be added after.
  std::vector<unsigned char> finish();

 private:
  struct Stream;
  std::unique_ptr<Stream> stream_;
};

}  // namespace minkray
