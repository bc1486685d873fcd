// SPDX-License-Identifier: Apache-2.0
// <message topic="…">: messages that come on a topic while a test runs.
#include <fmt/format.h>

#include "actions/test/expectation_fields.hpp"
#include "actions/test/expectations.hpp"
#include "actions/values/message_texts.hpp"
#include "actions/values/ros_names.hpp"
#include "launcher/message_types/interface_library.hpp"
#include "launcher/message_types/message_condition.hpp"
#include "launcher/ros/ros_message_watch.hpp"

namespace launch {

namespace {

class Messages {
 public:
  explicit Messages(const Fields& fields) : fields_(fields), subject_(fields) {
    for (const char* const other : {"min", "max", "min_rate", "max_rate"}) {
      from_zero(fields, other);
      if (fields.has("absent") && fields.has(other)) {
        throw LaunchError("absent means max=\"0\": it goes without min, max and rates", fields.where("absent"), {},
                          Finding::kExclusive);
      }
    }
  }

  Expectation perform(LaunchContext& context) const {
    Scope& scope = context.scope();
    ExpectedMessages expected;
    WatchMessages watch{resolve_name(fields_.text("topic"), scope), fields_.text("type").perform(scope),
                        fields_.has("where") ? fields_.text("where").perform(scope) : ""};
    check(scope, watch);
    expected.watch = std::make_shared<RosMessageWatch>(context.ros_client(), std::move(watch), scope.environment);
    if (const std::optional<NumberField> rate = from_zero(fields_, "min_rate")) {
      expected.least_rate = rate->perform(scope);
    }
    if (const std::optional<NumberField> rate = from_zero(fields_, "max_rate")) {
      expected.most_rate = rate->perform(scope);
      if (expected.least_rate && *expected.most_rate < *expected.least_rate) {
        throw LaunchError(fmt::format("max_rate is less than min_rate, {:g}", *expected.least_rate),
                          fields_.where("max_rate"));
      }
    }
    const bool has_rate = expected.least_rate || expected.most_rate;
    expected.least = has_rate ? 2 : 1;  // a rate needs two
    if (const std::optional<NumberField> most = from_zero(fields_, "max")) {
      expected.most = static_cast<std::uint64_t>(most->perform(scope));
      expected.least = has_rate ? 2 : 0;
    }
    if (const std::optional<NumberField> least = from_zero(fields_, "min")) {
      expected.least = std::max(static_cast<std::uint64_t>(least->perform(scope)), std::uint64_t(has_rate ? 2 : 0));
    }
    if (fields_.boolean("absent", false).perform(scope)) {
      expected.least = 0;
      expected.most = 0;
    }
    if (expected.most && *expected.most < expected.least) {
      throw LaunchError(fmt::format("max is less than min, {}", expected.least), fields_.where("max"));
    }
    return subject_.of(std::move(expected), scope);
  }

 private:
  // Completes the name of the type. Looks for mistakes in it, and in the condition.
  void check(Scope& scope, WatchMessages& watch) const {
    InterfaceLibrary library(*scope.packages, scope.environment);
    std::shared_ptr<const MessageType> type;
    at_place(fields_.where("type"), [&] { type = library.message(watch.type); });
    watch.type = type->name;
    if (fields_.has("where")) {
      const SourceRange& place = fields_.where("where");
      at_place(place, [&] { MessageCondition(type, located(watch.condition, place)); });
    }
  }

  Fields fields_;
  ExpectationSubject subject_;
};

}  // namespace

ExpectationType message_expectation_type() {
  return {expectation_item(
              "message", "messages that come on a topic",
              {own_attribute("topic", AttributeType::kText, true, "", "their topic"),
               own_attribute("type", AttributeType::kText, true, "", "their type"),
               own_attribute("where", AttributeType::kText, false, "none",
                             "a condition on their fields, as `launch topic echo --filter` has it: data > 3"),
               own_attribute("min", AttributeType::kInteger, false, "1; with a rate: 2; with max: 0",
                             "how many there are at least"),
               own_attribute("max", AttributeType::kInteger, false, "any number", "how many there are at most"),
               own_attribute("absent", AttributeType::kBoolean, false, "false", "true: there is none"),
               own_attribute("min_rate", AttributeType::kFloat, false, "none",
                             "messages in a second at least, from the first to the last one"),
               own_attribute("max_rate", AttributeType::kFloat, false, "none", "messages in a second at most"),
               own_attribute("within", AttributeType::kFloat, false, "none",
                             "seconds from the begin of the test until there are enough")}),
          [](const Fields& fields) -> PerformExpectation {
            return [messages = Messages(fields)](LaunchContext& context) { return messages.perform(context); };
          }};
}

}  // namespace launch
