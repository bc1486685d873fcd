// SPDX-License-Identifier: Apache-2.0
#include "launcher/visit/fault_request.hpp"

#include <fmt/format.h>
#include <string.h>

#include <chrono>

namespace launch {

namespace {

std::string seconds(Duration duration) {
  return fmt::format("{:g} s", std::chrono::duration<double>(duration).count());
}

bool is_of_service(const MessageFault& fault) {
  return fault.side == MessageFault::Side::kRequest || fault.side == MessageFault::Side::kResponse;
}

const char* word_for(const MessageFault& fault) {
  switch (fault.side) {
    case MessageFault::Side::kRequest:
      return "request";
    case MessageFault::Side::kResponse:
      return "response";
    default:
      return "message";
  }
}

// "on '/scan'", "of '/add'".
std::string owner(const MessageFault& fault) {
  return fmt::format("{} '{}'", is_of_service(fault) ? "of" : "on", fault.topic);
}

// "message 3 on '/scan'", "messages 3 to 5 on '/scan'", "all messages on '/scan' from message 3 on", "3 messages on
// '/scan', 1 of 4 from message 2 on", "1 of 4 messages on '/scan'", "request 3 of '/add'".
std::string describe_hits(const MessageFault& fault) {
  const char* const word = word_for(fault);
  const std::string all = describe_messages(fault, true);
  const std::string from = fault.first == 1 ? "" : fmt::format(" from {} {} on", word, fault.first);
  if (fault.count == 1) {
    return fmt::format("{} {} {}", word, fault.first, owner(fault));
  }
  if (fault.count && fault.every == 1) {
    return fmt::format("{}s {} to {} {}", word, fault.first, fault.first + *fault.count - 1, owner(fault));
  }
  if (fault.count) {
    return fmt::format("{} {}, 1 of {}{}", *fault.count, all, fault.every, from);
  }
  return fault.every == 1 ? fmt::format("all {}{}", all, from) : fmt::format("1 of {} {}{}", fault.every, all, from);
}

std::string quoted(const std::vector<NetworkFault::Member>& members) {
  std::string text;
  for (const NetworkFault::Member& member : members) {
    text += fmt::format("{}'{}'", text.empty() ? "" : ", ", member.name);
  }
  return members.empty() ? "the others" : text;
}

struct Describer {
  const std::string& process;

  std::string operator()(const KillFault& kill) const {
    const char* const name = ::sigabbrev_np(kill.signal);
    const std::string signal = name == nullptr ? fmt::format("signal {}", kill.signal) : fmt::format("SIG{}", name);
    return fmt::format("kill of '{}'{}", process, kill.signal == SIGKILL ? "" : " by " + signal);
  }
  std::string operator()(const StopFault&) const { return fmt::format("stop of '{}'", process); }
  std::string operator()(const SlowFault& slow) const {
    return fmt::format("slow of '{}' to {}%", process, slow.percent);
  }
  std::string operator()(const LimitFault& limit) const {
    std::string text = fmt::format("limit of '{}' to ", process);
    if (limit.memory) {
      text += fmt::format("{} bytes{}", *limit.memory, limit.files ? " and " : "");
    }
    return limit.files ? text + fmt::format("{} files", *limit.files) : text;
  }
  std::string operator()(const MessageFault& fault) const {
    constexpr const char* kWords[] = {"drop", "duplicate", "corruption", "delay"};
    std::string text = kWords[static_cast<std::size_t>(fault.kind)];
    if (fault.kind == MessageFault::Kind::kDelay) {
      text += " by " + seconds(fault.by);
    }
    text += " of " + describe_hits(fault);
    std::string who = process.empty() ? "" : fmt::format("'{}'", process);
    if (!fault.node.empty()) {
      who += fmt::format("{}'{}'", who.empty() ? "" : ", ", fault.node);
    }
    if (fault.side == MessageFault::Side::kTake) {
      return text + " when taken" + (who.empty() ? "" : " by " + who);
    }
    return who.empty() ? text : text + (is_of_service(fault) ? " at " : " from ") + who;
  }
  std::string operator()(const ClockFault& fault) const {
    switch (fault.kind) {
      case ClockFault::Kind::kSkew:
        return fmt::format("skew of clock '{}' to {:g} times its rate", process, fault.rate);
      case ClockFault::Kind::kJump:
        return fmt::format("jump of clock '{}' by {:g} s", process, fault.by);
      case ClockFault::Kind::kStop:
        break;
    }
    return fmt::format("stop of clock '{}'", process);
  }
  std::string operator()(const DiskFault& fault) const {
    const std::string text =
        fault.directory.empty() ? "full disk of the logs" : fmt::format("full disk at '{}'", fault.directory);
    return fault.free == 0 ? text : fmt::format("{} but for {} bytes", text, fault.free);
  }
  std::string operator()(const NetworkFault& fault) const {
    const std::string between = fmt::format("between {} and {}", quoted(fault.group), quoted(fault.from));
    switch (fault.kind) {
      case NetworkFault::Kind::kLose:
        return fmt::format("loss of {:g}% of the packets {}", fault.share * 100, between);
      case NetworkFault::Kind::kDelay:
        return fmt::format("delay by {} of the packets {}", seconds(fault.by), between);
      case NetworkFault::Kind::kPartition:
        break;
    }
    return fmt::format("partition of {} from {}", quoted(fault.group), quoted(fault.from));
  }
};

}  // namespace

std::string describe_messages(const MessageFault& fault, bool several) {
  return fmt::format("{}{} {}", word_for(fault), several ? "s" : "", owner(fault));
}

std::string describe(const FaultRequest& fault) {
  std::string text = std::visit(Describer{fault.process}, fault.what);
  if (fault.lasts) {
    text += " for " + seconds(*fault.lasts);
  }
  return text;
}

}  // namespace launch
