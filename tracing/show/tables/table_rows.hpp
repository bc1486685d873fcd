// SPDX-License-Identifier: Apache-2.0
// How a table is declared: a row for each column, with the function that gives its cell.
//
//   table_of<timeline::Node>("nodes", "nodes of ROS 2", system, system.timeline.nodes,
//                            {{"name", kText, [](const auto&, const auto& node) { return text(node.name); }, "…"}});
//
// Tables of results have the rows of the results as columns (results/field.hpp).
#pragma once

#include <algorithm>
#include <deque>
#include <functional>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>

#include "tracing/show/tables/tables.hpp"

namespace tracing {

inline constexpr ColumnType kInteger = ColumnType::kInteger;
inline constexpr ColumnType kReal = ColumnType::kReal;
inline constexpr ColumnType kText = ColumnType::kText;

inline Cell reference(timeline::Index index) {
  return index == timeline::kNone ? Cell{} : Cell{std::int64_t{index}};
}
template <class Number>
Cell number(Number value) {
  return static_cast<std::int64_t>(value);
}
// Of a time that is 0 where the trace does not hold it.
inline Cell time(std::int64_t time_ns) {
  return time_ns == 0 ? Cell{} : Cell{time_ns};
}
inline Cell text(std::string_view text) {
  return text.empty() ? Cell{} : Cell{text};
}
template <class Value>
Cell optional(const std::optional<Value>& value) {
  using Wide = std::conditional_t<std::is_floating_point_v<Value>, double, std::int64_t>;
  return value ? Cell{static_cast<Wide>(*value)} : Cell{};
}

template <class Object>
struct ColumnOf {
  const char* name;
  ColumnType type;
  Cell (*cell)(const TracedSystem&, const Object&);
  const char* help = "";
};

// For each object a row, which begins with its place in the list.
template <class Object>
Table table_of(const char* name, const char* help, const TracedSystem& system, const std::vector<Object>& objects,
               std::vector<ColumnOf<Object>> columns) {
  Table table{name, help, {{"id"}}, nullptr};
  for (const ColumnOf<Object>& column : columns) {
    table.columns.push_back({column.name, column.type, column.help});
  }
  table.for_each_row = [&system, &objects, columns = std::move(columns)](const Emit& emit) {
    Row row(columns.size() + 1);
    for (std::size_t id = 0; id < objects.size(); ++id) {
      row[0] = number(id);
      for (std::size_t i = 0; i < columns.size(); ++i) {
        row[i + 1] = columns[i].cell(system, objects[id]);
      }
      emit(row);
    }
  };
  return table;
}

// The place in the table `processes` of one in TraceOverview::processes.
class ProcessPlaces {
 public:
  explicit ProcessPlaces(const timeline::Timeline& timeline) {
    for (std::size_t id = 0; id < timeline.processes.size(); ++id) {
      if (const std::optional<ProcessIndex>& place = timeline.processes[id].place) {
        ids_.resize(std::max(ids_.size(), *place + 1), timeline::kNone);
        if (ids_[*place] == timeline::kNone) {
          ids_[*place] = static_cast<timeline::Index>(id);
        }
      }
    }
  }
  Cell operator()(std::uint64_t place) const { return place < ids_.size() ? reference(ids_[place]) : Cell{}; }

 private:
  std::vector<timeline::Index> ids_;
};

template <class Result>
class ResultColumns {
 public:
  static std::vector<Column> columns() {
    std::vector<Column> columns;
    const Result result{};
    for (const Field<Result>& field : Result::kFields) {
      if (is_in_tables(field)) {
        field.member.visit([&](auto member) { add_column(columns, field, std::invoke(member, result)); });
      }
    }
    return columns;
  }

  static void add_cells(const Result& result, const ProcessPlaces& places, Row& row, std::deque<std::string>& texts) {
    for (const Field<Result>& field : Result::kFields) {
      if (is_in_tables(field)) {
        field.member.visit(
            [&](auto member) { add_cell(std::invoke(member, result), field, result, places, row, texts); });
      }
    }
  }

 private:
  static bool is_in_tables(const Field<Result>& field) {
    return !field.has(trait::kNotInTables) && !field.member.is_list();
  }

