// SPDX-License-Identifier: Apache-2.0
// <message topic="…" type="…"/> of a test: messages that come on a topic.
#include <fmt/format.h>

#include <algorithm>

#include "actions/test/expectations.hpp"
#include "actions/values/message_texts.hpp"
#include "actions/values/ros_names.hpp"
#include "launcher/message_types/interface_library.hpp"
#include "launcher/message_types/message_condition.hpp"
#include "launcher/ros/ros_message_watch.hpp"

namespace launch {

namespace {

void check_messages(const Fields& fields) {
  for (const char* const other : {"min", "max", "min_rate", "max_rate"}) {
    if (fields.has("absent") && fields.has(other)) {
      throw LaunchError("absent means max=\"0\": it goes without min, max and rates", fields.where("absent"), {},
                        Finding::kExclusive);
    }
  }
}

// Completes the name of the type. Looks for mistakes in it, and in the condition.
WatchMessages perform_watch(const Fields& fields, Scope& scope) {
  WatchMessages watch{resolve_name(fields.text("topic"), scope), fields.text("type").perform(scope),
                      fields.has("where") ? fields.text("where").perform(scope) : ""};
  InterfaceLibrary library(*scope.packages, scope.environment);
  std::shared_ptr<const MessageType> type;
  at_place(fields.where("type"), [&] { type = library.message(watch.type); });
  watch.type = type->name;
  if (fields.has("where")) {
    const SourceRange& place = fields.where("where");
    at_place(place, [&] { MessageCondition(type, located(watch.condition, place)); });
  }
  return watch;
}

void finish_messages(const Fields& fields, LaunchContext& context, ExpectedMessages& messages) {
  Scope& scope = context.scope();
  messages.watch =
      std::make_shared<RosMessageWatch>(context.ros_client(), perform_watch(fields, scope), scope.environment);
  if (messages.least_rate && messages.most_rate && *messages.most_rate < *messages.least_rate) {
    throw LaunchError(fmt::format("max_rate is less than min_rate, {:g}", *messages.least_rate),
                      fields.where("max_rate"));
  }
  const std::uint64_t of_rate = messages.least_rate || messages.most_rate ? 2 : 0;  // a rate needs two
  if (fields.has("min")) {
    messages.least = std::max(messages.least, of_rate);
  } else {
    messages.least = std::max(std::uint64_t{messages.most ? 0U : 1U}, of_rate);
  }
  if (fields.boolean("absent", false).perform(scope)) {
    messages.least = 0;
    messages.most = 0;
  }
  if (messages.most && *messages.most < messages.least) {
    throw LaunchError(fmt::format("max is less than min, {}", messages.least), fields.where("max"));
  }
}

// A number of messages in a second.
Setting<ExpectedMessages> rate_row(const char* name, const char* help,
                                   std::optional<double> ExpectedMessages::*member) {
  return {.attribute = own_attribute(name, AttributeType::kFloat, false, "none", help),
          .place = [member](ExpectedMessages& messages) -> SettingPlace {
            return NumberFromZero{&(messages.*member).emplace()};
          }};
}

}  // namespace

ExpectationType message_expectation_type() {
  const auto text = [](const char* name, bool required, const char* fallback, const char* help) {
    return Setting<ExpectedMessages>{.attribute = own_attribute(name, AttributeType::kText, required, fallback, help)};
  };
  return expectation_of<ExpectedMessages>(
      "message", "messages that come on a topic",
      {text("topic", true, "", "their topic"),
       text("type", true, "", "their type"),
       text("where", false, "none", "a condition on their fields, as `launch topic echo --filter` has it: data > 3"),
       count_row("min", "1; with a rate: 2; with max: 0", "how many there are at least", &ExpectedMessages::least),
       count_row("max", "any number", "how many there are at most", &ExpectedMessages::most),
       {.attribute = own_attribute("absent", AttributeType::kBoolean, false, "false", "true: there is none")},
       {.attribute = own_attribute("without_publisher", AttributeType::kBoolean, false, "false",
                                   "true: max and absent hold as well on a topic that nobody has published"),
        .place = place_of(&ExpectedMessages::without_publisher)},
       rate_row("min_rate", "messages in a second at least, from the first to the last one",
                &ExpectedMessages::least_rate),
       rate_row("max_rate", "messages in a second at most", &ExpectedMessages::most_rate),
       {.attribute = within_attribute("seconds from the begin of the test until there are enough")}},
      check_messages, finish_messages);
}

}  // namespace launch
