// SPDX-License-Identifier: Apache-2.0
#include "tracing/show/tables/table_rows.hpp"
#include "tracing/show/tables/tables.hpp"

namespace tracing {

std::vector<Table> tables_of(const TracedSystem& system) {
  std::vector<Table> tables{{"schema_version",
                             "one row: the version of these tables. It is raised when an existing column comes to mean "
                             "something else, or goes; new tables and columns do not raise it",
                             {{"version"}},
                             [](const Emit& emit) { emit({kTablesVersion}); }}};
  add_trace_tables(system, tables);
  add_object_tables(system, tables);
  add_event_tables(system, tables);
  add_chain_tables(system, tables);
  add_statistics_tables(system, tables);
  return tables;
}

}  // namespace tracing
