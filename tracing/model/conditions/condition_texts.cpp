// SPDX-License-Identifier: Apache-2.0
// What is said about conditions: in messages, in a dry run.
#include <fmt/format.h>

#include <cmath>

#include "tracing/model/conditions/live_condition.hpp"

namespace tracing {
namespace {

using Kind = LiveCondition::Kind;
using Subject = LiveCondition::Subject;

// What may be late: one of it, all of it, and what is said of one that was.
struct LateWords {
  const char* one;
  const char* all;
  const char* took = "took";
  const char* take = "take";
};

LateWords late_words(Subject subject) {
  switch (subject) {
    case Subject::kTopic:
      return {"a message on", "messages on"};
    case Subject::kNode:
      return {"a callback of", "callbacks of"};
    case Subject::kService:
      return {"a response of", "responses of"};
    case Subject::kAction:
      return {"a result of", "results of"};
    case Subject::kTimer:
      return {"a timer of", "calls of timers of", "waited", "wait"};
    case Subject::kChain:
      return {"the way", "ways"};
    case Subject::kProcess:
      break;  // never late
  }
  return {"", ""};
}

std::string late_sentence(const LiveCondition& condition, const ConditionChange& change) {
  const LateWords words = late_words(condition.subject);
  if (!change.holds) {
    return fmt::format("{} {} {} no longer than {} again", words.all, condition.name, words.take,
                       time_text(condition.max));
  }
  const std::chrono::nanoseconds took(std::llround(change.figure * 1e9));
  if (condition.share < 1) {
    return fmt::format("{:.3g} % of the {} {} in {} {} longer than {}, the last of them {}", 100 * change.late,
                       words.all, condition.name, time_text(condition.window), words.took, time_text(condition.max),
                       short_time_text(took));
  }
  return fmt::format("{} {} {} {}, more than {}", words.one, condition.name, words.took, short_time_text(took),
                     time_text(condition.max));
}

std::string bytes_text(double bytes) {
  constexpr double kMib = 1024.0 * 1024;
  return bytes >= 1024 * kMib ? fmt::format("{:.4g} GiB", bytes / kMib / 1024)
                              : fmt::format("{:.4g} MiB", bytes / kMib);
}

std::string process_sentence(const LiveCondition& condition, const ConditionChange& change) {
  const double limit = condition.above.value_or(0);
  const std::string in = time_text(condition.window);
  switch (condition.kind) {
    case Kind::kMemory:
      return change.holds ? fmt::format("{} has {} of memory, for {} more than {}", condition.name,
                                        bytes_text(change.figure), in, bytes_text(limit))
                          : fmt::format("{} has no more than {} of memory again", condition.name, bytes_text(limit));
    case Kind::kGrowth:
      return change.holds ? fmt::format("the memory of {} has grown by {} in {}, more than {}", condition.name,
                                        bytes_text(change.figure), in, bytes_text(limit))
                          : fmt::format("the memory of {} grows by no more than {} in {} again", condition.name,
                                        bytes_text(limit), in);
    default:
      return change.holds
                 ? fmt::format("{} takes {:.3g} % of a processor in {}, more than {:.6g} %", condition.name,
                               100 * change.figure, in, 100 * limit)
                 : fmt::format("{} takes no more than {:.6g} % of a processor again", condition.name, 100 * limit);
  }
}

std::string loss_sentence(const LiveCondition& condition, const ConditionChange& change) {
  const std::string limit = fmt::format("{:.6g} %", 100 * (1 - condition.share));
  if (!change.holds) {
    return condition.share < 1
               ? fmt::format("no more than {} of the messages on {} are lost again", limit, condition.name)
               : fmt::format("no message on {} is lost any more", condition.name);
  }
  const std::string lost =
      fmt::format("{:.0f} message{} on {}", change.figure, change.figure > 1 ? "s" : "", condition.name);
  if (condition.share < 1) {
    return fmt::format("{} lost in {}, {:.3g} % of all, more than {}", lost, time_text(condition.window),
                       100 * change.late, limit);
  }
  return fmt::format("{} lost", lost);
}

}  // namespace

const char* name_of(LiveCondition::Subject subject) {
  switch (subject) {
    case Subject::kTopic:
      return "topic";
    case Subject::kNode:
      return "node";
    case Subject::kService:
      return "service";
    case Subject::kAction:
      return "action";
    case Subject::kTimer:
      return "timer";
    case Subject::kProcess:
      return "process";
    case Subject::kChain:
      return "chain";
  }
  return "";
}

std::string describe(const LiveCondition& condition) {
  const std::string of = is_of_process(condition) ? fmt::format("of '{}'", condition.name)
                                                  : fmt::format("of {} {}", name_of(condition.subject), condition.name);
  const std::string in = " in " + time_text(condition.window);
  switch (condition.kind) {
    case Kind::kSilence:
      return fmt::format("on_silence {} for {}", of, time_text(condition.window));
    case Kind::kRate:
      return fmt::format("on_rate {} {} {:.4g} Hz{}", of, condition.below ? "below" : "above",
                         condition.below ? *condition.below : condition.above.value_or(0), in);
    case Kind::kLate:
      return fmt::format("on_late {} above {}", of, time_text(condition.max)) +
             (condition.share < 1 ? fmt::format(", {:.6g} of all{}", condition.share, in) : "");
    case Kind::kLoss:
      return fmt::format("on_loss {}", of) +
             (condition.share < 1 ? fmt::format(" above {:.6g} of all{}", 1 - condition.share, in) : "");
    case Kind::kMemory:
      return fmt::format("on_memory {} above {} for {}", of, bytes_text(condition.above.value_or(0)),
                         time_text(condition.window));
    case Kind::kGrowth:
      return fmt::format("on_memory {} that grows by more than {}{}", of, bytes_text(condition.above.value_or(0)), in);
    case Kind::kProcessor:
      return fmt::format("on_overload {} above {:.6g} % of a processor for {}", of, 100 * condition.above.value_or(0),
                         time_text(condition.window));
  }
  return "";
}

std::string sentence(const LiveCondition& condition, const ConditionChange& change) {
  if (condition.kind == Kind::kLate) {
    return late_sentence(condition, change);
  }
  if (condition.kind == Kind::kLoss) {
    return loss_sentence(condition, change);
  }
  if (is_of_process(condition)) {
    return process_sentence(condition, change);
  }
  const bool is_topic = condition.subject == Subject::kTopic;
  if (condition.kind == Kind::kSilence) {
    if (change.holds) {
      return is_topic ? fmt::format("no message on {} for {:.3g} s", condition.name, change.figure)
                      : fmt::format("no callback of {} has ended for {:.3g} s", condition.name, change.figure);
    }
    return fmt::format("the silence of {} is over after {:.3g} s", condition.name, change.figure);
  }
  const char* const side = condition.below ? "below" : "above";
  const double limit = condition.below ? *condition.below : condition.above.value_or(0);
  return fmt::format("{:.4g} messages/s on {} in {}, {} {} {:.4g}", change.figure, condition.name,
                     time_text(condition.window), change.holds ? "which is" : "no longer", side, limit);
}

}  // namespace tracing
