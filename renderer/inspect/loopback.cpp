// SPDX-License-Identifier: MIT
#include "renderer/inspect/loopback.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <random>
#include <system_error>
#include <utility>
#include <vector>

#include "core/files/text.h"
#include "renderer/base/errors.h"

namespace minkray {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t most_bytes_of_request = 8192;
/// Limit of open connections; the oldest is closed first, since requests follow at once.
constexpr std::size_t most_connections = 64;
/// Time within which a request must be complete. Browsers open connections in advance, which are
/// silent for a while.
constexpr auto longest_request = std::chrono::seconds(20);
/// Time after which a reader that receives nothing is dropped.
constexpr int longest_write_ms = 5000;
constexpr int poll_ms = 200;

/// 128 random bits.
std::string random_token() {
  std::random_device random;
  std::string token;
  for (int i = 0; i < 4; ++i) {
    const unsigned word = random();
    for (int shift = 28; shift >= 0; shift -= 4) token += "0123456789abcdef"[word >> shift & 15];
  }
  return token;
}

std::string lower(std::string_view text) {
  std::string result;
  for (const char c : text) result += c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return result;
}

/// "%2C" is a comma, "+" a blank.
std::string decoded(std::string_view text) {
  std::string result;
  for (std::size_t i = 0; i < text.size(); ++i) {
    unsigned code = 0;
    if (text[i] == '%' && i + 2 < text.size() && read_number(text.substr(i + 1, 2), code, 16)) {
      result += static_cast<char>(code);
      i += 2;
    } else {
      result += text[i] == '+' ? ' ' : text[i];
    }
  }
  return result;
}

std::string_view word(std::string_view& text, char end) {
  const std::size_t at = text.find(end);
  const std::string_view first = text.substr(0, at);
  text.remove_prefix(at == std::string_view::npos ? text.size() : at + 1);
  return first;
}

/// Takes the same time however much of a guess was right.
bool is_same_secret(std::string_view a, std::string_view b) {
  if (a.size() != b.size()) return false;
  unsigned different = 0;
  for (std::size_t i = 0; i < a.size(); ++i) different |= static_cast<unsigned>(a[i] ^ b[i]);
  return different == 0;
}

std::string whole_reply(const WebReply& reply) {
  return "HTTP/1.1 " + std::to_string(reply.status) + (reply.status == 200 ? " OK" : " Refused") +
         "\r\nContent-Type: " + reply.type +
         "\r\nContent-Length: " + std::to_string(reply.body.size()) +
         "\r\nConnection: close\r\nCache-Control: no-store\r\nX-Content-Type-Options: nosniff"
         "\r\nReferrer-Policy: no-referrer\r\nCross-Origin-Resource-Policy: same-origin"
         "\r\nX-Frame-Options: DENY\r\n\r\n" +
         reply.body;
}

/// A socket that is closed at the end.
class Connection {
 public:
  explicit Connection(int socket) : socket_(socket) {}
  Connection(Connection&& other) noexcept
      : socket_(std::exchange(other.socket_, -1)),
        begun_(other.begun_),
        request(std::move(other.request)) {}
  Connection& operator=(Connection&& other) noexcept {
    std::swap(socket_, other.socket_);
    begun_ = other.begun_;
    request = std::move(other.request);
    return *this;
  }
  ~Connection() {
    if (socket_ >= 0) ::close(socket_);
  }
  int socket() const { return socket_; }
  Clock::duration age() const { return Clock::now() - begun_; }

