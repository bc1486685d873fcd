// SPDX-License-Identifier: Apache-2.0
#include "programs/watch/condition_program.hpp"

#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <exception>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/overloaded.hpp"
#include "programs/watch/processes_of_launch.hpp"
#include "programs/watch/traced_nodes.hpp"
#include "tracing/decode/reader/trace_read_error.hpp"
#include "tracing/show/live/live_conditions.hpp"
#include "tracing/show/live/live_view.hpp"

namespace launch {
namespace {

using tracing::ConditionReport;
using tracing::LiveReader;
using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

constexpr std::chrono::microseconds kLiveTimer{50'000};
constexpr milliseconds kAskAgain{10};       // the relay daemon tells nothing by itself
constexpr std::chrono::seconds kBehind{5};  // from then on that is told
constexpr std::chrono::seconds kCaughtUp{1};

// What the conditions need, and the beginnings of all objects.
std::vector<std::string> events_of_conditions(const std::set<std::string>& needs) {
  std::vector<std::string> events = {"ros2:rcl_init",
                                     "ros2:rcl_node_init",
                                     "ros2:*_publisher_init",
                                     "ros2:rcl_publish",
                                     "ros2:rmw_publish",
                                     "ros2:rclcpp_intra_publish",
                                     "ros2:*_subscription_init",
                                     "ros2:rclcpp_subscription_callback_added",
                                     "ros2:*_service_init",
                                     "ros2:rclcpp_service_callback_added",
                                     "ros2:*_client_init",
                                     "ros2:*timer*",
                                     "ros2:rclcpp_callback_register",
                                     "ros2:rcl_lifecycle_state_machine_init",
                                     "ros2:callback_start",
                                     "ros2:callback_end",
                                     "ros2_ext:*_client_callback_*"};
  if (needs.contains("messages") || needs.contains("losses")) {
    events.insert(events.end(),
                  {"ros2:rmw_take", "ros2:rclcpp_construct_ring_buffer", "ros2:rclcpp_buffer_to_ipb",
                   "ros2:rclcpp_ipb_to_subscription", "ros2:rclcpp_ring_buffer_*", "ros2:message_link_*"});
  }
  if (needs.contains("losses")) {
    // Whether a message was for a callback, and which messages a subscription does not want.
    events.insert(events.end(), {"ros2:rclcpp_executor_*", "ros2_ext:rmw_*_qos"});
  }
  if (needs.contains("calls")) {
    events.insert(events.end(), {"ros2:rmw_send_request", "ros2:rmw_take_request", "ros2:rmw_send_response",
                                 "ros2:rmw_take_response"});
  }
  return events;
}

void tell_launcher(const ConditionReport& report) {
  const std::string line = to_line(report);
  std::fwrite(line.data(), 1, line.size(), stdout);
  std::fflush(stdout);
}

// How far the recording is behind. The clocks differ, so what counts is how they go on.
class Delay {
 public:
  // Tells when it becomes too much, and when it is none any more.
  void look(std::int64_t told_until_ns) {
    const Clock::time_point now = Clock::now();
    const std::chrono::nanoseconds ahead = now.time_since_epoch() - std::chrono::nanoseconds(told_until_ns);
    least_ = std::min(least_.value_or(ahead), ahead);
    const std::chrono::nanoseconds behind = ahead - *least_;
    if (!is_told_ && behind > kBehind) {
      is_told_ = true;
      tell_launcher(tracing::RecordingIsBehind{std::chrono::duration<double>(behind).count()});
    } else if (is_told_ && behind < kCaughtUp) {
      is_told_ = false;
      tell_launcher(tracing::RecordingIsBehind{0});
    }
  }

 private:
  std::optional<std::chrono::nanoseconds> least_;
  bool is_told_ = false;
};

class ConditionProgram {
 public:
  ConditionProgram(const std::string& launch, std::set<std::string> needs)
      : needs_(std::move(needs)), processes_(launch), conditions_(processes_, tell_launcher) {}

  void run() {
    tracing::TracedNodes nodes(
        {.name = "launch-conditions", .events = events_of_conditions(needs_), .live_timer = kLiveTimer});
    tell_launcher(tracing::NodesAreRecorded{});
    milliseconds wait{0};
    while (look(wait)) {
      const LiveReader::State state = read_some(nodes.reader(), conditions_);
      if (state == LiveReader::State::kEnd) {
        throw std::runtime_error("the session of the conditions has ended");
      }
      wait = state == LiveReader::State::kItem ? milliseconds(0) : kAskAgain;
      nodes.catch_up();
      if (const std::optional<std::int64_t> told = nodes.reader().told_until_ns()) {
        conditions_.advance(*told);
        delay_.look(*told);
      }
      conditions_.tell_unseen(Clock::now().time_since_epoch());
    }
    nodes.end();
  }

 private:
  // Waits so long for orders, and carries them out. Returns false at their end.
  bool look(milliseconds time) {
    pollfd readable{STDIN_FILENO, POLLIN, 0};
    if (poll(&readable, 1, static_cast<int>(time.count())) <= 0) {
      return true;
    }
    std::array<char, 4096> bytes{};
    const ssize_t count = read(STDIN_FILENO, bytes.data(), bytes.size());
    if (count <= 0) {
      return count < 0 && errno == EINTR;
    }
    unread_.append(bytes.data(), static_cast<std::size_t>(count));
    for (std::size_t end; (end = unread_.find('\n')) != std::string::npos; unread_.erase(0, end + 1)) {
      std::visit(Overloaded{
                     [this](const tracing::WatchCondition& watch) { conditions_.watch(watch.id, watch.condition); },
                     [this](const tracing::ForgetCondition& forget) { conditions_.forget(forget.id); },
                 },
                 tracing::parse_condition_order(unread_.substr(0, end)));
    }
    return true;
  }

  std::set<std::string> needs_;
  ProcessesOfLaunch processes_;
  tracing::LiveConditions conditions_;
  Delay delay_;
  std::string unread_;
};

// A second line says what to do.
void tell_failure(const std::string& text, std::string help) {
  constexpr std::string_view kHelp = "\n= help: ";
  const std::size_t second = text.find(kHelp);
  if (second != std::string::npos) {
    help = text.substr(second + kHelp.size());
  }
  tell_launcher(tracing::WatchFailed{text.substr(0, second), std::move(help)});
}

}  // namespace

int run_condition_program(const std::string& launch, std::set<std::string> needs) {
  try {
    ConditionProgram(launch, std::move(needs)).run();
    return 0;
  } catch (const tracing::TraceReadError& error) {
    tell_failure(error.what(), error.remedy());
  } catch (const std::exception& error) {
    tell_failure(error.what(), "");
  }
  return 1;
}

}  // namespace launch
