// SPDX-License-Identifier: Apache-2.0
// The words and signs of an .idl file, one after the other.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "base/diagnostics/source.hpp"

namespace launch {

struct IdlToken {
  enum class Kind { kName, kNumber, kText, kSign, kEnd };

  Kind kind = Kind::kEnd;
  std::string_view text;  // of a string with its quotes
  std::size_t begin = 0;
};

// Comments and lines that begin with '#' are left out. Throws LaunchError at what has no meaning.
class IdlTokens {
 public:
  explicit IdlTokens(std::shared_ptr<const SourceFile> file);

  const IdlToken& next() const { return tokens_[at_]; }
  IdlToken take();
  // Takes the word or sign if it is the next.
  bool accept(std::string_view text);
  void expect(std::string_view text);
  std::string take_name();

  [[noreturn]] void fail(const IdlToken& token, std::string what, std::string help = {}) const;
  SourceRange range(const IdlToken& token) const;

 private:
  void read(std::string_view text);

  std::shared_ptr<const SourceFile> file_;
  std::vector<IdlToken> tokens_;
  std::size_t at_ = 0;
};

// The text between the quotes, with its escapes resolved.
std::string unquoted(std::string_view text);

}  // namespace launch
