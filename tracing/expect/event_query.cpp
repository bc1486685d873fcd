// SPDX-License-Identifier: Apache-2.0
#include "launch_trace_testing/event_query.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <memory>
#include <utility>

#include "base/diagnostics/diagnostic.hpp"
#include "base/text/names.hpp"
#include "tracing/decode/reader/event_pattern.hpp"
#include "tracing/model/selection/event_condition.hpp"

namespace launch_trace_testing {

namespace {

constexpr double kOtherKind = 1e300;         // a field that is not there, or of another kind
constexpr double kCondition = 1;             // a condition that tells no distance
constexpr std::size_t kProcnameLength = 15;  // the kernel keeps no more

double text_distance(std::string_view a, std::string_view b) {
  return static_cast<double>(launch::edit_distance(a, b));
}

double distance_of(const Value& held, const Value& wanted) {
  if (const auto* const text = std::get_if<std::string>(&wanted.data)) {
    const auto has = held.text();
    return has ? text_distance(*has, *text) : kOtherKind;
  }
  const auto a = held.real();
  const auto b = wanted.real();
  if (!a || !b) {
    return to_string(held) == to_string(wanted) ? 0 : kOtherKind;
  }
  // Integers are compared as such: a real number does not hold 64 bits.
  const auto same = [](const auto& x, const auto& y) { return x && y && *x == *y; };
  const bool reals = std::holds_alternative<double>(held.data) || std::holds_alternative<double>(wanted.data);
  if (reals ? *a == *b
            : same(held.unsigned_integer(), wanted.unsigned_integer()) || same(held.integer(), wanted.integer())) {
    return 0;
  }
  return std::max(std::abs(*a - *b), 0.5);
}

// The value at a path, as the language of conditions sees it.
std::optional<launch::FieldContent> content_at(const Event& event, const launch::FieldPath& path) {
  const auto& name = std::get<std::string>(path.parts.front().step);
  if (path.parts.size() == 1) {
    if (name == "procname") {
      return launch::FieldContent{std::string_view(event.procname()), {}};
    }
    const auto context = [](std::int64_t number) {
      return number < 0 ? std::nullopt : std::optional(launch::FieldContent{number, {}});
    };
    if (name == "vpid") {
      return context(event.vpid());
    }
    if (name == "vtid") {
      return context(event.vtid());
    }
    if (name == "cpu_id") {
      return context(event.cpu_id());
    }
  }
  const Value* value = event.find(name);
  for (std::size_t i = 1; i < path.parts.size(); ++i) {
    const auto& step = path.parts[i].step;
    if (value == nullptr) {
      return std::nullopt;
    }
    const Value* found = nullptr;
    if (const auto* const index = std::get_if<std::size_t>(&step)) {
      const Value::Array* const elements = value->array();
      if (elements != nullptr && *index < elements->size()) {
        found = &(*elements)[*index];
      }
    } else if (const auto* const members = std::get_if<Value::Structure>(&value->data)) {
      for (const Value::Member& member : *members) {
        if (member.name == std::get<std::string>(step)) {
          found = &member.value;
        }
      }
    }
    value = found;
  }
  if (value == nullptr) {
    return std::nullopt;
  }
  struct Content {
    launch::FieldContent operator()(std::uint64_t number) const { return {number, {}}; }
    launch::FieldContent operator()(std::int64_t number) const { return {number, {}}; }
    launch::FieldContent operator()(double number) const { return {number, {}}; }
    launch::FieldContent operator()(const std::string& text) const { return {std::string_view(text), {}}; }
    launch::FieldContent operator()(const Value::Enumeration& enumeration) const {
      launch::FieldContent content{enumeration.number, {}};
      if (!enumeration.label.empty()) {
        content.label = enumeration.label;
      }
      return content;
    }
    launch::FieldContent operator()(const Value::Array& array) const { return {launch::FieldParts{array.size()}, {}}; }
    launch::FieldContent operator()(const Value::Structure& members) const {
      return {launch::FieldParts{members.size()}, {}};
    }
  };
  return std::visit(Content{}, value->data);
}

double distance_before(std::int64_t wanted, std::int64_t is) {
  return static_cast<double>(is) - static_cast<double>(wanted);
}

}  // namespace

EventQuery::EventQuery(std::string name) : name_(std::move(name)) {}

EventQuery& EventQuery::add(std::string description, std::vector<std::string> fields,
                            std::function<double(const Event&)> distance) {
  conditions_.push_back({std::move(description), std::move(fields), std::move(distance)});
  return *this;
}

EventQuery& EventQuery::with(std::string_view field, const Value& value) & {
  const std::string name(field);
  return add(fmt::format("{} = {}", name, to_string(value)), {name}, [name, value](const Event& event) {
    const Value* const held = event.find(name);
    return held == nullptr ? kOtherKind : distance_of(*held, value);
  });
}

EventQuery& EventQuery::with(std::string_view field, std::string_view text) & {
  return with(field, Value{std::string(text)});
}

EventQuery& EventQuery::with(std::string_view field, double number) & {
  return with(field, Value{number});
}

EventQuery& EventQuery::where(std::string_view expression) & {
  const std::string text(expression);
  std::shared_ptr<const tracing::EventCondition> parsed;
  try {
    parsed = std::make_shared<const tracing::EventCondition>(text);
  } catch (const launch::LaunchError& error) {
    const launch::Diagnostic& mistake = error.diagnostics().front();
    const std::uint32_t column = mistake.where.begin;
    throw QueryError(fmt::format("the condition is wrong: {}\n  {}\n  {:>{}}", mistake.message, text, '^', column + 1),
                     mistake.message, column);
  }
  std::vector<std::string> fields = parsed->fields();
  return add("where " + text, std::move(fields), [parsed](const Event& event) {
    const bool holds = parsed->holds([&event](const launch::FieldPath& path) { return content_at(event, path); });
    return holds ? 0 : kCondition;
  });
}

EventQuery& EventQuery::in_process(std::string_view process) & {
  std::int64_t vpid = 0;
  const auto [end, error] = std::from_chars(process.data(), process.data() + process.size(), vpid);
  if (error == std::errc() && end == process.data() + process.size()) {
    return in_process(vpid);
  }
  const bool is_pattern = process.find_first_of("*?") != std::string_view::npos;
  const std::string name(is_pattern ? process : process.substr(0, kProcnameLength));
  return add(fmt::format("in process '{}'", name), {}, [name](const Event& event) {
    return tracing::matches_pattern(name, event.procname()) ? 0 : std::max(1.0, text_distance(name, event.procname()));
  });
}

EventQuery& EventQuery::in_process(std::int64_t vpid) & {
  return add(fmt::format("in process {}", vpid), {},
             [vpid](const Event& event) { return event.vpid() == vpid ? 0 : kCondition; });
}

EventQuery& EventQuery::after(const Event& event) & {
  return add(fmt::format("after {}", event.name()), {}, [position = event.position()](const Event& other) {
    return other.position() > position ? 0 : static_cast<double>(position - other.position() + 1);
  });
}

EventQuery& EventQuery::before(const Event& event) & {
  return add(fmt::format("before {}", event.name()), {}, [position = event.position()](const Event& other) {
    return other.position() < position ? 0 : static_cast<double>(other.position() - position + 1);
  });
}

EventQuery& EventQuery::in_thread_of(const Event& event) & {
  return add(fmt::format("in thread {} of {}", event.vtid(), event.procname()), {},
             [host = event.host(), vpid = event.vpid(), vtid = event.vtid()](const Event& other) {
               return other.vtid() == vtid && other.vpid() == vpid && other.host() == host ? 0 : kCondition;
             });
}

EventQuery& EventQuery::from_time(std::int64_t time_ns) & {
  return add(fmt::format("from {} ns on", time_ns), {}, [time_ns](const Event& event) {
    return event.time_ns() >= time_ns ? 0 : -distance_before(time_ns, event.time_ns());
  });
}

EventQuery& EventQuery::until_time(std::int64_t time_ns) & {
  return add(fmt::format("before {} ns", time_ns), {}, [time_ns](const Event& event) {
    return event.time_ns() < time_ns ? 0 : distance_before(time_ns, event.time_ns()) + 1;
  });
}

EventQuery& EventQuery::that(std::string description, std::function<bool(const Event&)> holds,
                             std::vector<std::string> fields) & {
  const std::string clause = description.starts_with("whose ") ? description : "that " + description;
  return add(clause, std::move(fields),
             [holds = std::move(holds)](const Event& event) { return holds(event) ? 0 : kCondition; });
}

bool EventQuery::matches_name(const Event& event) const {
  return name_.empty() || name_ == event.name() || tracing::matches_pattern(name_, event.name());
}

bool EventQuery::matches(const Event& event) const {
  return matches_name(event) && std::all_of(conditions_.begin(), conditions_.end(),
                                            [&](const Condition& condition) { return condition.distance(event) == 0; });
}

std::vector<const Event*> EventQuery::select(const Trace& trace) const {
  std::vector<const Event*> found;
  for (const Event& event : trace) {
    if (matches(event)) {
      found.push_back(&event);
    }
  }
  return found;
}

const Event* EventQuery::first(const Trace& trace) const {
  const auto found = std::find_if(trace.begin(), trace.end(), [this](const Event& event) { return matches(event); });
  return found == trace.end() ? nullptr : &*found;
}

std::string EventQuery::describe() const {
  std::string text = name_.empty() ? "any event" : fmt::format("'{}'", name_);
  std::string separator = " ";
  bool with = false;
  for (const Condition& condition : conditions_) {
    const bool is_value = !condition.fields.empty() && condition.description.starts_with(condition.fields.front());
    text += separator + (is_value && !with ? "with " : "") + condition.description;
    with = is_value;
    separator = ", ";
  }
  return text;
}

}  // namespace launch_trace_testing
