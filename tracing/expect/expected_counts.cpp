// SPDX-License-Identifier: Apache-2.0
// Expectations of how many events there are, and of what each of them holds.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>

#include "base/text/names.hpp"
#include "launch_trace_testing/expectations.hpp"
#include "tracing/decode/reader/event_pattern.hpp"
#include "tracing/expect/event_table.hpp"
#include "tracing/expect/verdict_text.hpp"

namespace launch_trace_testing {

namespace {

std::string quoted(const std::vector<std::string>& names) {
  std::vector<std::string> texts;
  for (const std::string& name : names) {
    texts.push_back("'" + name + "'");
  }
  return fmt::format("{}", fmt::join(texts, ", "));
}

bool is_of_kind(const Value& value, FieldKind kind, std::optional<std::size_t> length) {
  switch (kind) {
    case FieldKind::kHandle:
    case FieldKind::kPointer:
      return value.hexadecimal && value.unsigned_integer().value_or(0) != 0;
    case FieldKind::kPointerOrNull:
      return value.hexadecimal && value.unsigned_integer().has_value();
    case FieldKind::kText:
      return std::holds_alternative<std::string>(value.data);
    case FieldKind::kNonEmptyText:
      return std::holds_alternative<std::string>(value.data) && !std::get<std::string>(value.data).empty();
    case FieldKind::kInteger:
      return std::holds_alternative<std::int64_t>(value.data) || std::holds_alternative<std::uint64_t>(value.data);
    case FieldKind::kQueueDepth:
      return std::holds_alternative<std::uint64_t>(value.data) && !value.hexadecimal;
    case FieldKind::kReal:
      return std::holds_alternative<double>(value.data);
    case FieldKind::kArray:
      return value.array() != nullptr && (!length || value.array()->size() == *length);
  }
  return false;
}

std::string kind_text(FieldKind kind, std::optional<std::size_t> length) {
  switch (kind) {
    case FieldKind::kHandle:
      return "a handle";
    case FieldKind::kPointer:
      return "a pointer that is not null";
    case FieldKind::kPointerOrNull:
      return "a pointer";
    case FieldKind::kText:
      return "a text";
    case FieldKind::kNonEmptyText:
      return "a text that is not empty";
    case FieldKind::kInteger:
      return "an integer";
    case FieldKind::kQueueDepth:
      return "a number of messages";
    case FieldKind::kReal:
      return "a real number";
    case FieldKind::kArray:
      return length ? fmt::format("an array of {}", *length) : "an array";
  }
  return {};
}

// The verdict on a condition that every selected event must meet.
Verdict verdict_on_each(const Trace& trace, const EventQuery& all, const std::string& expected,
                        const std::function<bool(const Event&)>& holds, const std::vector<std::string>& fields) {
  const std::vector<const Event*> selected = all.select(trace);
  if (selected.empty()) {
    return {false, expected + "\n     saw: no such event" + nearest_text(trace, all)};
  }
  std::vector<TableRow> failed;
  for (const Event* const event : selected) {
    if (!holds(*event)) {
      failed.push_back({event});
    }
  }
  if (failed.empty()) {
    return {true, fmt::format("{}\n     saw: {} of {}", expected, selected.size(), selected.size())};
  }
  return {false, fmt::format("{}\n     saw: {} of {} without it:{}", expected, failed.size(), selected.size(),
                             event_table(trace, failed, fields))};
}

// The field that a condition looks at and none of the events of this name has. Such a condition never holds. nullopt if
// there is no such field, or no event of this name: who knows then what fields it would have?
std::optional<std::string> field_of_no_event(const Trace& trace, const EventQuery& query) {
  std::set<std::string> known;
  const EventClass* last = nullptr;
  for (const Event& event : trace) {
    if (&event.event_class() != last && tracing::matches_pattern(query.name(), event.name())) {
      last = &event.event_class();
      known.insert(last->fields.begin(), last->fields.end());
      known.insert(last->contexts.begin(), last->contexts.end());
    }
  }
  if (last == nullptr) {
    return std::nullopt;
  }
  known.insert({"procname", "vpid", "vtid", "cpu_id"});
  for (const std::string& path : fields_of(query)) {
    const std::string field = path.substr(0, path.find_first_of(".["));
    if (!known.contains(field)) {
      const std::string nearest = launch::nearest_name(field, {known.begin(), known.end()});
      return fmt::format("'{}'{}", field, nearest.empty() ? "" : fmt::format("; is '{}' meant?", nearest));
    }
  }
  return std::nullopt;
}

}  // namespace

Verdict expect_count(const Trace& trace, const EventQuery& query, Count count) {
  const std::vector<const Event*> found = query.select(trace);
  Verdict verdict;
  verdict.holds = found.size() >= count.least && found.size() <= count.most;
  verdict.text = fmt::format("expected: {} {}\n     saw: {} of {}", count_text(count), query.describe(),
                             found.empty() ? "none" : std::to_string(found.size()), counted(trace.size(), "event"));
  if (found.empty()) {
    if (!verdict.holds) {
      verdict.text += nearest_text(trace, query);
    } else if (const std::optional<std::string> field = field_of_no_event(trace, query)) {
      return {false, fmt::format("expected: {} {}\n     saw: no event '{}' has a field {}", count_text(count),
                                 query.describe(), query.name(), *field)};
    }
    return verdict;
  }
  std::vector<TableRow> rows;
  for (const Event* const event : found) {
    rows.push_back({event});
  }
  verdict.text += event_table(trace, rows, fields_of(query));
  return verdict;
}

Verdict expect_each(const Trace& trace, const EventQuery& all, const EventQuery& required) {
  std::string clause;
  for (const EventQuery::Condition& condition : required.conditions()) {
    clause += (clause.empty() ? "" : ", ") + condition.description;
  }
  const std::string expected = fmt::format("expected: each {} has {}", all.describe(), clause);
  return verdict_on_each(
      trace, all, expected, [&](const Event& event) { return required.matches(event); }, fields_of(required));
}

Verdict expect_field(const Trace& trace, const EventQuery& query, const std::string& field, FieldKind kind,
                     std::optional<std::size_t> length) {
  const std::string expected =
      fmt::format("expected: each {} has {} in {}", query.describe(), kind_text(kind, length), field);
  return verdict_on_each(trace, query, expected,
                         [&](const Event& event) {
                           const Value* const value = event.find(field);
                           return value != nullptr && is_of_kind(*value, kind, length);
                         },
                         {field});
}

Verdict expect_event_names(const Trace& trace, const std::vector<std::string>& names, const std::string& among) {
  std::map<std::string, std::size_t> counts;
  for (const Event& event : trace) {
    if (tracing::matches_pattern(among, event.name())) {
      ++counts[event.name()];
    }
  }
  std::vector<std::string> missing;
  std::vector<std::string> others;
  for (const std::string& name : names) {
    if (!counts.contains(name)) {
      missing.push_back(name);
    }
  }
  for (const auto& [name, count] : counts) {
    if (std::find(names.begin(), names.end(), name) == names.end()) {
      others.push_back(name);
    }
  }
  Verdict verdict{missing.empty() && others.empty(),
                  fmt::format("expected: events of exactly {}{}\n     saw: {}", counted(names.size(), "name"),
                              among == "*" ? "" : fmt::format(" among '{}'", among), counted(counts.size(), "name"))};
  if (!missing.empty()) {
    verdict.text += "\n missing: " + quoted(missing);
  }
  if (!others.empty()) {
    verdict.text += "\n  others: " + quoted(others);
  }
  return verdict;
}

Verdict expect_processes(const Trace& trace, const std::vector<std::string>& names) {
  std::vector<std::string> missing;
  for (const std::string& name : names) {
    if (EventQuery("").in_process(std::string_view(name)).first(trace) == nullptr) {
      missing.push_back(name);
    }
  }
  std::map<std::string, std::size_t> counts;
  for (const Event& event : trace) {
    ++counts[fmt::format("{}[{}]", event.procname(), event.vpid())];
  }
  std::string seen;
  for (const auto& [name, count] : counts) {
    seen += fmt::format("{}{} ({})", seen.empty() ? "" : ", ", name, count);
  }
  Verdict verdict{missing.empty(), fmt::format("expected: events of {}\n     saw: {}", quoted(names),
                                               seen.empty() ? "no events" : seen)};
  if (!missing.empty()) {
    verdict.text += "\n missing: " + quoted(missing);
  }
  return verdict;
}

Verdict expect_matching_field(const Trace& trace, const Event& event, const std::string& field, const EventQuery& other,
                              const std::string& other_field) {
  const std::string& name = other_field.empty() ? field : other_field;
  EventQuery wanted = other;
  wanted.with(name, event.at(field));
  for (const Event* const found : wanted.select(trace)) {
    if (found->position() == event.position()) {
      continue;
    }
    return {true, fmt::format("expected: {} of {} in another event\n     saw:{}", field, event.name(),
                              event_table(trace, {{&event}, {found}}, {field, name}))};
  }
  return {false, fmt::format("expected: the {} of this event in {}\n     saw: none for this event:{}{}", field,
                             other.describe(), event_table(trace, {{&event}}, {field}), nearest_text(trace, wanted))};
}

Verdict expect_no_loss(const Trace& trace) {
  std::string text = "expected: events, none of them lost, and no damage\n     saw: " + counted(trace.size(), "event");
  for (const Loss& loss : trace.losses()) {
    const std::string count = loss.count ? std::to_string(*loss.count) : "some";
    text += fmt::format("\n  {} {} lost", count, loss.whole_packets ? "packets" : "events");
    if (loss.begin_ns != 0) {
      text += fmt::format(" from {}", relative_time(trace, loss.begin_ns));
    }
    if (loss.end_ns != 0) {
      text += fmt::format(" to {}", relative_time(trace, loss.end_ns));
    }
    text += fmt::format(" in {}", std::filesystem::path(loss.stream).filename().string());
  }
  for (const std::string& damage : trace.damage()) {
    text += "\n  damaged: " + damage;
  }
  return {!trace.empty() && trace.losses().empty() && trace.damage().empty(), text};
}

}  // namespace launch_trace_testing
