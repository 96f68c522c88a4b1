// SPDX-License-Identifier: MIT
// Web server for this machine only: listens at 127.0.0.1, replies to GET under an address with a
// secret, and reads no file.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <string_view>

namespace minkray {

/// The parsed request: "/TOKEN/cast?x=1" has the path "cast" and the value "1" of "x".
struct WebRequest {
  std::string path;
  std::map<std::string, std::string> values;
  /// True if the client has disconnected. Thread-safe.
  std::function<bool()> is_abandoned = [] { return false; };
};

struct WebReply {
  int status = 200;
  std::string type = "text/plain; charset=utf-8";
  std::string body;
};

/// Reads the first line and the headers of a request (RFC 9112); nothing, and the reply it
/// deserves, if they are not a GET of a page under /TOKEN/ from this machine's own address: other
/// pages in the same browser know neither the token nor may they be sent here under a name of
/// theirs.
bool parse_request(std::string_view text, std::string_view token, int port, WebRequest& request,
                   WebReply& refusal);

class LoopbackServer {
 public:
  /// Listens at a port, or at any that is free (0). Throws WrongUsage if the port is taken.
  explicit LoopbackServer(int port);
  ~LoopbackServer();
  LoopbackServer(const LoopbackServer&) = delete;
  LoopbackServer& operator=(const LoopbackServer&) = delete;

  /// "http://127.0.0.1:PORT/TOKEN/"
  std::string address() const;

  /// Answers one request after another until `stopped` returns true; called a few times per second
  /// and at each request.
  void serve(const std::function<WebReply(const WebRequest&)>& answer,
             const std::function<bool()>& stopped);

 private:
  int socket_ = -1, port_ = 0;
  std::string token_;
};

}  // namespace minkray
