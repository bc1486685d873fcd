// SPDX-License-Identifier: Apache-2.0
// The items of <test> that say what the trace of its run holds: <event>, <events_in_order>, <delivery>, <latency>,
// <callback>, <timer_period>, <allocations>.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "actions/test/expectation_fields.hpp"
#include "actions/test/expectations.hpp"
#include "actions/values/ros_condition.hpp"
#include "actions/values/ros_names.hpp"
#include "tracing/record/plan/ros_events.hpp"

namespace launch {

namespace {

constexpr double kAll = 100;

std::uint64_t perform_count(const std::optional<NumberField>& number, Scope& scope, std::uint64_t otherwise) {
  return number ? static_cast<std::uint64_t>(number->perform(scope)) : otherwise;
}

std::string perform_name(const std::optional<Template>& name, Scope& scope) {
  return name ? resolve_name(*name, scope) : std::string();
}

std::string perform_text(const std::optional<Template>& text, Scope& scope) {
  return text ? text->perform(scope) : std::string();
}

std::optional<TimeField> milliseconds(const Fields& fields, const char* attribute) {
  return TimeField::of(fields, attribute, TimeField::kMillisecond);
}

std::optional<Duration> perform_time(const std::optional<TimeField>& time, Scope& scope) {
  return time ? std::optional(time->perform(scope)) : std::nullopt;
}

double perform_percentile(const std::optional<NumberField>& number, const SourceRange& where, Scope& scope) {
  const double percentile = number ? number->perform(scope) : kAll;
  if (!(percentile > 0 && percentile <= kAll)) {
    throw LaunchError(fmt::format("percentile is a number above 0, and 100 at most, got {:g}", percentile), where);
  }
  return percentile;
}

AttributeSpec percentile_attribute() {
  return own_attribute("percentile", AttributeType::kFloat, false, "100", "how many of a hundred must be within it");
}

// min_ms, max_ms, percentile
class Bounds {
 public:
  explicit Bounds(const Fields& fields)
      : least_(milliseconds(fields, "min_ms")),
        most_(milliseconds(fields, "max_ms")),
        percentile_(fields.number("percentile")),
        percentile_where_(fields.where("percentile")) {
    if (!least_ && !most_) {
      throw LaunchError("there is no bound", fields.where(), "give max_ms, milliseconds", Finding::kMissingAttribute);
    }
  }

  static std::vector<AttributeSpec> attributes() {
    return {own_attribute("min_ms", AttributeType::kFloat, false, "0", "milliseconds that it takes at least"),
            own_attribute("max_ms", AttributeType::kFloat, false, "none", "milliseconds that it takes at most"),
            percentile_attribute()};
  }

  TimeBounds perform(Scope& scope) const {
    const TimeBounds bounds{perform_time(least_, scope).value_or(Duration(0)), perform_time(most_, scope),
                            perform_percentile(percentile_, percentile_where_, scope)};
    if (bounds.most && *bounds.most < bounds.least) {
      throw LaunchError(fmt::format("max_ms is less than min_ms, {:g}",
                                    std::chrono::duration<double, std::milli>(bounds.least).count()),
                        most_->where(), {}, Finding::kWrongValue);
    }
    return bounds;
  }

 private:
  std::optional<TimeField> least_;
  std::optional<TimeField> most_;
  std::optional<NumberField> percentile_;
  SourceRange percentile_where_;
};

// name, where
class EventFields {
 public:
  explicit EventFields(const Fields& fields)
      : where_(fields.where()), name_(fields.text("name")), condition_(fields.optional_text("where")) {}

  ExpectedEvent perform(Scope& scope) const {
    ExpectedEvent event;
    event.name = name_.perform(scope);
    event.name_where = name_.where();
    if (const std::string reason = tracing::why_no_ros_event(event.name); !reason.empty()) {
      throw LaunchError(reason, name_.where());
    }
    event.condition = perform_text(condition_, scope);
    event.condition_where = condition_ ? condition_->where() : where_;
    return event;
  }

