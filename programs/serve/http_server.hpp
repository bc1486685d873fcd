// SPDX-License-Identifier: Apache-2.0
// HTTP and TLS, by GNU libmicrohttpd. Each connection has a thread, so an answer may wait for a launch.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <string>

#include "base/files/unique_fd.hpp"
#include "programs/serve/http_message.hpp"

namespace launch::serve {

struct Certificate {
  std::string certificate;  // PEM, with the chain behind it
  std::string key;          // PEM
};

class HttpServer {
 public:
  static constexpr unsigned kMostConnections = 96;
  static constexpr unsigned kMostOfClient = 32;  // connections of one address
  static constexpr std::size_t kLongestBody = std::size_t{64} * 1024;
  static constexpr std::size_t kLongestHead = std::size_t{32} * 1024;

  // `answer` is called by several threads at once. `listener` is a socket that listens. `certificate` is null for HTTP
  // without TLS. Throws std::runtime_error.
  HttpServer(UniqueFd listener, const Certificate* certificate, std::function<HttpAnswer(const HttpRequest&)> answer);
  // Waits for the answers that are being given; those of feeds must end by themselves.
  ~HttpServer();
  HttpServer(const HttpServer&) = delete;
  HttpServer& operator=(const HttpServer&) = delete;

  // To be called each second or so.
  void cut_late_connections();

  struct Daemon;

 private:
  std::unique_ptr<Daemon> daemon_;
};

}  // namespace launch::serve
