// SPDX-License-Identifier: Apache-2.0
#include "programs/agent/output_spool.hpp"

#include <algorithm>
#include <utility>

namespace launch {

void OutputSpool::add(std::string_view bytes, std::size_t& all) {
  if (skips_) {
    const std::size_t end = bytes.find('\n');
    skips_ = end == std::string_view::npos;
    bytes.remove_prefix(skips_ ? bytes.size() : end + 1);
  }
  if (full_) {
    drop(bytes);
    return;
  }
  if (bytes.empty()) {
    return;
  }
  const std::size_t held = bytes_.size() - begin_;
  const std::size_t room =
      std::min(kMostSpooled - std::min(held, kMostSpooled), kMostSpooledOfAll - std::min(all, kMostSpooledOfAll));
  std::string_view fits = bytes.substr(0, room);
  if (fits.size() < bytes.size()) {
    full_ = true;
    const std::size_t end = fits.rfind('\n');
    fits = fits.substr(0, end == std::string_view::npos ? 0 : end + 1);
  }
  if (!fits.empty()) {
    bytes_ += fits;
    all += fits.size();
    last_ = fits.back();
  }
  if (full_) {
    end_at_a_line(all);
    drop(bytes.substr(fits.size()));
  }
}

// A line whose rest is dropped goes, too. If its beginning has been passed on already, it ends here, so that what comes
// later does not look like its rest.
void OutputSpool::end_at_a_line(std::size_t& all) {
  if (last_ == '\n') {
    return;
  }
  last_ = '\n';
  const std::size_t end = bytes_.rfind('\n');
  if (end != std::string::npos && end >= begin_) {
    all -= bytes_.size() - (end + 1);
    bytes_.resize(end + 1);
  } else {
    bytes_ += '\n';
    all += 1;
  }
}

void OutputSpool::drop(std::string_view bytes) {
  if (!bytes.empty()) {
    dropped_ += static_cast<std::uint64_t>(std::count(bytes.begin(), bytes.end(), '\n'));
    in_line_ = bytes.back() != '\n';
  }
}

std::string OutputSpool::take(std::size_t most, std::size_t& all) {
  std::string taken = bytes_.substr(begin_, most);
  begin_ += taken.size();
  all -= taken.size();
  if (begin_ == bytes_.size()) {
    bytes_ = {};  // the memory goes back, too
    begin_ = 0;
  }
  return taken;
}

std::uint64_t OutputSpool::take_dropped() {
  const bool begun = std::exchange(in_line_, false);  // it is one of the dropped lines, and its rest comes yet
  skips_ = skips_ || begun;
  full_ = false;
  return std::exchange(dropped_, 0) + (begun ? 1 : 0);
}

}  // namespace launch
