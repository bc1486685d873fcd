// SPDX-License-Identifier: Apache-2.0
#include "actions/test/message_fault.hpp"

#include <fmt/format.h>

#include "actions/test/expectation_fields.hpp"
#include "actions/values/ros_condition.hpp"
#include "actions/values/ros_names.hpp"

namespace launch {

namespace {

constexpr const char* kNoEnd = "all";

// The topic, or the service.
const Template& name_of(const Fields& fields) {
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
  return fields.text(fields.has("topic") ? "topic" : "service");
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

NumberRange range(const std::optional<RangeField>& field, Scope& scope, double fallback) {
  return field ? field->perform(scope) : NumberRange{fallback, fallback};
}

}  // namespace

std::string MessageFaultRanges::identity() const {
  return fmt::format("{} {} {} {} {}..{} {}..{} {} {}..{}", static_cast<int>(fault.kind), fault.topic, fault.node,
                     identity_of(fault.side), first.from, first.to, every.from, every.to,
                     count ? fmt::format("{}..{}", count->from, count->to) : kNoEnd, by.from, by.to);
}

bool MessageFaultRanges::is_random() const {
  return first.is_random() || every.is_random() || (count && count->is_random()) || by.is_random();
}

MessageFault MessageFaultRanges::draw(const FaultDraw& draw) const {
  MessageFault drawn = fault;
  drawn.first = draw.whole("occurrence", first);
  drawn.every = draw.whole("every", every);
  drawn.count = count ? std::optional(draw.whole("count", *count)) : std::nullopt;
  drawn.by = as_duration(draw.number("by", by));
  constexpr double kSeeds = 1e15;
  drawn.seed = draw.whole("bytes", {0, kSeeds});
  return drawn;
}

std::vector<AttributeSpec> MessageFaultFields::attributes() {
  return {
      {"topic", AttributeType::kText, false, "",
       "with drop, duplicate, corrupt and delay: the topic, under its name in the ROS graph", true},
      {"service", AttributeType::kText, false, "",
       "instead of topic: the service, under its name in the ROS graph; its messages are requests or responses", true},
      {"node", AttributeType::kText, false, "each",
       "with topic: the node that publishes or takes the messages; with service: the node that serves", true},
      {"on", AttributeType::kLiteral, false, "publish, request",
       "with topic: publish, or take, so that one of several subscriptions is hit; with service: request or response",
       true},
      {"occurrence", AttributeType::kText, false, "1",
       "with topic and service: the number of the first message that is hit; a range, from which the seed draws", true},
      {"every", AttributeType::kText, false, "1",
       "with topic and service: from then on each message of so many; a range of numbers", true},
      {"count", AttributeType::kText, false, "1, or all with for",
       "with topic and service: how many messages are hit; a range of numbers, or all", true},
      {"by", AttributeType::kText, false, "", "with delay: how late, with jump: how far, in seconds, or a range",
       true}};
}

MessageFaultFields::MessageFaultFields(const Fields& fields, MessageFault::Kind kind)
    : kind_(kind),
      side_(side_of(fields)),
      name_(name_of(fields)),
      node_(fields.optional_text("node")),
      has_end_(has_end(fields)),
      occurrence_(RangeField::of(fields, "occurrence", true)),
      every_(RangeField::of(fields, "every", true)),
      count_(has_end_ ? RangeField::of(fields, "count", true) : std::nullopt),
      by_(RangeField::of(fields, "by")) {
  if (kind_ == MessageFault::Kind::kDelay && !by_) {
    throw LaunchError("it is not said how late the messages are", fields.where(), "by=\"0.2\": seconds",
                      Finding::kMissingAttribute);
  }
}

MessageFaultRanges MessageFaultFields::perform(Scope& scope) const {
  MessageFaultRanges ranges;
  ranges.fault.kind = kind_;
  ranges.fault.side = side_;
  ranges.fault.topic = resolve_name(name_, scope);
  ranges.fault.node = node_ ? resolve_name(*node_, scope) : "";
  ranges.first = range(occurrence_, scope, 1);
  ranges.every = range(every_, scope, 1);
  if (has_end_) {
    ranges.count = range(count_, scope, 1);
  }
  ranges.by = range(by_, scope, 0);
  return ranges;
}

}  // namespace launch
