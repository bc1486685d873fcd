// SPDX-License-Identifier: Apache-2.0
#include "programs/serve/launch_feed.hpp"

#include <fmt/format.h>
#include <poll.h>

#include <algorithm>
#include <array>
#include <utility>

#include "launcher/control/log_lines.hpp"
#include "launcher/control/process_usage.hpp"

namespace launch::serve {
namespace {

using Json = ControlClient::Json;
using std::chrono::milliseconds;
using std::chrono::steady_clock;

constexpr std::size_t kMostAtOnce = 256UL << 10U;  // bytes
constexpr std::size_t kMostOfLog = 4UL << 20U;     // bytes at its end that are searched

}  // namespace

LaunchFeed::LaunchFeed(ControlClient launch, std::string process, int stop)
    : launch_(std::move(launch)), process_(std::move(process)), stop_(stop), next_ps_(steady_clock::now()) {
  const Json about = launch_.ask("info");
  launch_.ask("events");
  const std::size_t size = launch_.ask("output")["log_size"].get<std::size_t>();
  if (!process_.empty()) {
    add_past_lines(about["launch"].value("log_file", ""), size);
  }
}

std::optional<std::string> LaunchFeed::next() {
  while (!ended_) {
    try {
      while (const auto event = text_.size() < kMostAtOnce ? launch_.next(milliseconds(0)) : std::nullopt) {
        add_event(*event);
      }
      if (!launch_.ended() && steady_clock::now() >= next_ps_) {
        add_ps();
        next_ps_ = steady_clock::now() + kPeriod;
      }
    } catch (const ControlError& error) {
      if (!launch_.ended()) {
        // It is busy, or stopped. It may answer later, but the answer would be taken for that of another request.
        add("end", {{"error", error.what()}});
        ended_ = true;
      }
    }
    if (launch_.ended() && !ended_) {
      add("end", Json::object());
      ended_ = true;
    }
    if (!text_.empty()) {
      return std::exchange(text_, {});
    }
    std::array<pollfd, 2> waits{{{launch_.fd(), POLLIN, 0}, {stop_, POLLIN, 0}}};
    const auto left = std::chrono::ceil<milliseconds>(next_ps_ - steady_clock::now());
    ::poll(waits.data(), waits.size(), static_cast<int>(std::max(left, milliseconds(0)).count()));
    if (waits[1].revents != 0) {
      ended_ = true;
    }
  }
  return std::nullopt;
}

void LaunchFeed::add_ps() {
  Json answer = launch_.ask("ps");
  add_usage(answer["processes"]);
  for (Json& process : answer["processes"]) {
    if (const auto lines = lines_.find(process.value("name", "")); lines != lines_.end()) {
      process["lines"] = lines->second;
    }
  }
  answer.erase("ok");
  answer.erase("version");
  answer["time"] = std::chrono::duration<double>(steady_clock::now().time_since_epoch()).count();
  add("ps", answer);
}

void LaunchFeed::add_event(const Json& event) {
  if (event.value("event", "") != "output") {
    add("event", event);
    return;
  }
  const std::string process = event.value("process", "");
  ++lines_[process];
  if (process == process_) {
    add("output", event);
  }
}

void LaunchFeed::add_past_lines(const std::string& log, std::size_t size) {
  const LogRange range{size > kMostOfLog ? size - kMostOfLog : 0, size};
  std::string shown = process_;  // what stands in front of its lines
  const Json answer = launch_.ask("ps");
  for (const Json& process : answer["processes"]) {
    if (process.value("name", "") == process_ && process.contains("machine")) {
      shown = process["machine"].get<std::string>() + ":" + process_;
    }
  }
  const std::string label = fmt::format("[{}] ", shown);
  for (const std::string& line : past_lines(log, range, {shown}, kPastLines)) {
    add("output", {{"event", "output"},
                   {"process", process_},
                   {"line", line.starts_with(label) ? line.substr(label.size()) : line},
                   {"past", true}});
  }
}

void LaunchFeed::add(const char* name, const Json& data) {
  // JSON has no line ends, so each event has one line of data.
  fmt::format_to(std::back_inserter(text_), "event: {}\ndata: {}\n\n", name,
                 data.dump(-1, ' ', false, Json::error_handler_t::replace));
}

}  // namespace launch::serve
