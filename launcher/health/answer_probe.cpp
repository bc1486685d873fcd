// SPDX-License-Identifier: Apache-2.0
#include "launcher/health/answer_probe.hpp"

#include <fmt/format.h>

#include <chrono>

namespace launch {

void AnswerProbe::begin(pid_t pid) {
  pid_ = pid;
  found_.reset();
  state_.clear();
  has_news_ = false;
  age_ = Duration{0};
  wait_.forget();
  graph_.begin([this](const RosAnswer& answer) {
    if (!answer.found) {
      return;
    }
    has_news_ = true;
    found_ = answer.found;
    state_ = answer.state;
    if (is_good()) {
      age_ = Duration{0};
      wait_.forget();
    }
  });
}

Look AnswerProbe::look(Duration now, Duration passed) {
  if (const std::string& lost = graph_.keep_up(now); !lost.empty()) {
    found_.reset();
    return {.note = fmt::format("whether '{}' answers can't be watched: {}", service_, lost)};
  }
  if (!found_) {
    return {};
  }
  if (is_good()) {
    return {Look::Result::kGood};
  }
  // A question without an answer counts as long as launch-ros-client says that it waits for one. Without news it got no
  // processor itself.
  if (std::exchange(has_news_, false) || found_ != ServiceFinding::kAsked) {
    age_ += age_ >= timeout_ / 4 ? passed - wait_.of_process(pid_, passed) : passed;
  }
  return age_ < timeout_ ? Look{} : Look{Look::Result::kBad, complaint()};
}

std::string AnswerProbe::complaint() const {
  const double age = std::chrono::duration<double>(age_).count();
  switch (*found_) {
    case ServiceFinding::kGone:
      return fmt::format("there has been no service '{}' for {:.1f} s", service_, age);
    case ServiceFinding::kAsked:
      return fmt::format("the service '{}' has not answered for {:.1f} s", service_, age);
    case ServiceFinding::kFound:
      break;
  }
  return fmt::format("it has not been {} for {:.1f} s: '{}' says {}", wanted_, age, service_,
                     state_.empty() ? "nothing" : state_);
}

}  // namespace launch
