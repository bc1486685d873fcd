// SPDX-License-Identifier: Apache-2.0
#include "base/terminal/terminal_modes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstddef>

namespace launch {
namespace {

constexpr char kEscape = '\033';
constexpr std::size_t kLongestSequence = 64;
constexpr std::size_t kMostModes = 64;
constexpr std::array<int, 3> kAlternateScreens = {47, 1047, 1049};

// The cursor is shown, and lines wrap.
bool is_usually_on(int mode) {
  return mode == 7 || mode == 25;
}

std::string mode_text(int mode, bool on) {
  return fmt::format("\033[?{}{}", mode, on ? 'h' : 'l');
}

}  // namespace

void TerminalModes::add(std::string_view bytes) {
  while (!bytes.empty()) {
    if (sequence_.empty()) {
      const std::size_t begin = bytes.find(kEscape);
      if (begin == std::string_view::npos) {
        return;
      }
      sequence_ = kEscape;
      bytes.remove_prefix(begin + 1);
      continue;
    }
    const char byte = bytes.front();
    bytes.remove_prefix(1);
    if (byte == kEscape) {
      sequence_ = kEscape;
      continue;
    }
    sequence_ += byte;
    const bool goes_on = sequence_ == "\033[" || (sequence_.starts_with("\033[") && byte >= ' ' && byte < '@');
    if (!goes_on || sequence_.size() > kLongestSequence) {
      obey(byte);
      sequence_.clear();
    }
  }
}

void TerminalModes::obey(char last) {
  if (sequence_ == "\033c") {
    *this = TerminalModes();
  } else if (sequence_ == "\033=" || sequence_ == "\033>") {
    keypad_ = last == '=';
  } else if (sequence_.starts_with("\033[?") && (last == 'h' || last == 'l')) {
    std::string_view numbers = std::string_view(sequence_).substr(3);
    while (!numbers.empty()) {
      int mode = 0;
      const auto [end, error] = std::from_chars(numbers.data(), numbers.data() + numbers.size(), mode);
      if (error != std::errc()) {
        return;
      }
      if ((last == 'h') == is_usually_on(mode)) {
        changed_.erase(mode);
      } else if (changed_.size() < kMostModes) {
        changed_[mode] = last == 'h';
      }
      numbers.remove_prefix(static_cast<std::size_t>(end - numbers.data()) + 1);  // and a ';', or the last letter
    }
  } else if (sequence_.starts_with("\033[") && last == 'r' && sequence_[2] != '?') {
    region_ = sequence_.substr(2, sequence_.size() - 3);
  }
}

bool TerminalModes::on_alternate_screen() const {
  return std::any_of(kAlternateScreens.begin(), kAlternateScreens.end(),
                     [this](int mode) { return changed_.contains(mode); });
}

std::string TerminalModes::entering() const {
  std::string text;
  for (auto mode = changed_.rbegin(); mode != changed_.rend(); ++mode) {  // the alternate screen has a high number
    text += mode_text(mode->first, mode->second);
  }
  text += region_.empty() ? "" : fmt::format("\033[{}r", region_);
  return text + (keypad_ ? "\033=" : "");
}

std::string TerminalModes::leaving() const {
  // To set the region moves the cursor.
  std::string text = region_.empty() ? "" : "\0337\033[r\0338";
  for (const auto& [mode, on] : changed_) {
    text += mode_text(mode, !on);
  }
  return text + (keypad_ ? "\033>" : "") + "\033[0m";
}

}  // namespace launch
