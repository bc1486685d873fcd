// SPDX-License-Identifier: Apache-2.0
// The words of TSDL, the language of CTF 1.8's metadata.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace tracing::ctf {

struct Token {
  enum class Kind : std::uint8_t { kName, kNumber, kString, kSymbol, kEnd };
  Kind kind = Kind::kEnd;
  std::string text;          // of a string: without quotes, escapes resolved
  std::uint64_t number = 0;  // of a number
  std::size_t line = 1;

  bool is(std::string_view symbol_or_name) const {
    return (kind == Kind::kSymbol || kind == Kind::kName) && text == symbol_or_name;
  }
};

// The last token has the kind kEnd. Throws UnsupportedTrace.
std::vector<Token> tsdl_tokens(std::string_view text);

}  // namespace tracing::ctf
