// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <utility>

#include "base/diagnostics/source.hpp"

namespace launch {

LocatedText::LocatedText(std::string text, SourceRange range) : text_(std::move(text)), range_(std::move(range)) {
  if (range_ && text_.size() != range_.end - range_.begin) {
    anchors_.push_back({0, range_.begin, range_.end, false});
  }
}

void LocatedText::append(std::string_view decoded, std::uint32_t raw_begin, std::uint32_t raw_end) {
  if (decoded.empty()) {
    return;
  }
  const auto start = static_cast<std::uint32_t>(text_.size());
  const bool verbatim = decoded.size() == raw_end - raw_begin;
  if (anchors_.empty() && verbatim && range_.end == raw_begin && start == range_.end - range_.begin) {
    text_.append(decoded);
    range_.end = raw_end;
    return;
  }
  if (anchors_.empty() && start > 0) {
    anchors_.push_back({0, range_.begin, range_.end, true});
  }
  Anchor* last = anchors_.empty() ? nullptr : &anchors_.back();
  if (last != nullptr && verbatim && last->verbatim && last->raw_end == raw_begin) {
    last->raw_end = raw_end;
  } else {
    anchors_.push_back({start, raw_begin, raw_end, verbatim});
  }
  text_.append(decoded);
  range_.end = std::max(range_.end, raw_end);
}

SourceRange LocatedText::range(std::size_t position, std::size_t length) const {
  if (!range_) {
    return {};
  }
  // The raw bytes of the file for byte `at` of the text: its own byte, or the whole run that it was decoded from.
  const auto place = [this](std::size_t at) -> std::pair<std::uint32_t, std::uint32_t> {
    if (at >= text_.size()) {
      return {range_.end, range_.end};
    }
    if (anchors_.empty()) {
      const auto raw = static_cast<std::uint32_t>(range_.begin + at);
      return {raw, raw + 1};
    }
    const auto after = std::upper_bound(anchors_.begin(), anchors_.end(), at,
                                        [](std::size_t value, const Anchor& anchor) { return value < anchor.decoded; });
    const Anchor& anchor = *std::prev(after);
    if (!anchor.verbatim) {
      return {anchor.raw_begin, anchor.raw_end};
    }
    const auto raw = static_cast<std::uint32_t>(anchor.raw_begin + (at - anchor.decoded));
    return {raw, raw + 1};
  };
  const auto [begin, begin_end] = place(position);
  if (length == 0) {
    return {range_.file, begin, begin};
  }
  return {range_.file, begin, std::max(place(position + length - 1).second, begin)};
}

}  // namespace launch
