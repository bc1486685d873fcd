// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <sqlite3.h>

#include <filesystem>
#include <stdexcept>

#include "tests/support/trace_writer/temporary_directory.hpp"
#include "tests/support/traced_example/traced_example.hpp"
#include "tracing/show/export/export.hpp"
#include "tracing/show/export/output_file.hpp"

namespace tracing {
namespace {

// The rows of the answer, their cells separated by |.
std::vector<std::string> ask(const std::filesystem::path& file, const std::string& question) {
  sqlite3* database = nullptr;
  sqlite3_open_v2(file.c_str(), &database, SQLITE_OPEN_READONLY, nullptr);
  std::vector<std::string> rows;
  const auto add = [](void* list, int count, char** values, char**) {
    std::string row;
    for (int i = 0; i < count; ++i) {
      row += i > 0 ? "|" : "";
      row += values[i] == nullptr ? "NULL" : values[i];
    }
    static_cast<std::vector<std::string>*>(list)->push_back(row);
    return 0;
  };
  char* error = nullptr;
  sqlite3_exec(database, question.c_str(), add, &rows, &error);
  if (error != nullptr) {
    rows = {error};
  }
  sqlite3_free(error);
  sqlite3_close(database);
  return rows;
}

using Rows = std::vector<std::string>;

TEST(SqliteExport, AnswersQuestions) {
  const testing::TemporaryDirectory directory;
  const std::filesystem::path file = directory.path() / "trace.db";
  export_sqlite(testing::traced_example(100), file);

  EXPECT_EQ(ask(file, "PRAGMA integrity_check"), Rows{"ok"});
  EXPECT_EQ(ask(file, "SELECT node, kind, name, count(*), max(duration_ns) FROM callback_durations GROUP BY node"),
            (Rows{"/display|subscription|/points|98|50000", "/filter|subscription|/scan|100|4000000",
                  "/sensor|timer|NULL|100|200000"}));
  EXPECT_EQ(
      ask(file, "SELECT topic, publisher, subscription, count(*), avg(latency_ns) FROM message_latencies GROUP BY 1"),
      (Rows{"/points|/filter|/display|98|200000.0", "/scan|/sensor|/filter|100|200000.0"}));
  EXPECT_EQ(ask(file, "SELECT count(*) FROM messages WHERE taken_ns IS NULL"), Rows{"2"});
  EXPECT_EQ(
      ask(file, "SELECT name, state, end_ns - begin_ns FROM lifecycle_states s JOIN nodes n ON n.id = s.node LIMIT 2"),
      (Rows{"/display|unconfigured|2700000", "/display|configuring|3000000"}));
  EXPECT_EQ(ask(file, "SELECT events, lost_events, error FROM trace"), Rows{"2716|0|NULL"});
  EXPECT_EQ(ask(file, "SELECT vpid, events FROM event_counts WHERE event = 'ros2:rmw_take' ORDER BY 1"),
            (Rows{"102|100", "103|98"}));
}

TEST(SqliteExport, ReplacesAnOlderDatabase) {
  const testing::TemporaryDirectory directory;
  const std::filesystem::path file = directory.path() / "trace.db";
  export_sqlite(testing::traced_example(5), file);
  export_sqlite(testing::traced_example(2), file);
  EXPECT_EQ(ask(file, "SELECT count(*) FROM callback_instances"), Rows{"6"});
}

TEST(SqliteExport, SaysWhyItCannotBeWritten) {
  EXPECT_THROW(export_sqlite({}, "/nowhere/trace.db"), OutputError);
}

}  // namespace
}  // namespace tracing
