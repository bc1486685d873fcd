// SPDX-License-Identifier: Apache-2.0
#include "launcher/health/topic_probe.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <utility>

namespace launch {
namespace {

double in_seconds(Duration time) {
  return std::chrono::duration<double>(time).count();
}

}  // namespace

void TopicProbe::begin(pid_t pid) {
  pid_ = pid;
  news_ = {};
  window_.clear();
  sum_ = {};
  wait_.forget();
  graph_.begin([this](const RosAnswer& answer) {
    if (answer.traffic) {
      news_.messages += answer.traffic->messages;
      news_.measured += answer.traffic->measured;
      news_.publishers = answer.traffic->publishers;
    }
  });
}

Look TopicProbe::look(Duration now, Duration passed) {
  if (const std::string& lost = graph_.keep_up(now); !lost.empty()) {
    return {.note = fmt::format("whether '{}' is published can't be watched: {}", topic_.topic, lost)};
  }
  const TopicTraffic news = std::exchange(news_, {.publishers = news_.publishers});
  Part part{std::min(passed, news.measured), news.messages};
  // As long as messages come, it is not worth a look into /proc.
  if (part.messages == 0 || static_cast<double>(part.messages) < topic_.min_rate * in_seconds(part.time)) {
    part.time -= std::min(part.time, wait_.of_process(pid_, passed));
  } else {
    wait_.forget();
  }
  window_.push_back(part);
  sum_.time += part.time;
  sum_.messages += part.messages;
  while (sum_.time - window_.front().time >= timeout_) {
    sum_.time -= window_.front().time;
    sum_.messages -= window_.front().messages;
    window_.pop_front();
  }
  return judge();
}

Look TopicProbe::judge() const {
  // A message that comes a little late belongs to the next window, so one may be missing.
  const double expected = topic_.min_rate * in_seconds(timeout_) - 1;
  const auto count = static_cast<double>(sum_.messages);
  if (sum_.messages > 0 && count >= expected) {
    return {Look::Result::kGood};
  }
  if (sum_.time < timeout_) {
    return {};
  }
  const char* const publisher = news_.publishers == 0 ? " (it has no publisher)" : "";
  if (sum_.messages == 0) {
    return {Look::Result::kBad,
            fmt::format("no message has come on '{}' for {:.1f} s{}", topic_.topic, in_seconds(sum_.time), publisher)};
  }
  return {Look::Result::kBad,
          fmt::format("'{}' has had {:.1f} messages a second in the last {:.1f} s, not {:.1f}{}", topic_.topic,
                      count / in_seconds(sum_.time), in_seconds(sum_.time), topic_.min_rate, publisher)};
}

}  // namespace launch
