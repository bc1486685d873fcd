// SPDX-License-Identifier: Apache-2.0
// The frames of the Language Server Protocol: a head with Content-Length, then JSON.
#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>

namespace launch::lsp {

using Json = nlohmann::json;

// Takes what an editor sends, in whatever pieces it comes.
class MessageReader {
 public:
  void add(std::string_view bytes) { bytes_ += bytes; }

  // The next whole message, nullopt while there is none. Throws std::runtime_error when what came is no frame, after
  // which nothing can be read any more. What is framed and not JSON is a null value.
  std::optional<Json> next();

 private:
  std::string bytes_;
};

std::string framed(const Json& message);

}  // namespace launch::lsp
