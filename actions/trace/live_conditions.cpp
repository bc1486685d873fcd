// SPDX-License-Identifier: Apache-2.0
// <on_silence>, <on_rate>, <on_late>, <on_loss>: visit actions when the trace of the running system shows that nodes do
// nothing any more, too much, or too little, or take too long, or that messages are lost.
#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "actions/trace/condition_rows.hpp"
#include "actions/values/ros_names.hpp"
#include "tracing/model/conditions/live_condition.hpp"

namespace launch {

namespace {

using tracing::LiveCondition;
using Values = HandledCondition;
using Row = ConditionRow;

constexpr Duration kShortestMax = std::chrono::microseconds(1);
constexpr Duration kUsualWindow = std::chrono::seconds(2);
constexpr double kFewestMessages = 2;

Row name_row(const char* attribute, bool required, const char* help, LiveCondition::Subject subject) {
  return {.attribute = {attribute, AttributeType::kText, required, "", help},
          .perform = [attribute, subject](const Fields& fields, Scope& scope, Values& handled) {
            handled.event.condition.subject = subject;
            handled.event.condition.name = resolve_name(fields.text(attribute), scope);
          }};
}

void check_silence(const Fields& fields) {
  if (fields.has("topic") == fields.has("node")) {
    throw LaunchError(fields.has("topic") ? "on_silence is about a topic or a node, not both"
                                          : "it is not said what must not be silent",
                      fields.has("topic") ? fields.where("node") : fields.where(),
                      fields.has("topic") ? "write an on_silence for each" : "give topic=\"…\" or node=\"…\"",
                      fields.has("topic") ? Finding::kExclusive : Finding::kMissingAttribute);
  }
}

Row limit_row(const char* attribute, const char* help, std::optional<double> LiveCondition::*member) {
  return {.attribute = {attribute, AttributeType::kFloat, false, "", help},
          .perform = [attribute, member](const Fields& fields, Scope& scope, Values& handled) {
            const double limit = fields.number(attribute)->perform(scope);
            if (!(limit > 0) || std::isinf(limit)) {
              throw LaunchError(fmt::format("{} is a rate in Hz, above 0, got {}", attribute, limit),
                                fields.where(attribute), "write 5 for five messages a second");
            }
            handled.event.condition.*member = limit;
          }};
}

void check_rate_limits(const Fields& fields) {
  if (fields.has("below") == fields.has("above")) {
    throw LaunchError(fields.has("below") ? "on_rate has one limit, below or above" : "on_rate has no limit",
                      fields.has("below") ? fields.where("above") : fields.where(),
                      fields.has("below") ? "write an on_rate for each" : "give below=\"…\" or above=\"…\", in Hz",
                      fields.has("below") ? Finding::kExclusive : Finding::kMissingAttribute);
  }
}

void check_one_subject(const Fields& fields) {
  const char* first = nullptr;
  for (const LiveCondition::Subject subject : tracing::kRecordedSubjects) {
    const char* const attribute = name_of(subject);
    if (!fields.has(attribute)) {
      continue;
    }
    if (first != nullptr) {
      throw LaunchError(fmt::format("on_late is about one thing, but both '{}' and '{}' are given", first, attribute),
                        fields.where(attribute), "write an on_late for each", Finding::kExclusive);
    }
    first = attribute;
  }
  if (first == nullptr) {
    throw LaunchError("it is not said what must not be late", fields.where(),
                      "give topic=\"…\", node=\"…\", service=\"…\", action=\"…\", timer=\"…\" or chain=\"…\"",
                      Finding::kMissingAttribute);
  }
}

// The nodes of a chain, by their full names; patterns are left as they are.
Row chain_row() {
  return {.attribute =
              {"chain", AttributeType::kText, false, "",
               "nodes that messages go through, as in /camera -> /fusion -> /brake: from the begin of a callback of "
               "the first one to the end of one of the last one"},
          .perform =
              [](const Fields& fields, Scope& scope, Values& handled) {
                const Template& given = fields.text("chain");
                const std::string text = given.perform(scope);
                std::optional<std::vector<std::string>> nodes = tracing::nodes_of_chain(text);
                if (!nodes) {
                  throw LaunchError(fmt::format("a chain is two or more nodes with -> between them, got '{}'", text),
                                    given.where(), "write it as /camera -> /fusion -> /brake");
                }
                for (std::string& node : *nodes) {
                  if (node.find('*') == std::string::npos) {
                    node = resolve_name(node, scope, given.where());
                  }
                }
                handled.event.condition.subject = LiveCondition::Subject::kChain;
                handled.event.condition.name = tracing::chain_of_nodes(*nodes);
              },
          .checks_literal = true};
}

Row lost_share_row() {
  return {.attribute = {"above", AttributeType::kFloat, false, "0",
                        "in the window, so much of all may be lost: 0.01 allows one of 100 to be lost"},
          .perform = [](const Fields& fields, Scope& scope, Values& handled) {
            const double share = fields.number("above")->perform(scope);
            if (!(share >= 0) || share >= 1) {
              throw LaunchError(
                  fmt::format("above is a share of all messages, at least 0 and below 1, got {}", share),
                  fields.where("above"),
                  share >= 1 && share < 100 ? fmt::format("did you mean {}?", share / 100) : "write 0.01 for 1 %");
            }
            handled.event.condition.share = 1 - share;
          }};
}

Row max_row() {
  return {.attribute = {"max", AttributeType::kText, true, "", "how long it may take, such as 50ms"},
          .perform =
              [](const Fields& fields, Scope& scope, Values& handled) {
                handled.event.condition.max = perform_time_with_unit("max", fields, scope, kShortestMax);
              },
          .checks_literal = true};
}

Row share_row() {
  return {.attribute = {"share", AttributeType::kFloat, false, "1",
                        "in the window, so much of all must take no longer: 0.99 allows one of 100 to be late"},
          .perform = [](const Fields& fields, Scope& scope, Values& handled) {
            const double share = fields.number("share")->perform(scope);
            if (!(share > 0) || share > 1) {
              throw LaunchError(
                  fmt::format("share is above 0 and at most 1, got {}", share), fields.where("share"),
                  share > 1 && share <= 100 ? fmt::format("did you mean {}?", share / 100) : "write 0.99 for 99 %");
            }
            handled.event.condition.share = share;
          }};
}

// One message more or less says nothing, so fewer than two can't be told from none.
void require_messages(const Fields& fields, const LiveCondition& condition) {
  if (!condition.below) {
    return;
  }
  const double seconds = std::chrono::duration<double>(condition.window).count();
  if (*condition.below * seconds < kFewestMessages) {
    throw LaunchError(fmt::format("a rate below {:.4g} Hz can't be told in a window of {}", *condition.below,
                                  tracing::time_text(condition.window)),
                      fields.where("below"),
                      fmt::format("make the window at least {:.4g}s, or use on_silence",
                                  std::ceil(kFewestMessages / *condition.below * 1000) / 1000));
  }
}

}  // namespace

ActionType on_silence_action() {
  return handler_of<OnCondition>(
      "on_silence",
      "Visits its actions each time nothing was published on a topic, or no callback of a node has ended, for a time; "
      "needs a trace.",
      with_common_rows(
          {name_row("topic", false, "a topic that processes of the launch publish", LiveCondition::Subject::kTopic),
           name_row("node", false, "a node of the launch", LiveCondition::Subject::kNode),
           window_row("for", true, "", "how long it must be silent, such as 2s or 500ms")}),
      check_silence, [](const Fields&, LaunchContext&, Values& handled) {
        handled.event.condition.kind = LiveCondition::Kind::kSilence;
      });
}

ActionType on_rate_action() {
  return handler_of<OnCondition>(
      "on_rate",
      "Visits its actions each time the rate of the messages on a topic has gone beyond a limit; needs a trace.",
      with_common_rows(
          {name_row("topic", true, "a topic that processes of the launch publish", LiveCondition::Subject::kTopic),
           limit_row("below", "fewer messages a second, in Hz", &LiveCondition::below),
           limit_row("above", "more messages a second, in Hz", &LiveCondition::above),
           window_row("window", false, "2s", "over which messages are counted")}),
      check_rate_limits, [](const Fields& fields, LaunchContext&, Values& handled) {
        LiveCondition& condition = handled.event.condition;
        condition.kind = LiveCondition::Kind::kRate;
        if (!fields.has("window")) {
          condition.window = kUsualWindow;
        }
        require_messages(fields, condition);
      });
}

ActionType on_late_action() {
  return handler_of<OnCondition>(
      "on_late",
      "Visits its actions each time messages on a topic take too long to their callbacks, callbacks of a node run too "
      "long, timers are called too late, responses of a service or results of an action take too long, or the way "
      "through a chain of nodes does; needs a trace.",
      with_common_rows(
          {name_row("topic", false, "a topic to which nodes of the launch are subscribed: from sending to the callback",
                    LiveCondition::Subject::kTopic),
           name_row("node", false, "a node of the launch: the time that a callback runs",
                    LiveCondition::Subject::kNode),
           name_row("service", false, "a service that nodes of the launch call: from the request to the response",
                    LiveCondition::Subject::kService),
           name_row("action", false,
                    "an action that nodes of the launch are clients of: from the request for the result to the result",
                    LiveCondition::Subject::kAction),
           name_row("timer", false, "a node of the launch: from when a timer of it is due to the callback",
                    LiveCondition::Subject::kTimer),
           chain_row(), max_row(), share_row(), window_row("window", false, "2s", "over which they are counted")}),
      check_one_subject, [](const Fields& fields, LaunchContext&, Values& handled) {
        LiveCondition& condition = handled.event.condition;
        condition.kind = LiveCondition::Kind::kLate;
        if (!fields.has("window")) {
          condition.window = kUsualWindow;
        }
      });
}

ActionType on_loss_action() {
  return handler_of<OnCondition>(
      "on_loss", "Visits its actions each time subscriptions to a topic miss messages; needs a trace.",
      with_common_rows({name_row("topic", true, "a topic to which nodes of the launch are subscribed",
                                 LiveCondition::Subject::kTopic),
                        lost_share_row(), window_row("window", false, "2s", "over which they are counted")}),
      {}, [](const Fields& fields, LaunchContext&, Values& handled) {
        LiveCondition& condition = handled.event.condition;
        condition.kind = LiveCondition::Kind::kLoss;
        if (!fields.has("window")) {
          condition.window = kUsualWindow;
        }
      });
}

}  // namespace launch
