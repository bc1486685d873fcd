// SPDX-License-Identifier: Apache-2.0
#include "actions/message_fault.hpp"

#include <fmt/format.h>

#include "actions/expectation_fields.hpp"
#include "actions/ros_condition.hpp"
#include "actions/ros_names.hpp"

namespace launch {

namespace {

constexpr const char* kNoEnd = "all";

const Template& topic_of(const Fields& fields) {
  if (!fields.has("topic")) {
    const bool is_delay = fields.literal("do") == "delay";
    throw LaunchError("it is not said whose messages they are", fields.where(),
                      is_delay ? "topic=\"/scan\" names a topic of the ROS graph; with group=\"…\", the network is late"
                               : "topic=\"/scan\" names a topic of the ROS graph",
                      Finding::kMissingAttribute);
  }
  return fields.text("topic");
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
                     fault.on_take, first.from, first.to, every.from, every.to,
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
      {"node", AttributeType::kText, false, "each", "with topic: the node that publishes or takes the messages", true},
      {"on", AttributeType::kLiteral, false, "publish",
       "with topic: publish, or take, so that one of several subscriptions is hit", true},
      {"occurrence", AttributeType::kText, false, "1",
       "with topic: the number of the first message that is hit; a range, from which the seed draws", true},
      {"every", AttributeType::kText, false, "1",
       "with topic: from then on each message of so many; a range of numbers", true},
      {"count", AttributeType::kText, false, "1, or all with for",
       "with topic: how many messages are hit; a range of numbers, or all", true},
      {"by", AttributeType::kText, false, "", "with delay: how late, with jump: how far, in seconds, or a range",
       true}};
}

MessageFaultFields::MessageFaultFields(const Fields& fields, MessageFault::Kind kind)
    : kind_(kind),
      topic_(topic_of(fields)),
      node_(fields.optional_text("node")),
      on_take_(choice(fields, "on", {"publish", "take"}) == 1),
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
  ranges.fault.topic = resolve_name(topic_, scope);
  ranges.fault.node = node_ ? resolve_name(*node_, scope) : "";
  ranges.fault.on_take = on_take_;
  ranges.first = range(occurrence_, scope, 1);
  ranges.every = range(every_, scope, 1);
  if (has_end_) {
    ranges.count = range(count_, scope, 1);
  }
  ranges.by = range(by_, scope, 0);
  return ranges;
}

}  // namespace launch
