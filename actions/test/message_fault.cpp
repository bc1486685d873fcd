// SPDX-License-Identifier: Apache-2.0
// <fault topic|service="…" do="drop|duplicate|corrupt|delay">: what it does to messages.
#include <fmt/format.h>

#include "actions/test/fault_kinds.hpp"
#include "actions/values/range_field.hpp"
#include "actions/values/ros_condition.hpp"
#include "actions/values/ros_names.hpp"

namespace launch {

namespace {

constexpr const char* kNoEnd = "all";

struct MessageRanges {
  MessageFault fault = {};
  NumberRange first = {1, 1};
  NumberRange every = {1, 1};
  std::optional<NumberRange> count = NumberRange{1, 1};  // nullopt: no end
  NumberRange by = {};
};

void check_topic_or_service(const Fields& fields) {
  if (fields.has("topic") && fields.has("service")) {
    throw LaunchError("either a topic or a service suffers", fields.where("service"), {}, Finding::kExclusive);
  }
  if (!fields.has("topic") && !fields.has("service")) {
    const bool is_delay = fields.literal("do") == "delay";
    throw LaunchError("it is not said whose messages they are", fields.where(),
                      std::string("topic=\"/scan\" or service=\"/add\", by its name in the ROS graph") +
                          (is_delay ? "; with group=\"…\", the network is late" : ""),
                      Finding::kMissingAttribute);
  }
}

MessageFault::Side side_of(const Fields& fields) {
  using Side = MessageFault::Side;
  return fields.has("service") ? (choice(fields, "on", {"request", "response"}) == 0 ? Side::kRequest : Side::kResponse)
                               : (choice(fields, "on", {"publish", "take"}) == 0 ? Side::kPublish : Side::kTake);
}

// As the draws of a fault know it.
const char* identity_of(MessageFault::Side side) {
  switch (side) {
    case MessageFault::Side::kTake:
      return "true";
    case MessageFault::Side::kRequest:
      return "request";
    case MessageFault::Side::kResponse:
      return "response";
    case MessageFault::Side::kPublish:
      break;
  }
  return "false";
}

bool has_end(const Fields& fields) {
  const std::optional<Template> count = fields.optional_text("count");
  if (count && fields.has("for")) {
    throw LaunchError("either count or for says how long messages suffer", fields.where("for"), {},
                      Finding::kExclusive);
  }
  Scope nothing;
  return count ? !count->is_literal() || count->perform(nothing) != kNoEnd : !fields.has("for");
}

std::string identity_of(const MessageRanges& ranges) {
  return fmt::format("{} {} {} {} {}..{} {}..{} {} {}..{}", static_cast<int>(ranges.fault.kind), ranges.fault.topic,
                     ranges.fault.node, identity_of(ranges.fault.side), ranges.first.from, ranges.first.to,
                     ranges.every.from, ranges.every.to,
                     ranges.count ? fmt::format("{}..{}", ranges.count->from, ranges.count->to) : kNoEnd,
                     ranges.by.from, ranges.by.to);
}

MessageFault draw_of(const MessageRanges& ranges, const FaultDraw& draw) {
  MessageFault drawn = ranges.fault;
  drawn.first = draw.whole("occurrence", ranges.first);
  drawn.every = draw.whole("every", ranges.every);
  drawn.count = ranges.count ? std::optional(draw.whole("count", *ranges.count)) : std::nullopt;
  drawn.by = as_duration(draw.number("by", ranges.by));
  constexpr double kSeeds = 1e15;
  drawn.seed = draw.whole("bytes", {0, kSeeds});
  return drawn;
}

Setting<MessageRanges> name_row(AttributeSpec attribute, std::string MessageFault::*member) {
  const std::string name = attribute.name;
  return {.attribute = std::move(attribute),
          .perform = [name, member](const Fields& fields, Scope& scope, MessageRanges& ranges) {
            ranges.fault.*member = resolve_name(fields.text(name), scope);
          }};
}

void perform_count(const Fields& fields, Scope& scope, MessageRanges& ranges) {
  if (has_end(fields)) {
    ranges.count = perform_range(fields, "count", scope, RangeOf::kWholeNumbersFromOne);
  }
}

const std::vector<Setting<MessageRanges>>& message_rows() {
  using Type = AttributeType;
  constexpr RangeOf kWhole = RangeOf::kWholeNumbersFromOne;
  static const std::vector<Setting<MessageRanges>> rows = {
      name_row({"topic", Type::kText, false, "",
                "with drop, duplicate, corrupt and delay: the topic, under its name in the ROS graph", true},
               &MessageFault::topic),
      name_row({"service", Type::kText, false, "",
                "instead of topic: the service, under its name in the ROS graph; its messages are requests or "
                "responses",
                true},
               &MessageFault::topic),
      name_row({"node", Type::kText, false, "each",
                "with topic: the node that publishes or takes the messages; with service: the node that serves", true},
               &MessageFault::node),
      {.attribute = {"on", Type::kLiteral, false, "publish, request",
                     "with topic: publish, or take, so that one of several subscriptions is hit; with service: "
                     "request or response",
                     true},
       .perform = [](const Fields& fields, Scope&, MessageRanges& ranges) { ranges.fault.side = side_of(fields); }},
      range_row({"occurrence", Type::kText, false, "1",
                 "with topic and service: the number of the first message that is hit; a range, from which the seed "
                 "draws",
                 true},
                &MessageRanges::first, kWhole),
      range_row({"every", Type::kText, false, "1",
                 "with topic and service: from then on each message of so many; a range of numbers", true},
                &MessageRanges::every, kWhole),
      {.attribute = {"count", Type::kText, false, "1, or all with for",
                     "with topic and service: how many messages are hit; a range of numbers, or all", true},
       .perform = perform_count,
       .checks_literal = true},
      range_row(
          {"by", Type::kText, false, "", "with delay: how late, with jump: how far, in seconds, or a range", true},
          &MessageRanges::by)};
  return rows;
}

}  // namespace

std::vector<AttributeSpec> message_fault_attributes() {
  return declared_attributes(message_rows());
}

PerformFault message_fault(const Fields& fields, MessageFault::Kind kind) {
  const MessageFault::Side side = side_of(fields);
  check_topic_or_service(fields);
  const bool ends = has_end(fields);
  check_settings(message_rows(), fields);
  if (kind == MessageFault::Kind::kDelay && !fields.has("by")) {
    throw LaunchError("it is not said how late the messages are", fields.where(), "by=\"0.2\": seconds",
                      Finding::kMissingAttribute);
  }
  return [&fields, kind, side, ends](const std::string& process, Scope& scope) {
    MessageRanges ranges;
    ranges.fault.kind = kind;
    ranges.fault.side = side;
    if (!ends) {
      ranges.count.reset();
    }
    perform_settings(message_rows(), fields, scope, ranges);
    const bool is_random = ranges.first.is_random() || ranges.every.is_random() ||
                           (ranges.count && ranges.count->is_random()) || ranges.by.is_random();
    return FaultRanges{fmt::format("{} {}", process, identity_of(ranges)), is_random,
                       [ranges](const FaultDraw& draw) { return draw_of(ranges, draw); }};
  };
}

}  // namespace launch
