// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <sqlite3.h>

#include <memory>

#include "tracing/show/export/export.hpp"
#include "tracing/show/export/output_file.hpp"
#include "tracing/show/tables/tables.hpp"

namespace tracing {

namespace {

struct CloseDatabase {
  void operator()(sqlite3* database) const { sqlite3_close(database); }
};
struct FinalizeStatement {
  void operator()(sqlite3_stmt* statement) const { sqlite3_finalize(statement); }
};

const char* type_name(ColumnType type) {
  switch (type) {
    case ColumnType::kText:
      return "TEXT";
    case ColumnType::kReal:
      return "REAL";
    case ColumnType::kInteger:
      break;
  }
  return "INTEGER";
}

class Database {
 public:
  // `file` is the name for messages, `path` the one that is opened.
  Database(std::filesystem::path file, const std::filesystem::path& path) : file_(std::move(file)) {
    sqlite3* opened = nullptr;
    // One thread uses it.
    const int flags = SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE | SQLITE_OPEN_NOMUTEX;
    const int result = sqlite3_open_v2(path.c_str(), &opened, flags, nullptr);
    database_.reset(opened);
    check(result);
  }

  void execute(const std::string& statement) {
    check(sqlite3_exec(database_.get(), statement.c_str(), nullptr, nullptr, nullptr));
  }

  void add(const Table& table) {
    std::string columns;
    std::string places;
    for (const Column& column : table.columns) {
      const bool is_key = column.name == "id";
      columns += fmt::format("{}{} {}{}", columns.empty() ? "" : ", ", column.name, type_name(column.type),
                             is_key ? " PRIMARY KEY" : "");
      places += places.empty() ? "?" : ",?";
    }
    execute(fmt::format("CREATE TABLE {}({})", table.name, columns));
    sqlite3_stmt* prepared = nullptr;
    const std::string insert = fmt::format("INSERT INTO {} VALUES({})", table.name, places);
    check(sqlite3_prepare_v2(database_.get(), insert.c_str(), -1, &prepared, nullptr));
    const std::unique_ptr<sqlite3_stmt, FinalizeStatement> statement(prepared);
    table.for_each_row([&](const Row& row) {
      for (std::size_t i = 0; i < row.size(); ++i) {
        bind(statement.get(), static_cast<int>(i) + 1, row[i]);
      }
      if (sqlite3_step(statement.get()) != SQLITE_DONE) {
        check(sqlite3_errcode(database_.get()));
      }
      sqlite3_reset(statement.get());
    });
  }

 private:
  void bind(sqlite3_stmt* statement, int place, const Cell& cell) {
    if (const auto* integer = std::get_if<std::int64_t>(&cell)) {
      check(sqlite3_bind_int64(statement, place, *integer));
    } else if (const auto* real = std::get_if<double>(&cell)) {
      check(sqlite3_bind_double(statement, place, *real));
    } else if (const auto* text = std::get_if<std::string_view>(&cell)) {
      check(sqlite3_bind_text(statement, place, text->data(), static_cast<int>(text->size()), SQLITE_STATIC));
    } else {
      check(sqlite3_bind_null(statement, place));
    }
  }

  void check(int result) const {
    if (result != SQLITE_OK) {
      throw OutputError(file_, sqlite3_errmsg(database_.get()));
    }
  }

  std::filesystem::path file_;
  std::unique_ptr<sqlite3, CloseDatabase> database_;
};

// The two questions that come first, with names instead of references.
constexpr const char* kViews = R"(
CREATE VIEW callback_durations AS
  SELECT i.id AS instance, n.name AS node, c.kind AS kind, coalesce(t.name, c.service) AS name, c.symbol AS symbol,
    i.start_ns AS start_ns, i.duration_ns AS duration_ns
  FROM callback_instances i JOIN callbacks c ON c.id = i.callback LEFT JOIN nodes n ON n.id = c.node
    LEFT JOIN topics t ON t.id = c.topic;
CREATE VIEW message_latencies AS
  SELECT m.id AS message, t.name AS topic, pn.name AS publisher, sn.name AS subscription, m.published_ns AS published_ns,
    m.callback_ns - m.published_ns AS latency_ns
  FROM messages m JOIN topics t ON t.id = m.topic JOIN publishers p ON p.id = m.publisher
    LEFT JOIN nodes pn ON pn.id = p.node JOIN subscriptions s ON s.id = m.subscription LEFT JOIN nodes sn ON sn.id = s.node
  WHERE m.callback_ns IS NOT NULL;
)";

}  // namespace

void export_sqlite(const TracedSystem& system, const std::filesystem::path& file) {
  OutputFile output(file);
  {
    Database database(file, output.unfinished());
    // The file gets its name only when it is complete, so a journal would protect nothing.
    database.execute("PRAGMA journal_mode = OFF; PRAGMA synchronous = OFF; BEGIN");
    for (const Table& table : tables_of(system)) {
      database.add(table);
    }
    database.execute(kViews);
    database.execute("COMMIT");
  }
  output.finish();
}

}  // namespace tracing
