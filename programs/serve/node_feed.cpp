// SPDX-License-Identifier: Apache-2.0
#include "programs/serve/node_feed.hpp"

#include <fmt/format.h>
#include <poll.h>

#include <nlohmann/json.hpp>
#include <utility>

namespace launch::serve {
namespace {

constexpr std::size_t kColumns = 132;

}  // namespace

NodeRecording::NodeRecording() {
  watch_.set_width(kColumns);
}

std::vector<std::string> NodeRecording::lines() {
  const std::lock_guard<std::mutex> lock(mutex_);
  watch_.update();
  return watch_.lines();
}

std::shared_ptr<NodeRecording> NodeRecordings::join() {
  const std::lock_guard<std::mutex> lock(mutex_);
  std::shared_ptr<NodeRecording> recording = recording_.lock();
  if (!recording) {
    recording = std::make_shared<NodeRecording>();
    recording_ = recording;
  }
  return recording;
}

std::optional<std::string> NodeFeed::next() {
  pollfd stop{stop_, POLLIN, 0};
  const int period = std::exchange(first_, false) ? 0 : static_cast<int>(kPeriod.count());
  if (::poll(&stop, 1, period) > 0) {
    return std::nullopt;
  }
  const nlohmann::json data{{"lines", recording_->lines()}};
  return fmt::format("event: nodes\ndata: {}\n\n", data.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
}

}  // namespace launch::serve
