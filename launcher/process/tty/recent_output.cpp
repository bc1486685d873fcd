// SPDX-License-Identifier: Apache-2.0
#include "launcher/process/tty/recent_output.hpp"

namespace launch {

void RecentOutput::add(std::string_view bytes) {
  if (bytes.size() >= kMost) {
    is_cut_ = is_cut_ || !text_.empty() || bytes.size() > kMost;
    text_.assign(bytes.substr(bytes.size() - kMost));
    return;
  }
  text_.append(bytes);
  // Not at each call, so that a byte is moved once at most.
  if (text_.size() > 2 * kMost) {
    text_.erase(0, text_.size() - kMost);
    is_cut_ = true;
  }
}

void RecentOutput::clear() {
  text_.clear();
  is_cut_ = false;
}

std::string_view RecentOutput::last_lines(std::size_t most) const {
  std::string_view text = text_;
  if (const std::size_t end = text.find('\n'); is_cut_ && end != std::string_view::npos) {
    text.remove_prefix(end + 1);
  }
  std::size_t begin = text.size();
  for (std::size_t lines = text.ends_with('\n') || text.empty() ? 0 : 1; begin > 0; --begin) {
    if (text[begin - 1] == '\n' && ++lines > most) {
      break;
    }
  }
  return most == 0 ? std::string_view() : text.substr(begin);
}

}  // namespace launch
