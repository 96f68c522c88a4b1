// SPDX-License-Identifier: MIT
// Connections that send nothing, or no end of a request, delay no other reply: other users of the
// machine can open them without the token, and so can any page in the browser.
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <time.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <chrono>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "renderer/inspect/loopback.h"

namespace minkray {
namespace {

/// "http://127.0.0.1:PORT/TOKEN/"
struct Address {
  std::uint16_t port;
  std::string path;
  explicit Address(const std::string& url)
      : port(static_cast<std::uint16_t>(std::stoi(url.substr(17)))),
        path(url.substr(url.find('/', 17))) {}
};

class Client {
 public:
  explicit Client(const Address& address) : socket_(::socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in place{};
    place.sin_family = AF_INET;
    place.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    place.sin_port = htons(address.port);
    EXPECT_EQ(::connect(socket_, reinterpret_cast<sockaddr*>(&place), sizeof place), 0);
    const timeval patience{5, 0};
    ::setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
  }
  Client(Client&& other) noexcept : socket_(std::exchange(other.socket_, -1)) {}
  Client& operator=(Client&&) = delete;
  ~Client() {
    if (socket_ >= 0) ::close(socket_);
  }
  void send(const std::string& text) const {
    ::send(socket_, text.data(), text.size(), MSG_NOSIGNAL);
  }
  std::string heard() const {
    std::string all;
    char block[512];
    for (ssize_t count; (count = ::recv(socket_, block, sizeof block, 0)) > 0;)
      all.append(block, static_cast<std::size_t>(count));
    return all;
  }
  /// True if the server has closed it, within the patience.
  bool is_left() const {
    char next;
    const ssize_t count = ::recv(socket_, &next, 1, 0);
    return count == 0 || (count < 0 && errno == ECONNRESET);
  }

 private:
  int socket_;
};

/// A server that answers "well".
class Serving {
 public:
  Serving()
      : thread_([this] {
          server_.serve(
              [](const WebRequest&) {
                return WebReply{200, "text/plain", "well"};
              },
              [this] { return over_.load(); });
        }) {}
  ~Serving() {
    over_ = true;
    thread_.join();
  }
  Address address() const { return Address(server_.address()); }

 private:
  LoopbackServer server_{0};
  std::atomic<bool> over_ = false;
  std::thread thread_;
};

std::string answer_at(const Address& address) {
  const Client client(address);
  client.send("GET " + address.path +
              " HTTP/1.1\r\nHost: 127.0.0.1:" + std::to_string(address.port) + "\r\n\r\n");
  return client.heard();
}

/// Until now the 65th connection waited for 20 seconds, and for ever if each of the others sent a
/// byte now and then.
TEST(LoopbackCrowd, a_hundred_connections_that_say_nothing_keep_nobody_out) {
  const Serving serving;
  const Address address = serving.address();
  std::vector<Client> idle;
  for (int i = 0; i < 100; ++i) {
    idle.emplace_back(address);
    if (i % 2 == 0) idle.back().send("GET /");
  }
  EXPECT_TRUE(answer_at(address).ends_with("well"));
  EXPECT_TRUE(idle.front().is_left());
}

/// The server polled without end for new ones, while none was accepted.
TEST(LoopbackCrowd, waits_without_work) {
  const Serving serving;
  const Address address = serving.address();
  std::vector<Client> idle;
  for (int i = 0; i < 70; ++i) idle.emplace_back(address);
  EXPECT_TRUE(answer_at(address).ends_with("well"));
  const auto processor = [] {
    timespec time{};
    ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return double(time.tv_sec) + 1e-9 * double(time.tv_nsec);
  };
  const double begin = processor();
  std::this_thread::sleep_for(std::chrono::seconds(1));
  EXPECT_LT(processor() - begin, 0.1);
}

}  // namespace
}  // namespace minkray