  template <class Value>
  static void add_column(std::vector<Column>& columns, const Field<Result>& field, const Value&) {
    if constexpr (std::is_same_v<Value, DurationSummary>) {
      for (const Field<DurationSummary>& part : kDurationFields) {
        part.member.visit([&](auto member) {
          const bool is_real = std::is_same_v<std::decay_t<decltype(std::invoke(member, DurationSummary{}))>, double>;
          const bool is_first = &part == std::begin(kDurationFields);
          columns.push_back(
              {std::string(field.name) + "_" + part.name, is_real ? kReal : kInteger, is_first ? field.help : ""});
        });
      }
    } else if constexpr (std::is_convertible_v<Value, std::string_view>) {
      columns.push_back({field.name, kText, field.help});
    } else if constexpr (std::is_same_v<Value, double> || std::is_same_v<Value, std::optional<double>>) {
      columns.push_back({field.name, kReal, field.help});
    } else {
      columns.push_back({field.name, kInteger, field.has(trait::kProcess) ? "in `processes`" : field.help});
    }
  }

  template <class Value>
  static void add_cell(const Value& value, const Field<Result>& field, const Result& result,
                       const ProcessPlaces& places, Row& row, std::deque<std::string>& texts) {
    if constexpr (std::is_same_v<Value, DurationSummary>) {
      add_durations(value, field.is_in(result), row);
    } else if (!field.is_in(result)) {
      row.emplace_back();
    } else if constexpr (std::is_same_v<Value, std::string>) {
      row.push_back(text(texts.emplace_back(value)));
    } else if constexpr (std::is_convertible_v<Value, std::string_view>) {
      row.push_back(text(value));
    } else if constexpr (std::is_same_v<Value, double>) {
      row.emplace_back(value);
    } else if constexpr (requires { value.has_value(); }) {
      const bool is_process = value && field.has(trait::kProcess);
      row.push_back(is_process ? places(static_cast<std::uint64_t>(*value)) : optional(value));
    } else if constexpr (std::is_integral_v<Value>) {
      row.push_back(field.has(trait::kProcess) ? places(static_cast<std::uint64_t>(value)) : number(value));
    }
  }

  static void add_durations(const DurationSummary& summary, bool is_there, Row& row) {
    for (const Field<DurationSummary>& part : kDurationFields) {
      const bool is_count = &part == std::begin(kDurationFields);
      part.member.visit([&](auto member) {
        using Value = std::decay_t<decltype(std::invoke(member, summary))>;
        if (!is_there || (!is_count && summary.count == 0)) {
          row.emplace_back();
        } else if constexpr (std::is_same_v<Value, double>) {
          row.emplace_back(std::invoke(member, summary));
        } else if constexpr (std::is_integral_v<Value>) {
          row.push_back(number(std::invoke(member, summary)));
        }
      });
    }
  }
};

// For each result a row: its place in the list, `first` if there is one, and its fields.
template <class Result>
Table result_table(const char* name, const char* help, const TracedSystem& system, const std::vector<Result>& results,
                   std::optional<ColumnOf<Result>> first = std::nullopt) {
  Table table{name, help, {{"id"}}, nullptr};
  if (first) {
    table.columns.push_back({first->name, first->type, first->help});
  }
  for (Column& column : ResultColumns<Result>::columns()) {
    table.columns.push_back(std::move(column));
  }
  table.for_each_row = [&system, &results, first](const Emit& emit) {
    const ProcessPlaces places(system.timeline);
    std::deque<std::string> texts;
    for (std::size_t id = 0; id < results.size(); ++id) {
      Row row{number(id)};
      if (first) {
        row.push_back(first->cell(system, results[id]));
      }
      texts.clear();
      ResultColumns<Result>::add_cells(results[id], places, row, texts);
      emit(row);
    }
  };
  return table;
}

// What the files beside this one declare, in the order of the tables.
void add_trace_tables(const TracedSystem& system, std::vector<Table>& tables);
void add_object_tables(const TracedSystem& system, std::vector<Table>& tables);
void add_event_tables(const TracedSystem& system, std::vector<Table>& tables);
void add_chain_tables(const TracedSystem& system, std::vector<Table>& tables);
void add_statistics_tables(const TracedSystem& system, std::vector<Table>& tables);

}  // namespace tracing
