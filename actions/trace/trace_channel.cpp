// SPDX-License-Identifier: Apache-2.0
#include "actions/trace/trace_channel.hpp"

#include <algorithm>
#include <iterator>
#include <limits>
#include <sstream>

#include "base/diagnostics/diagnostic.hpp"
#include "tracing/record/plan/event_rule.hpp"
#include "tracing/record/plan/trace_error.hpp"

namespace launch {

namespace {

std::vector<std::string> at_blanks(const std::string& text) {
  std::istringstream words(text);
  return {std::istream_iterator<std::string>(words), std::istream_iterator<std::string>()};
}

// Whether the text is a name, and not a word of a rule that was written wrongly.
bool is_name(const std::string& text, Tracepoints of) {
  return of == Tracepoints::kUserspace ? text.find(':') != std::string::npos
                                       : text != "if" && text != "except" && text != "level";
}

}  // namespace

WordsField::WordsField(const Fields& fields, std::string_view attribute)
    : words_(fields.optional_words(attribute)), where_(fields.where(attribute)) {}

std::vector<std::string> WordsField::performed_words(Scope& scope) const {
  std::vector<std::string> performed;
  for (const Template& word : words_.value_or(std::vector<Template>())) {
    if (std::string text = word.perform(scope); !text.empty()) {
      performed.push_back(std::move(text));
    }
  }
  return performed;
}

std::vector<std::string> WordsField::perform(Scope& scope) const {
  std::vector<std::string> names;
  for (const std::string& word : performed_words(scope)) {
    const std::vector<std::string> parts = at_blanks(word);
    names.insert(names.end(), parts.begin(), parts.end());
  }
  return names;
}

std::vector<std::string> WordsField::perform_events(Scope& scope, Tracepoints of) const {
  std::vector<std::string> events;
  for (const std::string& word : performed_words(scope)) {
    try {
      tracing::parse_event_rule(word);
      events.push_back(word);
    } catch (const tracing::TraceError& error) {
      const std::vector<std::string> parts = at_blanks(word);
      if (parts.size() < 2 ||
          !std::all_of(parts.begin(), parts.end(), [of](const std::string& part) { return is_name(part, of); })) {
        throw LaunchError(error.what(), where_, error.remedy());
      }
      events.insert(events.end(), parts.begin(), parts.end());
    }
  }
  return events;
}

std::optional<NumberField> count_field(const Fields& fields, std::string_view attribute) {
  std::optional<NumberField> field = fields.number(attribute);
  if (field) {
    field->require_not_negative();
  }
  return field;
}

std::uint64_t count(const NumberField& field, Scope& scope) {
  return static_cast<std::uint64_t>(field.perform(scope));
}

std::uint32_t microseconds(const NumberField& field, Scope& scope) {
  return static_cast<std::uint32_t>(std::min<double>(field.perform(scope), std::numeric_limits<std::uint32_t>::max()));
}

ItemSpec ChannelFields::item() {
  const auto number = [](const char* name, const char* help) {
    return AttributeSpec{name, AttributeType::kInteger, false, "as the domain's own channel", help};
  };
  return {.tag = "channel",
          .help = "a further channel of one domain, whose events have buffers of their own",
          .attributes = {{"name", AttributeType::kText, true, "", "its name"},
                         {"events-ust", AttributeType::kWords, false, "none", "userspace events"},
                         {"events-kernel", AttributeType::kWords, false, "none", "kernel tracepoints"},
                         {"syscalls", AttributeType::kWords, false, "none", "system calls"},
                         {"context-fields", AttributeType::kWords, false, "those of the trace", ""},
                         number("subbuffer-size", "bytes"),
                         number("subbuffer-count", "sub-buffers for each processor"),
                         number("read-timer", "microseconds between two reads of the buffers"),
                         number("switch-timer", "microseconds until a part-full sub-buffer is written; 0: never"),
                         {"overwrite", AttributeType::kBoolean, false, "as the domain's own channel",
                          "lose the oldest events, not the newest"},
                         {"blocking-timeout", AttributeType::kInteger, false, "0",
                          "microseconds that a traced thread waits for room; -1: for ever"}},
          .items = {},
          .extension = true};
}

ChannelFields::ChannelFields(const Fields& fields)
    : name_(fields.text("name")),
      events_ust_(fields, "events-ust"),
      events_kernel_(fields, "events-kernel"),
      syscalls_(fields, "syscalls"),
      context_fields_(fields, "context-fields"),
      subbuffer_size_(count_field(fields, "subbuffer-size")),
      subbuffer_count_(count_field(fields, "subbuffer-count")),
      read_timer_(count_field(fields, "read-timer")),
      switch_timer_(count_field(fields, "switch-timer")),
      blocking_timeout_(fields.number("blocking-timeout")) {
  if (fields.has("overwrite")) {
    overwrite_ = fields.boolean("overwrite", false);
  }
}

tracing::ChannelConfig ChannelFields::perform(Scope& scope) const {
  tracing::ChannelConfig config;
  config.name = name_.perform(scope);
  config.events_ust = events_ust_.perform_events(scope, Tracepoints::kUserspace);
  config.events_kernel = events_kernel_.perform_events(scope, Tracepoints::kKernel);
  config.syscalls = syscalls_.perform(scope);
  if (context_fields_.given()) {
    config.context_fields = context_fields_.perform(scope);
  }
  if (subbuffer_size_) {
    config.subbuffer_size = count(*subbuffer_size_, scope);
  }
  if (subbuffer_count_) {
    config.subbuffer_count = count(*subbuffer_count_, scope);
  }
  if (read_timer_) {
    config.read_timer = microseconds(*read_timer_, scope);
  }
  if (switch_timer_) {
    config.switch_timer = microseconds(*switch_timer_, scope);
  }
  if (overwrite_) {
    config.overwrite = overwrite_->perform(scope);
  }
  if (blocking_timeout_) {
    config.blocking_timeout = static_cast<std::int64_t>(blocking_timeout_->perform(scope));
  }
  return config;
}

}  // namespace launch
