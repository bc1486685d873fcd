// SPDX-License-Identifier: Apache-2.0
#include "tracing/expect/event_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>
#include <utility>

#include "base/text/names.hpp"

namespace launch_trace_testing {

namespace {

struct Cells {
  std::string time;
  std::string process;
  std::string name;
  std::string fields;
};

// The fields in the wanted order, as many as the width allows.
std::string fields_cell(const TableRow& row, const std::vector<std::string>& first, std::size_t width) {
  std::vector<std::string> names;
  for (const std::string& name : first) {
    if (row.event->find(name) != nullptr) {
      names.push_back(name);
    }
  }
  for (const std::string& name : row.event->event_class().fields) {
    if (std::find(names.begin(), names.end(), name) == names.end()) {
      names.push_back(name);
    }
  }
  std::string text = row.note;
  for (const std::string& name : names) {
    const std::string field = fmt::format("{}{}={}", text.empty() ? "" : " ", name, to_string(row.event->at(name)));
    const bool is_wanted = std::find(first.begin(), first.end(), name) != first.end();
    if (!is_wanted && text.size() + field.size() > width) {
      return text + " ...";
    }
    text += field;
  }
  return text;
}

std::string process_text(const Event& event) {
  const std::string name = event.procname().empty() ? "?" : event.procname();
  if (event.vtid() == event.vpid()) {
    return fmt::format("{}[{}]", name, event.vpid());
  }
  return fmt::format("{}[{}/{}]", name, event.vpid(), event.vtid());
}

// Of the rows that are shown: all, or the first and the last ones.
std::vector<std::size_t> shown_rows(std::size_t count) {
  std::vector<std::size_t> shown;
  for (std::size_t i = 0; i < count; ++i) {
    if (count <= kMostRows || i < kMostRows / 2 || i >= count - kMostRows / 2) {
      shown.push_back(i);
    }
  }
  return shown;
}

// How far an event is from the query: conditions that do not hold, then the sum of their distances.
using Distance = std::pair<std::size_t, double>;

Distance distance_from(const EventQuery& query, const Event& event) {
  Distance distance{0, 0};
  for (const EventQuery::Condition& condition : query.conditions()) {
    const double one = condition.distance(event);
    if (one == 0) {
      continue;
    }
    ++distance.first;
    distance.second += one;
  }
  return distance;
}

std::string note_of(const EventQuery& query, const Event& event) {
  std::string note;
  for (const EventQuery::Condition& condition : query.conditions()) {
    // The fields are in the row, so only conditions without fields need a word.
    if (condition.fields.empty() && condition.distance(event) != 0) {
      note += (note.empty() ? "not " : ", not ") + condition.description;
    }
  }
  return note.empty() ? note : "[" + note + "]";
}

std::string names_text(const Trace& trace, const EventQuery& query) {
  std::map<std::string, std::size_t> counts;
  for (const Event& event : trace) {
    ++counts[event.name()];
  }
  if (counts.empty()) {
    return "\nthe trace has no events";
  }
  std::vector<std::string> names;
  for (const auto& [name, count] : counts) {
    names.push_back(name);
  }
  const std::string nearest = launch::nearest_name(query.name(), names);
  if (!nearest.empty()) {
    return fmt::format("\nthe trace has no event of this name; did you mean '{}' ({} of them)?", nearest,
                       counts.at(nearest));
  }
  std::string text = "\nthe trace has no event of this name, but:";
  constexpr std::size_t kMostNames = 12;
  std::size_t shown = 0;
  for (const auto& [name, count] : counts) {
    if (++shown > kMostNames) {
      return text + fmt::format("\n  ... and {} more names", counts.size() - kMostNames);
    }
    text += fmt::format("\n  {:>7} {}", count, name);
  }
  return text;
}

}  // namespace

std::string event_table(const Trace& trace, const std::vector<TableRow>& rows, const std::vector<std::string>& first) {
  const std::vector<std::size_t> shown = shown_rows(rows.size());
  std::size_t process_width = 0;
  std::size_t name_width = 0;
  for (const std::size_t i : shown) {
    process_width = std::max(process_width, process_text(*rows[i].event).size());
    name_width = std::max(name_width, rows[i].event->name().size());
  }
  std::string text;
  std::size_t next = 0;
  for (const std::size_t i : shown) {
    if (i != next) {
      text += fmt::format("\n  ... {} more", i - next);
    }
    next = i + 1;
    const Event& event = *rows[i].event;
    std::string line = fmt::format("  {}  {:<{}}  {:<{}}  ", relative_time(trace, event.time_ns()), process_text(event),
                                   process_width, event.name(), name_width);
    line += fields_cell(rows[i], first, kTableWidth > line.size() ? kTableWidth - line.size() : 0);
    line.erase(line.find_last_not_of(' ') + 1);
    text += "\n" + line;
  }
  return text;
}

std::vector<TableRow> nearest_events(const Trace& trace, const EventQuery& query) {
  std::vector<std::pair<Distance, const Event*>> candidates;
  for (const Event& event : trace) {
    if (query.matches_name(event)) {
      candidates.emplace_back(distance_from(query, event), &event);
    }
  }
  // Of those that are equally near, the first ones.
  const auto nearer = [](const auto& a, const auto& b) {
    return std::pair(a.first, a.second->position()) < std::pair(b.first, b.second->position());
  };
  const std::size_t count = std::min(candidates.size(), kMostRows);
  std::partial_sort(candidates.begin(), candidates.begin() + static_cast<std::ptrdiff_t>(count), candidates.end(),
                    nearer);
  candidates.resize(count);
  std::sort(candidates.begin(), candidates.end(),
            [](const auto& a, const auto& b) { return a.second->position() < b.second->position(); });
  std::vector<TableRow> rows;
  for (const auto& [distance, event] : candidates) {
    rows.push_back({event, note_of(query, *event)});
  }
  return rows;
}

std::string nearest_text(const Trace& trace, const EventQuery& query) {
  const std::vector<TableRow> rows = nearest_events(trace, query);
  if (rows.empty()) {
    return names_text(trace, query);
  }
  return "\nnearest events:" + event_table(trace, rows, fields_of(query));
}

std::vector<std::string> fields_of(const EventQuery& query) {
  std::vector<std::string> names;
  for (const EventQuery::Condition& condition : query.conditions()) {
    for (const std::string& field : condition.fields) {
      if (std::find(names.begin(), names.end(), field) == names.end()) {
        names.push_back(field);
      }
    }
  }
  return names;
}

std::string relative_time(const Trace& trace, std::int64_t time_ns) {
  const std::int64_t after = time_ns - trace.begin_ns();
  constexpr std::int64_t kSecond = 1'000'000'000;
  return fmt::format("{}{}.{:09}", after < 0 ? '-' : '+', std::abs(after) / kSecond, std::abs(after) % kSecond);
}

std::string duration_text(std::int64_t ns) {
  return fmt::format("{:.3f} ms", static_cast<double>(ns) / 1e6);
}

std::string counted(std::size_t count, const std::string& noun) {
  if (count == 1) {
    return "1 " + noun;
  }
  return fmt::format("{} {}", count, noun + (noun.ends_with("s") ? "es" : "s"));
}

}  // namespace launch_trace_testing
