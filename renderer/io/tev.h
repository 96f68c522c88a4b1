// SPDX-License-Identifier: MIT
// Shows a picture in the viewer tev while it renders, over tev's network protocol: packets that
// begin with length and kind, little-endian numbers, zero-terminated texts (Tom94/tev, packets
// CreateImage and UpdateImageV3).
#pragma once

#include <string>

#include "renderer/image/image.h"

namespace minkray {

/// Default port of tev.
inline constexpr const char* tev_port = "14158";

class TevPicture {
 public:
  /// Opens a picture of that name and size in the viewer that listens at "HOST:PORT", or at HOST
  /// and its usual port. Throws CannotWrite if none does.
  TevPicture(const std::string& address, const std::string& name, int width, int height);
  ~TevPicture();
  TevPicture(const TevPicture&) = delete;
  TevPicture& operator=(const TevPicture&) = delete;

  /// Shows a part of the image, which is as large as the picture. Does nothing once the viewer has
  /// gone.
  void show(const Image& image, const PixelRect& part);

  /// The error, if any: the picture itself does not need its viewer.
  const std::string& complaint() const { return complaint_; }

 private:
  void send(const std::string& packet);

  std::string name_;
  int socket_ = -1;
  std::string complaint_;
};

}  // namespace minkray
