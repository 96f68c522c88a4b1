// SPDX-License-Identifier: MIT
// Access to `minkray inspect --serve`: with the token, at this machine's own address.
#include "renderer/inspect/loopback.h"

#include <gtest/gtest.h>

namespace minkray {
namespace {

constexpr const char* token = "0123456789abcdef";

/// The status of the refusal; 200: the request is one to be answered.
int status_of(const std::string& text, WebRequest* request = nullptr) {
  WebRequest parsed;
  WebReply refusal;
  const bool is_good = parse_request(text, token, 8123, parsed, refusal);
  if (request) *request = parsed;
  return is_good ? 200 : refusal.status;
}

const std::string host = " HTTP/1.1\r\nHost: 127.0.0.1:8123";

TEST(Loopback, a_request_is_taken_apart) {
  WebRequest request;
  EXPECT_EQ(status_of("GET /0123456789abcdef/cast?x=1.5&y=%2D2%2c3&empty=&bare" + host, &request),
            200);
  EXPECT_EQ(request.path, "cast");
  EXPECT_EQ(request.values, (std::map<std::string, std::string>{
                                {"x", "1.5"}, {"y", "-2,3"}, {"empty", ""}, {"bare", ""}}));
  EXPECT_EQ(status_of("GET /0123456789abcdef/" + host, &request), 200);
  EXPECT_EQ(request.path, "");
  EXPECT_EQ(status_of("GET /0123456789abcdef/ HTTP/1.1\r\nAccept: */*\r\nhOST:   localhost:8123"),
            200);
}

TEST(Loopback, without_the_token_there_is_nothing) {
  for (const char* path : {"/", "/cast", "/0123456789abcdeF/", "/0123456789abcde/", "//",
                           "/0123456789abcdef0/", "0123456789abcdef/", "/../0123456789abcdef/"})
    EXPECT_EQ(status_of(std::string("GET ") + path + host), 404) << path;
}

/// A proxy might use the first and we the last (RFC 9112, 3.2).
TEST(Loopback, a_request_has_one_host) {
  EXPECT_EQ(status_of("GET /0123456789abcdef/" + host + "\r\nHost: example.com"), 400);
  EXPECT_EQ(
      status_of("GET /0123456789abcdef/ HTTP/1.1\r\nHost: example.com\r\nHost: 127.0.0.1:8123"),
      400);
}

/// A page of somebody else's name that is resolved to 127.0.0.1 (DNS rebinding).
TEST(Loopback, under_another_name_nothing_is_answered) {
  for (const char* name : {"example.com:8123", "127.0.0.1", "127.0.0.1:8124", "127.0.0.1:81230",
                           "127.0.0.1.example.com:8123", ""})
    EXPECT_EQ(status_of("GET /0123456789abcdef/ HTTP/1.1\r\nHost: " + std::string(name)), 421)
        << name;
  EXPECT_EQ(status_of("GET /0123456789abcdef/ HTTP/1.1"), 421);
}

TEST(Loopback, nothing_but_get_is_answered) {
  for (const char* method : {"POST", "HEAD", "OPTIONS", "PUT", "get", ""})
    EXPECT_EQ(status_of(std::string(method) + " /0123456789abcdef/" + host), 405) << method;
  EXPECT_EQ(status_of("GET /0123456789abcdef/ HTTP/2\r\nHost: 127.0.0.1:8123"), 400);
  EXPECT_EQ(status_of("GET"), 400);
  EXPECT_EQ(status_of(""), 405);
}

TEST(Loopback, every_server_has_a_token_of_its_own_at_this_machine_alone) {
  const LoopbackServer a(0), b(0);
  EXPECT_TRUE(a.address().starts_with("http://127.0.0.1:"));
  const auto token_of = [](const std::string& address) {
    return address.substr(address.find('/', 8) + 1);
  };
  EXPECT_EQ(token_of(a.address()).size(), 33u);  // 128 bits, and a slash
  EXPECT_NE(token_of(a.address()), token_of(b.address()));
}

}  // namespace
}  // namespace minkray
