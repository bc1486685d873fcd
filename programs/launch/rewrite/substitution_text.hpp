// SPDX-License-Identifier: Apache-2.0
// A text with substitutions as the tree that is written in it.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace launch {

struct SubstitutionText;

struct SubstitutionCall {
  std::string name;
  std::vector<std::vector<SubstitutionText>> arguments;
};

// A piece of a text: words, or one substitution.
struct SubstitutionText {
  std::string words;                   // without escapes
  std::vector<SubstitutionCall> call;  // one, or none
};

// The text must be one that parse_template() takes.
std::vector<SubstitutionText> substitution_texts(std::string_view text);

// The same for a command line: one entry for each word, as a POSIX shell splits it.
std::vector<std::vector<SubstitutionText>> command_words(std::string_view text);

}  // namespace launch
