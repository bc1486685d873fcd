// SPDX-License-Identifier: Apache-2.0
// A launch of a talker and a listener that is recorded, and the conditions on it.
#pragma once

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gmock/gmock.h>

#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <variant>
#include <vector>

#include "tests/support/trace_writer/temporary_directory.hpp"
#include "tests/support/trace_writer/trace_writer.hpp"
#include "tracing/decode/reader/trace_reader.hpp"
#include "tracing/show/live/live_conditions.hpp"

namespace tracing {

inline constexpr std::int64_t kMs = 1'000'000;
inline constexpr std::int64_t kBegin = 1'767'225'600'000'000'000;
inline constexpr testing::Thread kTalker{101, 101, "talker"};
inline constexpr testing::Thread kListener{103, 103, "listener"};
inline constexpr testing::Thread kStranger{900, 900, "talker"};

class FakeLaunch : public LaunchedProcesses {
 public:
  std::optional<std::string> label(std::int64_t vpid) override {
    return vpid == kStranger.vpid ? std::nullopt : std::optional(fmt::format("talker-{}", vpid - 100));
  }
  bool lives(std::int64_t vpid) override { return !ended.contains(vpid); }
  std::set<std::int64_t> ended;
};

// A system that is recorded: its times are milliseconds.
class RecordedLaunch : public ::testing::Test {
 protected:
  // Makes a node /talker with a publisher of /chatter and a timer.
  void make(std::int64_t time, const testing::Thread& who = kTalker) {
    write(time, who, ros2::RclInit{0x1, "8.2.0"});
    write(time, who, ros2::RclNodeInit{0x10, 0x11, "talker", "/"});
    write(time, who, ros2::RmwPublisherInit{0x20, {}});
    write(time, who, ros2::RclPublisherInit{0x21, 0x10, 0x20, "/chatter", 10});
    write(time, who, ros2::RclTimerInit{0x30, 100 * kMs});
    write(time, who, ros2::RclcppTimerCallbackAdded{0x30, 0x31});
    write(time, who, ros2::RclcppTimerLinkNode{0x30, 0x10});
  }
  // Makes a node /listener with a subscription to /chatter and a client of /plan.
  void make_listener(std::int64_t time) {
    write(time, kListener, ros2::RclInit{0x1, "8.2.0"});
    write(time, kListener, ros2::RclNodeInit{0x50, 0x51, "listener", "/"});
    write(time, kListener, ros2::RmwSubscriptionInit{0x60, {}});
    write(time, kListener, ros2::RclSubscriptionInit{0x61, 0x50, 0x60, "/chatter", 10});
    write(time, kListener, ros2::RclcppSubscriptionInit{0x61, 0x62});
    write(time, kListener, ros2::RclcppSubscriptionCallbackAdded{0x62, 0x63});
    write(time, kListener, ros2::RmwClientInit{0x70, {}});
    write(time, kListener, ros2::RclClientInit{0x71, 0x50, 0x70, "/plan"});
    write(time, kListener, ros2::RmwClientInit{0x80, {}});
    write(time, kListener, ros2::RclClientInit{0x81, 0x50, 0x80, "/drive/_action/get_result"});
  }
  // The message of that time gets to its callback so much later.
  void hear(std::int64_t published, std::int64_t after, std::int64_t runs = 1) {
    const std::int64_t time = published + after;
    write(time, kListener, ros2::RmwTake{0x60, 0x40, static_cast<std::int64_t>(kBegin + published * kMs), true});
    write(time, kListener, ros2::CallbackStart{0x63, false});
    write(time + runs, kListener, ros2::CallbackEnd{0x63});
  }
  // A request, and so much later its response.
  void call(std::int64_t number, std::int64_t time, std::int64_t takes, std::uint64_t client = 0x70) {
    write(time, kListener, ros2::RmwSendRequest{client, 0x41, number});
    write(time + takes, kListener, ros2::RmwTakeResponse{client, 0x42, number, 1, true});
  }
  void publish(std::int64_t time, const testing::Thread& who = kTalker) {
    write(time, who, ros2::CallbackStart{0x31, false});
    write(time, who, ros2::RclPublish{0x21, 0x40});
    write(time, who, ros2::RmwPublish{0x20, 0x40, static_cast<std::int64_t>(kBegin + time * kMs)});
    write(time, who, ros2::CallbackEnd{0x31});
  }
  void publish_each(std::int64_t period, std::int64_t from, std::int64_t until) {
    for (std::int64_t time = from; time <= until; time += period) {
      publish(time);
    }
  }
  template <class Event>
  void write(std::int64_t time, const testing::Thread& who, const Event& event) {
    writer_.write(0, kBegin + time * kMs, who, event);
  }

  // The rest was told, too: nothing has happened until then.
  std::vector<std::string> told_until(std::int64_t time) {
    writer_.finish();
    TraceReader(directory_.path()).read(conditions_);
    conditions_.advance(kBegin + time * kMs);
    return told_;
  }

  void note(const ConditionReport& report) {
    if (const auto* const changed = std::get_if<ConditionChanged>(&report)) {
      told_.push_back(fmt::format("{} {} {:.3f} {}", changed->id, changed->change.holds ? "holds" : "is over",
                                  changed->change.figure, fmt::join(changed->change.processes, " ")));
    } else if (const auto* const unseen = std::get_if<NameNotSeen>(&report)) {
      told_.push_back(fmt::format("{} unseen, there is {}", unseen->id, fmt::join(unseen->known, " ")));
    }
  }

  testing::TemporaryDirectory directory_;
  testing::TraceWriter writer_{directory_.path()};
  FakeLaunch launch_;
  std::vector<std::string> told_;
  LiveConditions conditions_{launch_, [this](const ConditionReport& report) { note(report); }};
};

}  // namespace tracing