 private:
  SourceRange where_;
  Template name_;
  std::optional<Template> condition_;
};

PerformExpectation event_expectation(const Fields& fields) {
  const ExpectationSubject subject(fields);
  const EventFields meant(fields);
  const std::optional<NumberField> least = from_zero(fields, "min");
  const std::optional<NumberField> most = from_zero(fields, "max");
  return [=](LaunchContext& context) {
    Scope& scope = context.scope();
    ExpectedEvent event = meant.perform(scope);
    event.least = perform_count(least, scope, most ? 0 : 1);
    if (most) {
      event.most = perform_count(most, scope, 0);
    }
    return subject.of(TraceExpectation(event), scope);
  };
}

PerformExpectation order_expectation(const Fields& fields) {
  struct Step {
    EventFields event;
    std::optional<Template> process;
  };
  const ExpectationSubject subject(fields);
  std::vector<Step> steps;
  for (const Fields* const item : fields.items("event")) {
    steps.push_back({EventFields(*item), item->optional_text("process")});
  }
  if (steps.size() < 2) {
    throw LaunchError("an order needs two events at least", fields.where(), "give each one: <event name=\"…\"/>",
                      Finding::kMissingAttribute);
  }
  return [=](LaunchContext& context) {
    Scope& scope = context.scope();
    ExpectedEventOrder order;
    for (const Step& step : steps) {
      order.steps.push_back({step.event.perform(scope), perform_text(step.process, scope),
                             step.process ? step.process->where() : SourceRange()});
    }
    return subject.of(TraceExpectation(std::move(order)), scope);
  };
}

PerformExpectation allocations_expectation(const Fields& fields) {
  const ExpectationSubject subject(fields);
  const Template& node = fields.text("node");
  const std::vector<std::string> states = {"active", "unconfigured", "inactive", "finalized", "any"};
  const std::string state = states[choice(fields, "state", states)];
  const std::optional<NumberField> most = from_zero(fields, "max");
  return [=](LaunchContext& context) {
    Scope& scope = context.scope();
    return subject.of(TraceExpectation(ExpectedAllocations{resolve_name(node, scope), state == "any" ? "" : state,
                                                           perform_count(most, scope, 0)}),
                      scope);
  };
}

PerformExpectation delivery_expectation(const Fields& fields) {
  const ExpectationSubject subject(fields);
  const Template& topic = fields.text("topic");
  const std::optional<Template> from = fields.optional_text("from");
  const std::optional<Template> to = fields.optional_text("to");
  const std::optional<NumberField> least = from_zero(fields, "min");
  const std::optional<NumberField> lost = from_zero(fields, "max_lost");
  return [=](LaunchContext& context) {
    Scope& scope = context.scope();
    return subject.of(TraceExpectation(ExpectedDelivery{resolve_name(topic, scope), perform_name(from, scope),
                                                        perform_name(to, scope), perform_count(least, scope, 1),
                                                        perform_count(lost, scope, 0)}),
                      scope);
  };
}

PerformExpectation latency_expectation(const Fields& fields) {
  const ExpectationSubject subject(fields);
  const std::optional<Template> topic = fields.optional_text("topic");
  const std::optional<Template> from = fields.optional_text("from");
  const std::optional<Template> to = fields.optional_text("to");
  const std::optional<std::vector<Template>> nodes = fields.optional_words("nodes");
  if (topic.has_value() == nodes.has_value()) {
    throw LaunchError(topic ? "either a topic or nodes" : "neither a topic nor nodes", fields.where(),
                      "topic=\"…\" is the way of a message, nodes=\"/a /b /c\" a chain of callbacks",
                      Finding::kExclusive);
  }
  if (nodes && (from || to)) {
    throw LaunchError("from and to go with a topic only", fields.where(from ? "from" : "to"), {}, Finding::kExclusive);
  }
  const std::optional<NumberField> least = from_zero(fields, "min");
  const Bounds bounds(fields);
  const SourceRange& nodes_where = fields.where("nodes");
  return [=](LaunchContext& context) {
    Scope& scope = context.scope();
    ExpectedLatency latency{perform_name(topic, scope),     perform_name(from, scope), perform_name(to, scope), {},
                            perform_count(least, scope, 1), bounds.perform(scope)};
    for (const Template& node : nodes.value_or(std::vector<Template>())) {
      const std::string name = node.perform(scope);
      latency.nodes.push_back(name.starts_with("/") || name.starts_with("*") ? name : "/" + name);
    }
    if (nodes && latency.nodes.size() < 2) {
      throw LaunchError("a chain needs two nodes at least", nodes_where);
    }
    // The analysis keeps these shares of the times of chains.
    constexpr std::array kKept = {50.0, 90.0, 99.0, 99.9, 99.99, 100.0};
    if (nodes && std::find(kKept.begin(), kKept.end(), latency.time.percentile) == kKept.end()) {
      throw LaunchError(fmt::format("the percentile of a chain can be 50, 90, 99, 99.9, 99.99 or 100, got {:g}",
                                    latency.time.percentile),
                        subject.where());
    }
    return subject.of(TraceExpectation(std::move(latency)), scope);
  };
}

PerformExpectation callback_expectation(const Fields& fields) {
  const ExpectationSubject subject(fields);
  const std::optional<Template> node = fields.optional_text("node");
  const std::optional<Template> topic = fields.optional_text("topic");
  const std::optional<Template> service = fields.optional_text("service");
  const std::optional<Template> function = fields.optional_text("function");
  const std::optional<NumberField> least = from_zero(fields, "min");
  const Bounds bounds(fields);
  return [=](LaunchContext& context) {
    Scope& scope = context.scope();
    return subject.of(TraceExpectation(ExpectedCallback{perform_name(node, scope), perform_name(topic, scope),
                                                        perform_name(service, scope), perform_text(function, scope),
                                                        perform_count(least, scope, 1), bounds.perform(scope)}),
                      scope);
  };
}

PerformExpectation timer_expectation(const Fields& fields) {
  const ExpectationSubject subject(fields);
  const Template& node = fields.text("node");
  const TimeField period = *milliseconds(fields, "period_ms");
  const std::optional<TimeField> jitter = milliseconds(fields, "jitter_ms");
  const std::optional<NumberField> percentile = fields.number("percentile");
  const SourceRange& percentile_where = fields.where("percentile");
  const std::optional<NumberField> missed = from_zero(fields, "max_missed");
  return [=](LaunchContext& context) {
    Scope& scope = context.scope();
    return subject.of(TraceExpectation(ExpectedTimer{
                          resolve_name(node, scope), period.perform(scope), perform_time(jitter, scope),
                          perform_percentile(percentile, percentile_where, scope), perform_count(missed, scope, 0)}),
                      scope);
  };
}

AttributeSpec text_attribute(const char* name, bool required, const char* help) {
  return own_attribute(name, AttributeType::kText, required, required ? "" : "any", help);
}

AttributeSpec least_attribute(const char* what) {
  return own_attribute("min", AttributeType::kInteger, false, "1", fmt::format("how many {} there are at least", what));
}

ItemSpec with_bounds(ItemSpec item) {
  for (AttributeSpec& attribute : Bounds::attributes()) {
    item.attributes.push_back(std::move(attribute));
  }
  return item;
}

ItemSpec event_item() {
  return expectation_item(
      "event", "events that the trace of the test holds",
      {text_attribute("name", true, "the event, or a pattern: ros2:rcl_publisher_init, ros2:rcl_*"),
       own_attribute("where", AttributeType::kText, false, "none",
                     "a condition on its fields, as `launch trace read --where` has it"),
       process_attribute(false),
       own_attribute("min", AttributeType::kInteger, false, "1; with max: 0", "how many there are at least"),
       own_attribute("max", AttributeType::kInteger, false, "any number", "how many there are at most")});
}

ItemSpec order_item() {
  ItemSpec spec = expectation_item(
      "events_in_order", "events of the trace that come one after the other, with any others between them", {});
  spec.items = {
      {.tag = "event",
       .help = "the next event",
       .attributes = {text_attribute("name", true, "the event, or a pattern"),
                      own_attribute("where", AttributeType::kText, false, "none", "a condition on its fields"),
                      process_attribute(false)},
       .extension = true}};
  return spec;
}

ItemSpec allocations_item() {
  return expectation_item(
      "allocations", "how often the callbacks of a node ask for memory (malloc and the like)",
      {text_attribute("node", true, "the node"),
       own_attribute("state", AttributeType::kLiteral, false, "active",
                     "only while its life cycle is in this state: active, inactive, unconfigured, finalized; any: also "
                     "of a node without a life cycle"),
       own_attribute("max", AttributeType::kInteger, false, "0", "how often at most")});
}

ItemSpec delivery_item() {
  return expectation_item(
      "delivery", "messages that reach a callback",
      {text_attribute("topic", true, "their topic"), text_attribute("from", false, "the node that publishes them"),
       text_attribute("to", false, "the node that takes them"), least_attribute("messages"),
       own_attribute("max_lost", AttributeType::kInteger, false, "0",
                     "how many do not, of those after the first that does")});
}

ItemSpec latency_item() {
  return with_bounds(expectation_item(
      "latency", "how long a message takes from publish to its callback, or a chain of callbacks",
      {text_attribute("topic", false, "the topic of the messages"),
       text_attribute("from", false, "with topic: the node that publishes them"),
       text_attribute("to", false, "with topic: the node that takes them"),
       own_attribute("nodes", AttributeType::kWords, false, "none",
                     "instead of a topic: the nodes that a chain passes, from the first to the last, as in <chain>"),
       least_attribute("of them")}));
}

ItemSpec callback_item() {
  return with_bounds(expectation_item(
      "callback", "how long callbacks take",
      {text_attribute("node", false, "their node"), text_attribute("topic", false, "the topic of their subscription"),
       text_attribute("service", false, "their service"),
       text_attribute("function", false, "a part of the name of their function"), least_attribute("runs")}));
}

ItemSpec timer_item() {
  return expectation_item(
      "timer_period", "how regularly a timer fires",
      {text_attribute("node", true, "its node"),
       own_attribute("period_ms", AttributeType::kFloat, true, "", "its period in milliseconds"),
       own_attribute("jitter_ms", AttributeType::kFloat, false, "any",
                     "milliseconds by which an interval may differ from the period"),
       percentile_attribute(),
       own_attribute("max_missed", AttributeType::kInteger, false, "0", "how many periods may pass without a run")});
}

}  // namespace

std::vector<ExpectationType> trace_expectation_types() {
  return {{event_item(), event_expectation},
          {order_item(), order_expectation},
          {delivery_item(), delivery_expectation},
          {latency_item(), latency_expectation},
          {callback_item(), callback_expectation},
          {timer_item(), timer_expectation},
          {allocations_item(), allocations_expectation}};
}

}  // namespace launch