  /// Takes what is there; false if the other side is gone.
  bool read() {
    char block[4096];
    const ssize_t count = ::recv(socket_, block, sizeof block, MSG_DONTWAIT);
    if (count <= 0) return count < 0 && (errno == EAGAIN || errno == EINTR);
    request.append(block, static_cast<std::size_t>(count));
    return true;
  }
  /// True if the other side has closed the connection.
  bool is_closed() const {
    char next;
    const ssize_t count = ::recv(socket_, &next, 1, MSG_PEEK | MSG_DONTWAIT);
    return count == 0 || (count < 0 && errno != EAGAIN && errno != EINTR);
  }
  void write(std::string_view text) {
    while (!text.empty()) {
      const ssize_t count = ::send(socket_, text.data(), text.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
      if (count > 0) {
        text.remove_prefix(static_cast<std::size_t>(count));
      } else if (errno == EAGAIN) {
        pollfd ready{socket_, POLLOUT, 0};
        if (::poll(&ready, 1, longest_write_ms) <= 0) return;
      } else if (errno != EINTR) {
        return;
      }
    }
  }

 private:
  int socket_;
  Clock::time_point begun_ = Clock::now();

 public:
  std::string request;
};

}  // namespace

bool parse_request(std::string_view text, std::string_view token, int port, WebRequest& request,
                   WebReply& refusal) {
  const auto refuse = [&](int status, const char* why) {
    refusal = {status, "text/plain; charset=utf-8", why};
    return false;
  };
  std::string_view line = word(text, '\n');
  if (word(line, ' ') != "GET") return refuse(405, "only GET is answered\n");
  std::string_view target = word(line, ' ');
  if (!line.starts_with("HTTP/1.")) return refuse(400, "no request of HTTP/1\n");
  std::string host;
  int hosts = 0;
  while (!text.empty()) {
    std::string_view header = word(text, '\n');
    const std::string name = lower(word(header, ':'));
    while (!header.empty() && (header.back() == '\r' || header.back() == ' '))
      header.remove_suffix(1);
    while (!header.empty() && header.front() == ' ') header.remove_prefix(1);
    if (name != "host") continue;
    host = header;
    ++hosts;
  }
  if (hosts > 1) return refuse(400, "more than one host\n");
  const std::string number = ":" + std::to_string(port);
  if (host != "127.0.0.1" + number && host != "localhost" + number)
    return refuse(421, "this is another machine's name\n");
  if (!word(target, '/').empty()) return refuse(404, "there is nothing here\n");
  if (!is_same_secret(word(target, '/'), token)) return refuse(404, "there is nothing here\n");
  request.path = decoded(word(target, '?'));
  while (!target.empty()) {
    std::string_view value = word(target, '&');
    const std::string key = decoded(word(value, '='));
    request.values[key] = decoded(value);
  }
  return true;
}

LoopbackServer::LoopbackServer(int port) : token_(random_token()) {
  socket_ = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
  const auto fail = [&](const char* what) {
    const std::string why = std::generic_category().message(errno);
    if (socket_ >= 0) ::close(socket_);
    throw WrongUsage("--port: " + std::string(what) + ": " + why);
  };
  if (socket_ < 0) fail("no socket available");
  const int on = 1;
  ::setsockopt(socket_, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  auto* const any = reinterpret_cast<sockaddr*>(&address);
  socklen_t size = sizeof address;
  if (::bind(socket_, any, size) < 0) fail("cannot listen there");
  if (::listen(socket_, SOMAXCONN) < 0) fail("cannot listen there");
  ::getsockname(socket_, any, &size);
  port_ = ntohs(address.sin_port);
}

LoopbackServer::~LoopbackServer() {
  ::close(socket_);
}

std::string LoopbackServer::address() const {
  return "http://127.0.0.1:" + std::to_string(port_) + "/" + token_ + "/";
}

void LoopbackServer::serve(const std::function<WebReply(const WebRequest&)>& answer,
                           const std::function<bool()>& stopped) {
  std::vector<Connection> open;
  while (!stopped()) {
    std::vector<pollfd> waits{{socket_, POLLIN, 0}};
    for (const Connection& connection : open) waits.push_back({connection.socket(), POLLIN, 0});
    if (::poll(waits.data(), waits.size(), poll_ms) < 0)
      continue;  // a signal: stopped() returns true
    std::vector<Connection> still_open;
    for (std::size_t i = 0; i < open.size(); ++i) {
      Connection& connection = open[i];
      if (waits[i + 1].revents != 0 && !connection.read()) continue;
      const std::size_t end = connection.request.find("\r\n\r\n");
      if (end == std::string::npos) {
        if (connection.request.size() < most_bytes_of_request && connection.age() < longest_request)
          still_open.push_back(std::move(connection));
        continue;
      }
      WebRequest request;
      WebReply reply;
      request.is_abandoned = [&connection] { return connection.is_closed(); };
      if (parse_request(std::string_view(connection.request).substr(0, end), token_, port_, request,
                        reply))
        reply = answer(request);
      if (stopped()) return;
      connection.write(whole_reply(reply));
    }
    open = std::move(still_open);
    for (std::size_t i = 0; waits[0].revents != 0 && i < most_connections; ++i) {
      const int socket = ::accept4(socket_, nullptr, nullptr, SOCK_CLOEXEC);
      if (socket < 0) break;
      open.emplace_back(socket);
      if (open.size() > most_connections) open.erase(open.begin());
    }
  }
}

}  // namespace minkray
