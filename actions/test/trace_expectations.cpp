// SPDX-License-Identifier: Apache-2.0
// The items of <test> that say what the trace of its run holds: <event>, <events_in_order>, <delivery>, <latency>,
// <callback>, <timer_period>, <allocations>.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "actions/test/expectations.hpp"
#include "actions/values/ros_condition.hpp"
#include "actions/values/ros_names.hpp"
#include "tracing/record/plan/ros_events.hpp"

namespace launch {

namespace {

constexpr double kAll = 100;

AttributeSpec text_attribute(const char* name, bool required, const char* help) {
  return own_attribute(name, AttributeType::kText, required, required ? "" : "any", help);
}

// The name of a node, a topic or a service.
template <typename Expected>
Setting<Expected> name_row(const char* name, bool required, const char* help, std::string Expected::*member) {
  return {.attribute = text_attribute(name, required, help),
          .perform = [name, member](const Fields& fields, Scope& scope, Expected& expected) {
            expected.*member = resolve_name(fields.text(name), scope);
          }};
}

double perform_percentile(const Fields& fields, Scope& scope) {
  const double percentile = fields.number("percentile")->perform(scope);
  if (!(percentile > 0 && percentile <= kAll)) {
    throw LaunchError(fmt::format("percentile is a number above 0, and 100 at most, got {:g}", percentile),
                      fields.where("percentile"));
  }
  return percentile;
}

AttributeSpec percentile_attribute() {
  return own_attribute("percentile", AttributeType::kFloat, false, "100", "how many of a hundred must be within it");
}

void check_bounds(const Fields& fields) {
  if (!fields.has("max_ms") && !fields.has("min_ms")) {
    throw LaunchError("there is no bound", fields.where(), "give max_ms, milliseconds", Finding::kMissingAttribute);
  }
}

// A time in milliseconds, which is a bound of the time of what is expected.
template <typename Expected, typename Time>
Setting<Expected> bound_row(const char* name, const char* fallback, const char* help, Time TimeBounds::*member) {
  return {.attribute = own_attribute(name, AttributeType::kFloat, false, fallback, help),
          .place = [member](Expected& expected) -> SettingPlace { return &(expected.time.*member); },
          .perform =
              [name, member](const Fields& fields, Scope& scope, Expected& expected) {
                expected.time.*member = perform_time(fields, name, scope, kMillisecond);
              }};
}

// With min_ms, max_ms and percentile.
template <typename Expected>
Rows<Expected> with_bounds(Rows<Expected> rows) {
  rows.push_back(bound_row<Expected>("min_ms", "0", "milliseconds that it takes at least", &TimeBounds::least));
  Setting<Expected> most =
      bound_row<Expected>("max_ms", "none", "milliseconds that it takes at most", &TimeBounds::most);
  most.perform = [read = std::move(most.perform)](const Fields& fields, Scope& scope, Expected& expected) {
    read(fields, scope, expected);
    const TimeBounds& bounds = expected.time;
    if (*bounds.most < bounds.least) {
      throw LaunchError(fmt::format("max_ms is less than min_ms, {:g}",
                                    std::chrono::duration<double, std::milli>(bounds.least).count()),
                        fields.where("max_ms"), {}, Finding::kWrongValue);
    }
  };
  rows.push_back(std::move(most));
  rows.push_back(
      {.attribute = percentile_attribute(), .perform = [](const Fields& fields, Scope& scope, Expected& expected) {
         expected.time.percentile = perform_percentile(fields, scope);
       }});
  return rows;
}

// Checks the name, and says where both are.
void locate_event(const Fields& fields, ExpectedEvent& event) {
  event.name_where = fields.where("name");
  if (const std::string reason = tracing::why_no_ros_event(event.name); !reason.empty()) {
    throw LaunchError(reason, event.name_where);
  }
  event.condition_where = fields.where("where");
}

Rows<ExpectedEvent> event_rows(const char* name_help, const char* condition_help) {
  return {{.attribute = text_attribute("name", true, name_help), .place = place_of(&ExpectedEvent::name)},
          {.attribute = own_attribute("where", AttributeType::kText, false, "none", condition_help),
           .place = place_of(&ExpectedEvent::condition)},
          {.attribute = process_attribute(false)}};
}

ExpectationType event_type() {
  Rows<ExpectedEvent> rows = event_rows("the event, or a pattern: ros2:rcl_publisher_init, ros2:rcl_*",
                                        "a condition on its fields, as `launch trace read --where` has it");
  rows.push_back(count_row("min", "1; with max: 0", "how many there are at least", &ExpectedEvent::least));
  rows.push_back(count_row("max", "any number", "how many there are at most", &ExpectedEvent::most));
  return expectation_of<ExpectedEvent>("event", "events that the trace of the test holds", std::move(rows), nullptr,
                                       [](const Fields& fields, LaunchContext&, ExpectedEvent& event) {
                                         locate_event(fields, event);
                                         if (event.most && !fields.has("min")) {
                                           event.least = 0;
                                         }
                                       });
}

const Rows<ExpectedEvent>& step_rows() {
  static const Rows<ExpectedEvent> rows = event_rows("the event, or a pattern", "a condition on its fields");
  return rows;
}

void finish_order(const Fields& fields, LaunchContext& context, ExpectedEventOrder& order) {
  for (const Fields* const item : fields.items("event")) {
    ExpectedEventOrder::Step& step = order.steps.emplace_back();
    perform_settings(step_rows(), *item, context.scope(), step.event);
    locate_event(*item, step.event);
    if (item->has("process")) {
      step.process = item->text("process").perform(context.scope());
      step.process_where = item->where("process");
    }
  }
}

ExpectationType order_type() {
  ExpectationType type = expectation_of<ExpectedEventOrder>(
      "events_in_order", "events of the trace that come one after the other, with any others between them", {},
      [](const Fields& fields) {
        if (fields.items("event").size() < 2) {
          throw LaunchError("an order needs two events at least", fields.where(), "give each one: <event name=\"…\"/>",
                            Finding::kMissingAttribute);
        }
      },
      finish_order);
  type.item.items = {
      {.tag = "event", .help = "the next event", .attributes = declared_attributes(step_rows()), .extension = true}};
  return type;
}

ExpectationType delivery_type() {
  return expectation_of<ExpectedDelivery>(
      "delivery", "messages that reach a callback",
      {name_row("topic", true, "their topic", &ExpectedDelivery::topic),
       name_row("from", false, "the node that publishes them", &ExpectedDelivery::from),
       name_row("to", false, "the node that takes them", &ExpectedDelivery::to),
       count_row("min", "1", "how many messages there are at least", &ExpectedDelivery::least),
       count_row("max_lost", "0", "how many do not, of those after the first that does",
                 &ExpectedDelivery::most_lost)});
}

void check_latency(const Fields& fields) {
  if (fields.has("topic") == fields.has("nodes")) {
    throw LaunchError(fields.has("topic") ? "either a topic or nodes" : "neither a topic nor nodes", fields.where(),
                      "topic=\"…\" is the way of a message, nodes=\"/a /b /c\" a chain of callbacks",
                      Finding::kExclusive);
  }
  if (fields.has("nodes") && (fields.has("from") || fields.has("to"))) {
    throw LaunchError("from and to go with a topic only", fields.where(fields.has("from") ? "from" : "to"), {},
                      Finding::kExclusive);
  }
  check_bounds(fields);
}

void perform_nodes(const Fields& fields, Scope& scope, ExpectedLatency& latency) {
  for (const Template& node : fields.words("nodes")) {
    const std::string name = node.perform(scope);
    latency.nodes.push_back(name.starts_with("/") || name.starts_with("*") ? name : "/" + name);
  }
  if (latency.nodes.size() < 2) {
    throw LaunchError("a chain needs two nodes at least", fields.where("nodes"));
  }
}

void finish_latency(const Fields& fields, LaunchContext&, ExpectedLatency& latency) {
  // The analysis keeps these shares of the times of chains.
  constexpr std::array kKept = {50.0, 90.0, 99.0, 99.9, 99.99, 100.0};
  if (fields.has("nodes") && std::find(kKept.begin(), kKept.end(), latency.time.percentile) == kKept.end()) {
    throw LaunchError(fmt::format("the percentile of a chain can be 50, 90, 99, 99.9, 99.99 or 100, got {:g}",
                                  latency.time.percentile),
                      fields.where());
  }
}

ExpectationType latency_type() {
  return expectation_of<ExpectedLatency>(
      "latency", "how long a message takes from publish to its callback, or a chain of callbacks",
      with_bounds<ExpectedLatency>(
          {name_row("topic", false, "the topic of the messages", &ExpectedLatency::topic),
           name_row("from", false, "with topic: the node that publishes them", &ExpectedLatency::from),
           name_row("to", false, "with topic: the node that takes them", &ExpectedLatency::to),
           {.attribute = own_attribute("nodes", AttributeType::kWords, false, "none",
                                       "instead of a topic: the nodes that a chain passes, from the first to the last, "
                                       "as in <chain>"),
            .perform = perform_nodes},
           count_row("min", "1", "how many of them there are at least", &ExpectedLatency::least)}),
      check_latency, finish_latency);
}

ExpectationType callback_type() {
  return expectation_of<ExpectedCallback>(
      "callback", "how long callbacks take",
      with_bounds<ExpectedCallback>(
          {name_row("node", false, "their node", &ExpectedCallback::node),
           name_row("topic", false, "the topic of their subscription", &ExpectedCallback::topic),
           name_row("service", false, "their service", &ExpectedCallback::service),
           {.attribute = text_attribute("function", false, "a part of the name of their function"),
            .place = place_of(&ExpectedCallback::function)},
           count_row("min", "1", "how many runs there are at least", &ExpectedCallback::least)}),
      check_bounds);
}

ExpectationType timer_type() {
  return expectation_of<ExpectedTimer>(
      "timer_period", "how regularly a timer fires",
      {name_row("node", true, "its node", &ExpectedTimer::node),
       time_row(own_attribute("period_ms", AttributeType::kFloat, true, "", "its period in milliseconds"),
                &ExpectedTimer::period, kMillisecond),
       time_row(own_attribute("jitter_ms", AttributeType::kFloat, false, "any",
                              "milliseconds by which an interval may differ from the period"),
                &ExpectedTimer::jitter, kMillisecond),
       {.attribute = percentile_attribute(),
        .perform = [](const Fields& fields, Scope& scope,
                      ExpectedTimer& timer) { timer.percentile = perform_percentile(fields, scope); }},
       count_row("max_missed", "0", "how many periods may pass without a run", &ExpectedTimer::most_missed)});
}

const std::vector<std::string> kCountedStates = {"active", "unconfigured", "inactive", "finalized", "any"};

ExpectationType allocations_type() {
  return expectation_of<ExpectedAllocations>(
      "allocations", "how often the callbacks of a node ask for memory (malloc and the like)",
      {name_row("node", true, "the node", &ExpectedAllocations::node),
       {.attribute = own_attribute(
            "state", AttributeType::kLiteral, false, "active",
            "only while its life cycle is in this state: active, inactive, unconfigured, finalized; any: also "
            "of a node without a life cycle")},
       count_row("max", "0", "how often at most", &ExpectedAllocations::most)},
      [](const Fields& fields) { choice(fields, "state", kCountedStates); },
      [](const Fields& fields, LaunchContext&, ExpectedAllocations& allocations) {
        const std::string& state = kCountedStates[choice(fields, "state", kCountedStates)];
        allocations.state = state == "any" ? "" : state;
      });
}

}  // namespace

std::vector<ExpectationType> trace_expectation_types() {
  return {event_type(),    order_type(), delivery_type(),   latency_type(),
          callback_type(), timer_type(), allocations_type()};
}

}  // namespace launch
