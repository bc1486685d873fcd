// SPDX-License-Identifier: Apache-2.0
// <exit>, <output>, <in_order>, <graph>, <resources>, and the list of all.
#include "actions/test/expectations.hpp"

#include <fmt/format.h>

#include <chrono>
#include <optional>
#include <utility>

#include "actions/process/resource_settings.hpp"
#include "actions/test/expectation_fields.hpp"
#include "actions/values/ros_condition.hpp"

namespace launch {

namespace {

AttributeSpec within_attribute() {
  return own_attribute("within", AttributeType::kFloat, false, "none", "seconds from the begin of the test");
}

std::vector<AttributeSpec> line_attributes() {
  return {
      own_attribute("text", AttributeType::kText, false, "any line", "a part of the line, as it stands"),
      own_attribute("pattern", AttributeType::kText, false, "any line", "regular expression to be found in the line"),
      own_attribute("stream", AttributeType::kText, false, "both", "stdout, stderr or both")};
}

ExpectedLine perform_line(const Fields& fields, Scope& scope) {
  const auto text = [&](const char* attribute, const char* otherwise) {
    return fields.has(attribute) ? fields.text(attribute).perform(scope) : std::string(otherwise);
  };
  return {OutputPattern(text("pattern", ""), fields.where("pattern"), text("stream", "both"), fields.where("stream")),
          text("text", "")};
}

PerformExpectation exit_expectation(const Fields& fields) {
  const ExpectationSubject subject(fields);
  const std::optional<Template> code = fields.optional_text("code");
  const bool after_shutdown = choice(fields, "when", {"running", "shutdown"}) == 1;
  return [=](LaunchContext& context) {
    Scope& scope = context.scope();
    const ExitCodeFilter filter =
        code ? ExitCodeFilter(code->perform(scope), code->where()) : ExitCodeFilter("0", SourceRange());
    return subject.of(ExpectedExit{filter, after_shutdown}, scope);
  };
}

PerformExpectation output_expectation(const Fields& fields) {
  const ExpectationSubject subject(fields);
  const std::optional<NumberField> least = from_zero(fields, "min");
  const std::optional<NumberField> most = from_zero(fields, "max");
  const BooleanField absent = fields.boolean("absent", false);
  const bool after_shutdown = choice(fields, "when", {"running", "shutdown"}) == 1;
  if (after_shutdown && fields.has("within")) {
    throw LaunchError("within counts from the begin of the test: it goes without when=\"shutdown\"",
                      fields.where("within"), {}, Finding::kExclusive);
  }
  if (fields.has("absent") && (least || most)) {
    throw LaunchError("absent means max=\"0\": it goes without min and max", fields.where("absent"), {},
                      Finding::kExclusive);
  }
  return [=](LaunchContext& context) {
    Scope& scope = context.scope();
    ExpectedOutput expected{perform_line(fields, scope), 1, std::nullopt, after_shutdown};
    if (most) {
      expected.most = static_cast<std::uint64_t>(most->perform(scope));
      expected.least = 0;
    }
    if (least) {
      expected.least = static_cast<std::uint64_t>(least->perform(scope));
    }
    if (absent.perform(scope)) {
      expected.least = 0;
      expected.most = 0;
    }
    if (expected.most && *expected.most < expected.least) {
      throw LaunchError(fmt::format("max is less than min, {}", expected.least), fields.where("max"));
    }
    return subject.of(std::move(expected), scope);
  };
}

PerformExpectation in_order_expectation(const Fields& fields) {
  const ExpectationSubject subject(fields);
  if (fields.items("line").empty()) {
    throw LaunchError("there are no lines to be in order", fields.where(), "give the first one: <line text=\"…\"/>",
                      Finding::kMissingAttribute);
  }
  return [=](LaunchContext& context) {
    ExpectedSequence sequence;
    for (const Fields* const line : fields.items("line")) {
      sequence.lines.push_back(perform_line(*line, context.scope()));
    }
    return subject.of(std::move(sequence), context.scope());
  };
}

PerformExpectation graph_expectation(const Fields& fields) {
  const ExpectationSubject subject(fields);
  const RosCondition condition(fields, RosCondition::subject_of(fields, {}));
  const BooleanField absent = fields.boolean("absent", false);
  return [=](LaunchContext& context) {
    const bool is_absent = absent.perform(context.scope());
    return subject.of(ExpectedGraph{condition.perform(context), is_absent}, context.scope());
  };
}

PerformExpectation resources_expectation(const Fields& fields) {
  const ExpectationSubject subject(fields);
  const std::optional<Template> memory = fields.optional_text("max_memory");
  const std::optional<TimeField> time = TimeField::of(fields, "max_processor_time");
  if (!memory && !time) {
    throw LaunchError("there is no ceiling", fields.where(), "give max_memory, max_processor_time or both",
                      Finding::kMissingAttribute);
  }
  return [=](LaunchContext& context) {
    Scope& scope = context.scope();
    ExpectedResources expected;
    if (memory) {
      expected.memory = parse_bytes(memory->perform(scope), memory->where());
    }
    if (time) {
      expected.processor_time = time->perform(scope);
    }
    return subject.of(expected, scope);
  };
}

ItemSpec exit_item() {
  return expectation_item(
      "exit", "how a process ends",
      {process_attribute(true),
       own_attribute("code", AttributeType::kText, false, "0",
                     "any, nonzero, or codes and signals separated by commas"),
       own_attribute("when", AttributeType::kLiteral, false, "running",
                     "running: it ends by itself, and the test goes on until then; shutdown: the end of the test "
                     "ends it"),
       within_attribute()});
}

ItemSpec output_item() {
  std::vector<AttributeSpec> attributes = {process_attribute(false)};
  for (AttributeSpec& attribute : line_attributes()) {
    attributes.push_back(std::move(attribute));
  }
  attributes.push_back(
      own_attribute("min", AttributeType::kInteger, false, "1; with max: 0", "how many such lines there are at least"));
  attributes.push_back(
      own_attribute("max", AttributeType::kInteger, false, "any number", "how many there are at most"));
  attributes.push_back(own_attribute("absent", AttributeType::kBoolean, false, "false", "true: there is no such line"));
  attributes.push_back(own_attribute("when", AttributeType::kLiteral, false, "running",
                                     "running: from the begin on; shutdown: only lines after the begin of the "
                                     "shutdown, for which the test does not wait"));
  attributes.push_back(within_attribute());
  return expectation_item("output", "a line that a process writes", std::move(attributes));
}

ItemSpec in_order_item() {
  ItemSpec spec = expectation_item("in_order", "lines that come one after the other, with any others between them",
                                   {process_attribute(false), within_attribute()});
  spec.items = {{.tag = "line", .help = "the next line", .attributes = line_attributes(), .extension = true}};
  return spec;
}

ItemSpec graph_item() {
  std::vector<AttributeSpec> attributes = RosCondition::attributes();
  attributes.push_back(own_attribute("condition", AttributeType::kLiteral, false, "present",
                                     "with topic: present (it has a publisher) or message (a message has arrived)"));
  attributes.push_back(
      own_attribute("absent", AttributeType::kBoolean, false, "false", "true: that never happens during the test"));
  attributes.push_back(within_attribute());
  return expectation_item("graph", "a node, a topic, a service or a parameter that the ROS graph shows",
                          std::move(attributes));
}

ItemSpec resources_item() {
  return expectation_item(
      "resources", "what a process uses at most, from its begin to its end, with the children that it waits for",
      {process_attribute(false),
       own_attribute("max_memory", AttributeType::kText, false, "none", "memory in bytes, or with K, M or G"),
       own_attribute("max_processor_time", AttributeType::kFloat, false, "none",
                     "seconds of all processors together")});
}

}  // namespace

const std::vector<ExpectationType>& expectation_types() {
  static const std::vector<ExpectationType> types = [] {
    std::vector<ExpectationType> all = {{exit_item(), exit_expectation},
                                        {output_item(), output_expectation},
                                        {in_order_item(), in_order_expectation},
                                        {graph_item(), graph_expectation},
                                        message_expectation_type(),
                                        {resources_item(), resources_expectation}};
    for (ExpectationType& type : trace_expectation_types()) {
      all.push_back(std::move(type));
    }
    return all;
  }();
  return types;
}

}  // namespace launch
