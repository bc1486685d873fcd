// SPDX-License-Identifier: Apache-2.0
#include "base/terminal/detach_keys.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>

namespace launch {
namespace {

constexpr std::string_view kControl = "ctrl-";
constexpr std::string_view kOption = "--detach-keys";
constexpr char kFirstControl = '@';  // Ctrl-@ is byte 0
constexpr char kLastControl = '_';

std::optional<char> key_of(std::string_view text) {
  if (text.size() == 1) {
    return text.front();
  }
  if (!text.starts_with(kControl) || text.size() != kControl.size() + 1) {
    return std::nullopt;
  }
  const char letter = text.back();
  const char upper = letter >= 'a' && letter <= 'z' ? static_cast<char>(letter - 'a' + 'A') : letter;
  return upper >= kFirstControl && upper <= kLastControl ? std::optional<char>(static_cast<char>(upper - kFirstControl))
                                                         : std::nullopt;
}

std::string text_of(char key) {
  if (static_cast<unsigned char>(key) > kLastControl - kFirstControl) {
    return {key};
  }
  const char upper = static_cast<char>(key + kFirstControl);
  return fmt::format("{}{}", kControl, upper >= 'A' && upper <= 'Z' ? static_cast<char>(upper - 'A' + 'a') : upper);
}

}  // namespace

std::optional<DetachKeys> DetachKeys::parse(std::string_view text) {
  DetachKeys keys;
  for (std::size_t begin = 0; !text.empty() && begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    const std::optional<char> key = key_of(text.substr(begin, end - begin));
    if (!key) {
      return std::nullopt;
    }
    keys.keys_ += *key;
    begin = end + 1;
  }
  return keys;
}

DetachKeys::Outcome DetachKeys::add(std::string_view typed) {
  Outcome outcome;
  if (keys_.empty()) {
    outcome.passed = typed;
    return outcome;
  }
  for (const char key : typed) {
    held_ += key;
    // The first of the keys may come again within them.
    while (!keys_.starts_with(held_)) {
      outcome.passed += held_.front();
      held_.erase(0, 1);
    }
    if (held_ == keys_) {
      held_.clear();
      outcome.detached = true;
      break;
    }
  }
  return outcome;
}

std::string DetachKeys::text() const {
  std::string text;
  for (const char key : keys_) {
    text += (text.empty() ? "" : " ") + text_of(key);
  }
  return text;
}

DetachKeys detach_keys_of(const std::vector<std::string>& words) {
  std::string_view given = DetachKeys::kUsual;
  for (std::size_t i = 0; i < words.size(); ++i) {
    const std::string_view word = words[i];
    if (word == kOption && i + 1 < words.size()) {
      given = words[i + 1];
    } else if (word.starts_with(kOption) && word.substr(kOption.size()).starts_with('=')) {
      given = word.substr(kOption.size() + 1);
    }
  }
  return DetachKeys::parse(given).value_or(*DetachKeys::parse(DetachKeys::kUsual));
}

}  // namespace launch
