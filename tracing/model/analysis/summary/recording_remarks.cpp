// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <charconv>

#include "tracing/model/analysis/summary/summary.hpp"

namespace tracing {

namespace {

std::string messages_text(std::uint64_t count) {
  return count == 1 ? "1 message" : fmt::format("{} messages", count);
}

// A version of tracetools is "8.2.4".
bool is_before(const std::string& version, const std::array<int, 2>& other) {
  std::array<int, 2> numbers{};
  const char* const end = version.data() + version.size();
  const auto [dot, error] = std::from_chars(version.data(), end, numbers[0]);
  return error == std::errc() && dot != end && std::from_chars(dot + 1, end, numbers[1]).ec == std::errc() &&
         numbers < other;
}

// Services were called, and no event of the trace tells by whom.
bool lacks_calls(const Ros2Results& results) {
  const auto serves = [](const CallbackResult& callback) {
    return callback.owner == CallbackResult::Owner::kService && callback.durations.count > 0;
  };
  const auto without = [](const std::string& version) { return is_before(version, {8, 5}); };
  return results.calls.empty() && std::any_of(results.callbacks.begin(), results.callbacks.end(), serves) &&
         std::any_of(results.tracetools.begin(), results.tracetools.end(), without);
}

}  // namespace

std::vector<std::string> recording_remarks(const Ros2Results& results) {
  std::uint64_t estimated = 0;
  std::uint64_t unidentified = 0;
  std::uint64_t undecided = 0;
  std::uint64_t unrecorded = 0;
  for (const TopicResult& topic : results.topics) {
    estimated += topic.estimated;
    unidentified += topic.unidentified;
    undecided += topic.undecided;
    unrecorded += results.is_older ? topic.unrecorded : 0;
  }
  std::vector<std::string> remarks;
  const std::string recorder =
      results.tracetools.empty() ? std::string() : fmt::format(" (tracetools {})", fmt::join(results.tracetools, ", "));
  if (estimated + unidentified + undecided > 0) {
    remarks.push_back(fmt::format(
        "The trace has no timestamps of publications{}; ros2_tracing records them from 8.0 (ROS 2 Jazzy) on. Of {} the "
        "publication was found by its time: results with ~ are estimates.",
        recorder, messages_text(estimated)));
  }
  if (unidentified + undecided > 0) {
    remarks.push_back(fmt::format(
        "Of {} that were taken, the publication can't be told, and of {} that were published, whether they were taken. "
        "They count as neither lost nor untaken.",
        messages_text(unidentified), messages_text(undecided)));
  }
  if (unrecorded > 0) {
    remarks.push_back(
        fmt::format("{} began a callback without a take in the trace: ros2_tracing before 8.0 does not record takes of "
                    "loaned and serialized messages, before 6.1 (ROS 2 Iron) not those within a process.",
                    messages_text(unrecorded)));
  }
  if (results.unnamed_messages > 0) {
    remarks.push_back(fmt::format(
        "{} have no publisher{}: before 8.0, ros2_tracing names it in rcl_publish alone, which the trace does "
        "not hold.",
        messages_text(results.unnamed_messages), recorder));
  }
  if (results.logs > 0) {
    remarks.push_back(
        fmt::format("{} of a process with several nodes went to /rosout{}: before 8.0, ros2_tracing does not tell "
                    "which of the nodes "
                    "has logged it, and the topic does not count it.",
                    messages_text(results.logs), recorder));
  }
  if (lacks_calls(results)) {
    remarks.push_back(
        fmt::format("Services were called, and the trace has neither requests nor responses{}: ros2_tracing records "
                    "them from 8.5 on. "
                    "Who called, how long calls took, and which goals actions had is not known.",
                    recorder));
  }
  if (results.lacks_middleware) {
    remarks.push_back(
        fmt::format("The trace has rcl_publish, and no event of the middleware (rmw_publish, rmw_take){}: ros2_tracing "
                    "before 3.1 has none. Which messages came, and when, is not known.",
                    recorder));
  }
  return remarks;
}

}  // namespace tracing
