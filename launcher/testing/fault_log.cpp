// SPDX-License-Identifier: Apache-2.0
#include "launcher/testing/fault_log.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

namespace launch {

std::string FaultResult::text() const {
  if (!applied()) {
    return fmt::format("{}: {}: {}", place, what, reason);
  }
  if (packets) {
    return fmt::format("{}: {} at {:.3f} s, {} packet{}", place, what, seconds, *packets, *packets == 1 ? "" : "s");
  }
  const std::string times = messages > 1 ? fmt::format(", {} times until {:.3f} s", messages, latest) : "";
  return fmt::format("{}: {} at {:.3f} s{}", place, what, seconds, times);
}

void FaultLog::begin(std::vector<FaultRequest> faults, Duration now) {
  begin_ = now;
  for (FaultRequest& fault : faults) {
    const bool is_left_out = !fault.left_out.empty();
    entries_.push_back({.request = std::move(fault), .is_over = is_left_out});
  }
}

void FaultLog::on_fault(const FaultEvent& event, Duration now) {
  Entry& entry = entries_.at(event.number - 1);
  switch (event.kind) {
    case FaultEvent::Kind::kApplied:
      entry.is_applied = true;
      entry.messages = event.messages;
      entry.at = (event.messages == 0 ? now : event.first) - begin_;
      entry.latest = event.latest - begin_;
      break;
    case FaultEvent::Kind::kMissed:
      entry.is_applied = false;
      entry.is_over = true;
      entry.reason = event.reason;
      break;
    case FaultEvent::Kind::kOver:
      entry.is_over = true;
      entry.packets = event.packets;
      break;
  }
}

bool FaultLog::is_open() const {
  return std::any_of(entries_.begin(), entries_.end(), [](const Entry& entry) { return !entry.is_over; });
}

bool FaultLog::is_open_for_messages_only() const {
  return std::all_of(entries_.begin(), entries_.end(), [](const Entry& entry) {
    return entry.is_over || std::holds_alternative<MessageFault>(entry.request.what);
  });
}

const FaultRequest& FaultLog::open() const {
  return std::find_if(entries_.begin(), entries_.end(), [](const Entry& entry) { return !entry.is_over; })->request;
}

std::vector<FaultResult> FaultLog::results(const std::string& why) const {
  std::vector<FaultResult> results;
  for (const Entry& entry : entries_) {
    FaultResult& result = results.emplace_back();
    result.number = entry.request.number;
    result.what = describe(entry.request);
    result.place = to_string(entry.request.where);
    if (const SourceRange& where = entry.request.where) {
      const SourceFile::Position position = where.file->position(where.begin);
      result.file = where.file->path();
      result.line = position.line;
      result.column = position.column;
    }
    if (!entry.request.left_out.empty()) {
      result.reason = entry.request.left_out;
      result.left_out = true;
    } else if (entry.is_applied) {
      result.seconds = std::chrono::duration<double>(entry.at).count();
      result.messages = entry.messages;
      result.packets = entry.packets;
      result.latest = entry.messages == 0 ? 0 : std::chrono::duration<double>(entry.latest).count();
    } else {
      result.reason = "not applied: " + (entry.reason.empty() ? why : entry.reason);
    }
  }
  return results;
}

std::vector<Failure> FaultLog::failures(const std::string& why) const {
  std::vector<Failure> failures;
  for (const Entry& entry : entries_) {
    if (!entry.request.left_out.empty() || entry.request.is_random) {
      continue;
    }
    const auto* const messages = std::get_if<MessageFault>(&entry.request.what);
    const std::uint64_t asked = messages == nullptr || !messages->count ? 0 : *messages->count;
    if (entry.is_applied && entry.messages < asked) {
      failures.push_back({.message = fmt::format("the {} was applied to {} of {} messages only",
                                                 describe(entry.request), entry.messages, asked),
                          .where = entry.request.where});
    } else if (!entry.is_applied) {
      failures.push_back({.message = fmt::format("the {} was not applied: {}", describe(entry.request),
                                                 entry.reason.empty() ? why : entry.reason),
                          .where = entry.request.where});
    }
  }
  return failures;
}

}  // namespace launch
