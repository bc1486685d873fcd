// SPDX-License-Identifier: Apache-2.0
// <exit>, <output>, <in_order>, <graph>, <resources>, and the list of all items that say what must happen.
#include "actions/test/expectations.hpp"

#include <fmt/format.h>

#include <optional>
#include <utility>

#include "actions/process/resource_settings.hpp"
#include "actions/values/ros_condition.hpp"

namespace launch {

namespace {

bool is_after_shutdown(const Fields& fields) {
  return choice(fields, "when", {"running", "shutdown"}) == 1;
}

ExpectationType exit_type() {
  return expectation_of<ExpectedExit>(
      "exit", "how a process ends",
      {{.attribute = process_attribute(true)},
       {.attribute = own_attribute("code", AttributeType::kText, false, "0",
                                   "any, nonzero, or codes and signals separated by commas"),
        .perform =
            [](const Fields& fields, Scope& scope, ExpectedExit& exit) {
              exit.code = ExitCodeFilter(fields.text("code").perform(scope), fields.text("code").where());
            }},
       {.attribute = own_attribute("when", AttributeType::kLiteral, false, "running",
                                   "running: it ends by itself, and the test goes on until then; shutdown: the end of "
                                   "the test ends it"),
        .perform = [](const Fields& fields, Scope&,
                      ExpectedExit& exit) { exit.after_shutdown = is_after_shutdown(fields); },
        .checks_literal = true},
       {.attribute = within_attribute()}},
      nullptr, [](const Fields& fields, LaunchContext&, ExpectedExit& exit) {
        if (!fields.has("code")) {
          exit.code = ExitCodeFilter("0", SourceRange());
        }
      });
}

// The attributes text, pattern and stream of a line, which are read together.
std::vector<AttributeSpec> line_attributes() {
  return {
      own_attribute("text", AttributeType::kText, false, "any line", "a part of the line, as it stands"),
      own_attribute("pattern", AttributeType::kText, false, "any line", "regular expression to be found in the line"),
      own_attribute("stream", AttributeType::kText, false, "both", "stdout, stderr or both")};
}

ExpectedLine perform_line(const Fields& fields, Scope& scope) {
  return {perform_output_pattern(fields, scope), fields.has("text") ? fields.text("text").perform(scope) : ""};
}

void check_output(const Fields& fields) {
  if (is_after_shutdown(fields) && fields.has("within")) {
    throw LaunchError("within counts from the begin of the test: it goes without when=\"shutdown\"",
                      fields.where("within"), {}, Finding::kExclusive);
  }
  if (fields.has("absent") && (fields.has("min") || fields.has("max"))) {
    throw LaunchError("absent means max=\"0\": it goes without min and max", fields.where("absent"), {},
                      Finding::kExclusive);
  }
}

void finish_output(const Fields& fields, LaunchContext& context, ExpectedOutput& output) {
  output.line = perform_line(fields, context.scope());
  if (output.most && !fields.has("min")) {
    output.least = 0;
  }
  if (fields.boolean("absent", false).perform(context.scope())) {
    output.least = 0;
    output.most = 0;
  }
  if (output.most && *output.most < output.least) {
    throw LaunchError(fmt::format("max is less than min, {}", output.least), fields.where("max"));
  }
  output.after_shutdown = is_after_shutdown(fields);
}

ExpectationType output_type() {
  Rows<ExpectedOutput> rows = {{.attribute = process_attribute(false)}};
  for (AttributeSpec& attribute : line_attributes()) {
    rows.push_back({.attribute = std::move(attribute)});
  }
  rows.push_back(count_row("min", "1; with max: 0", "how many such lines there are at least", &ExpectedOutput::least));
  rows.push_back(count_row("max", "any number", "how many there are at most", &ExpectedOutput::most));
  rows.push_back(
      {.attribute = own_attribute("absent", AttributeType::kBoolean, false, "false", "true: there is no such line")});
  rows.push_back({.attribute = own_attribute("when", AttributeType::kLiteral, false, "running",
                                             "running: from the begin on; shutdown: only lines after the begin of the "
                                             "shutdown, for which the test does not wait")});
  rows.push_back({.attribute = within_attribute()});
  return expectation_of<ExpectedOutput>("output", "a line that a process writes", std::move(rows), check_output,
                                        finish_output);
}

ExpectationType in_order_type() {
  ExpectationType type = expectation_of<ExpectedSequence>(
      "in_order", "lines that come one after the other, with any others between them",
      {{.attribute = process_attribute(false)}, {.attribute = within_attribute()}},
      [](const Fields& fields) {
        if (fields.items("line").empty()) {
          throw LaunchError("there are no lines to be in order", fields.where(),
                            "give the first one: <line text=\"…\"/>", Finding::kMissingAttribute);
        }
      },
      [](const Fields& fields, LaunchContext& context, ExpectedSequence& sequence) {
        for (const Fields* const line : fields.items("line")) {
          sequence.lines.push_back(perform_line(*line, context.scope()));
        }
      });
  type.item.items = {{.tag = "line", .help = "the next line", .attributes = line_attributes(), .extension = true}};
  return type;
}

ExpectationType graph_type() {
  Rows<ExpectedGraph> rows;
  for (AttributeSpec& attribute : ros_condition_attributes()) {
    rows.push_back({.attribute = std::move(attribute)});
  }
  rows.push_back({.attribute = own_attribute("condition", AttributeType::kLiteral, false, "present",
                                             "with topic: present (it has a publisher) or message (a message has "
                                             "arrived)")});
  rows.push_back({.attribute = own_attribute("absent", AttributeType::kBoolean, false, "false",
                                             "true: that never happens during the test"),
                  .place = place_of(&ExpectedGraph::absent)});
  rows.push_back({.attribute = within_attribute()});
  return expectation_of<ExpectedGraph>(
      "graph", "a node, a topic, a service or a parameter that the ROS graph shows", std::move(rows),
      [](const Fields& fields) { check_ros_condition(fields, ros_subject_of(fields)); },
      [](const Fields& fields, LaunchContext& context, ExpectedGraph& graph) {
        graph.condition = perform_ros_condition(fields, ros_subject_of(fields), context);
      });
}

ExpectationType resources_type() {
  return expectation_of<ExpectedResources>(
      "resources", "what a process uses at most, from its begin to its end, with the children that it waits for",
      {{.attribute = process_attribute(false)},
       {.attribute =
            own_attribute("max_memory", AttributeType::kText, false, "none", "memory in bytes, or with K, M or G"),
        .perform =
            [](const Fields& fields, Scope& scope, ExpectedResources& resources) {
              const Template& text = fields.text("max_memory");
              resources.memory = parse_bytes(text.perform(scope), text.where());
            }},
       time_row(own_attribute("max_processor_time", AttributeType::kFloat, false, "none",
                              "seconds of all processors together"),
                &ExpectedResources::processor_time)},
      [](const Fields& fields) {
        if (!fields.has("max_memory") && !fields.has("max_processor_time")) {
          throw LaunchError("there is no ceiling", fields.where(), "give max_memory, max_processor_time or both",
                            Finding::kMissingAttribute);
        }
      });
}

}  // namespace

const std::vector<ExpectationType>& expectation_types() {
  static const std::vector<ExpectationType> types = [] {
    std::vector<ExpectationType> all = {
        exit_type(), output_type(), in_order_type(), graph_type(), message_expectation_type(), resources_type()};
    for (ExpectationType& type : trace_expectation_types()) {
      all.push_back(std::move(type));
    }
    return all;
  }();
  return types;
}

AttributeSpec own_attribute(std::string name, AttributeType type, bool required, std::string fallback,
                            std::string help) {
  return {std::move(name), type, required, std::move(fallback), std::move(help), true};
}

AttributeSpec process_attribute(bool required) {
  return own_attribute("process", AttributeType::kText, required, required ? "" : "every process",
                       "a process, by its name or that of its node");
}

AttributeSpec within_attribute(std::string help) {
  return own_attribute("within", AttributeType::kFloat, false, "none", std::move(help));
}

ItemSpec expectation_item(std::string tag, std::string help, std::vector<AttributeSpec> attributes) {
  return {.tag = std::move(tag),
          .help = std::move(help),
          .attributes = std::move(attributes),
          .has_condition = true,
          .extension = true};
}

Duration perform_time(const Fields& fields, const std::string& attribute, Scope& scope, double unit) {
  constexpr double kMost = 1e9;
  NumberField number = *fields.number(attribute);
  number.require_not_negative();
  const double seconds = number.perform(scope) * unit;
  if (!(seconds <= kMost)) {
    throw LaunchError(fmt::format("a time of {:g} s is too long", seconds), fields.where(attribute),
                      "a billion seconds at most", Finding::kWrongValue);
  }
  return as_duration(seconds);
}

void check_subject(const Fields& fields) {
  if (std::optional<NumberField> within = fields.number("within")) {
    within->require_not_negative();
  }
}

Expectation perform_subject(const Fields& fields, Scope& scope) {
  Expectation expectation;
  expectation.where = fields.where();
  expectation.process_where = fields.where();
  if (fields.has("process")) {
    expectation.process = fields.text("process").perform(scope);
    expectation.process_where = fields.text("process").where();
  }
  if (fields.has("within")) {
    expectation.within = perform_time(fields, "within", scope, kSecond);
  }
  return expectation;
}

}  // namespace launch
