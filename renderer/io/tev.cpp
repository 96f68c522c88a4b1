// SPDX-License-Identifier: MIT
#include "renderer/io/tev.h"

#include <netdb.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <bit>
#include <cerrno>
#include <cstdint>
#include <cstring>

#include "renderer/base/errors.h"

namespace minkray {
namespace {

enum class Packet : char { create_image = 4, update_image = 6 };

constexpr std::array channels = {'R', 'G', 'B'};

/// A viewer that takes nothing for so long has gone.
constexpr int patience_seconds = 5;

/// A packet of tev's, whose length is put in front when all of it is there.
class PacketText {
 public:
  PacketText(Packet kind, const std::string& name) : bytes_(4, '\0') {
    bytes_ += static_cast<char>(kind);
    bytes_ += '\0';  // does not change the selected image in the viewer
    text(name);
  }
  void text(const std::string& text) { bytes_ += text + '\0'; }
  void number(std::int32_t number) { integer(static_cast<std::uint32_t>(number), 4); }
  void long_number(std::int64_t number) { integer(static_cast<std::uint64_t>(number), 8); }
  void real(float number) { integer(std::bit_cast<std::uint32_t>(number), 4); }
  void channel_names() {
    number(static_cast<std::int32_t>(channels.size()));
    for (const char channel : channels) text(std::string(1, channel));
  }
  std::string take() && {
    const std::size_t length = bytes_.size();
    for (int i = 0; i < 4; ++i)
      bytes_[static_cast<std::size_t>(i)] = static_cast<char>(length >> 8 * i);
    return std::move(bytes_);
  }

 private:
  void integer(std::uint64_t number, int bytes) {
    for (int i = 0; i < bytes; ++i) bytes_ += static_cast<char>(number >> 8 * i);
  }
  std::string bytes_;
};

/// A socket that is connected to where tev listens. Throws CannotWrite.
int connected(const std::string& address) {
  const std::size_t colon = address.rfind(':');
  const std::string host = address.substr(0, colon);
  const std::string port = colon == std::string::npos ? tev_port : address.substr(colon + 1);
  addrinfo wanted{};
  wanted.ai_socktype = SOCK_STREAM;
  addrinfo* found = nullptr;
  if (const int error = getaddrinfo(host.c_str(), port.c_str(), &wanted, &found); error != 0)
    throw CannotWrite("--tev: " + address + ": " + gai_strerror(error));
  int connection = -1;
  std::string why;
  for (const addrinfo* at = found; at && connection < 0; at = at->ai_next) {
    connection = socket(at->ai_family, at->ai_socktype | SOCK_CLOEXEC, at->ai_protocol);
    if (connection >= 0 && connect(connection, at->ai_addr, at->ai_addrlen) == 0) break;
    why = std::strerror(errno);
    if (connection >= 0) close(connection);
    connection = -1;
  }
  freeaddrinfo(found);
  if (connection < 0) throw CannotWrite("--tev: no viewer listens at " + address + ": " + why);
  const timeval patience{patience_seconds, 0};
  setsockopt(connection, SOL_SOCKET, SO_SNDTIMEO, &patience, sizeof patience);
  return connection;
}

}  // namespace

TevPicture::TevPicture(const std::string& address, const std::string& name, int width, int height)
    : name_(name), socket_(connected(address)) {
  PacketText packet(Packet::create_image, name_);
  packet.number(width);
  packet.number(height);
  packet.channel_names();
  send(std::move(packet).take());
}

TevPicture::~TevPicture() {
  close(socket_);
}

void TevPicture::show(const Image& image, const PixelRect& part) {
  if (!complaint_.empty()) return;
  PacketText packet(Packet::update_image, name_);
  packet.channel_names();
  packet.number(part.x0);
  packet.number(part.y0);
  packet.number(part.width());
  packet.number(part.height());
  // Offset of each channel's first number, and the stride from one pixel to the next.
  const auto stride = static_cast<std::int64_t>(channels.size());
  for (std::int64_t channel = 0; channel < stride; ++channel) packet.long_number(channel);
  for (std::int64_t channel = 0; channel < stride; ++channel) packet.long_number(stride);
  for (int y = part.y0; y < part.y1; ++y)
    for (int x = part.x0; x < part.x1; ++x)
      for (int channel = 0; channel < 3; ++channel) packet.real(image.at(x, y)[channel]);
  send(std::move(packet).take());
}

void TevPicture::send(const std::string& packet) {
  std::size_t sent = 0;
  while (sent < packet.size()) {
    const ssize_t more = ::send(socket_, packet.data() + sent, packet.size() - sent, MSG_NOSIGNAL);
    if (more < 0 && errno == EINTR) continue;
    if (more <= 0) {
      complaint_ = std::string("the viewer has gone: ") + std::strerror(errno);
      return;
    }
    sent += static_cast<std::size_t>(more);
  }
}

}  // namespace minkray
