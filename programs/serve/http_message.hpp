// SPDX-License-Identifier: Apache-2.0
// A request and its answer as plain data, so that what is decided about them needs no network.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace launch::serve {

struct HttpRequest {
  std::string method;                         // "GET"
  std::string path;                           // "/api/launches", decoded
  std::map<std::string, std::string> query;   // decoded; of several with a name, the last one
  std::map<std::string, std::string> header;  // names in small letters; of several with a name, the last one
  std::map<std::string, std::string> cookies;
  std::string body;
  std::string client;           // its address, for what is logged
  bool ambiguous_head = false;  // it has a header twice that decides something

  const std::string& header_or_empty(const std::string& name) const {
    static const std::string empty;
    const auto found = header.find(name);
    return found == header.end() ? empty : found->second;
  }
};

// Gives the next part of an answer that does not end by itself; waits for it. Nothing: the answer ends. Called on the
// thread of the connection.
using AnswerParts = std::function<std::optional<std::string>()>;

struct HttpAnswer {
  int status = 200;
  std::string type = "application/json";
  std::vector<std::pair<std::string, std::string>> header{};
  std::string body{};
  AnswerParts parts{};  // instead of the body
};

}  // namespace launch::serve
