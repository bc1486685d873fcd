// SPDX-License-Identifier: Apache-2.0
// The keys that leave the terminal of a process, "ctrl-p,ctrl-q". The others are for the process.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace launch {

class DetachKeys {
 public:
  static constexpr const char* kUsual = "ctrl-p,ctrl-q";

  // Keys with commas between: a character, or ctrl- with a letter or one of @ [ \ ] ^ _. No keys at all is possible:
  // then nothing detaches. Nothing for another text.
  static std::optional<DetachKeys> parse(std::string_view text);

  struct Outcome {
    std::string passed;  // for the process
    bool detached = false;
  };
  // Takes what was typed. What may be the beginning of the keys is held back until it is clear.
  Outcome add(std::string_view typed);

  // "ctrl-p ctrl-q"; "" if there are none.
  std::string text() const;

 private:
  std::string keys_;
  std::string held_;
};

// Those of the words behind `launch attach`; the usual ones without --detach-keys, and if it is wrong.
DetachKeys detach_keys_of(const std::vector<std::string>& words);

}  // namespace launch
