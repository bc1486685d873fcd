// SPDX-License-Identifier: Apache-2.0
// Writes a trace in the formats of other tools. docs/analysis.md describes them.
//
// All functions throw OutputError when something can't be written. A file is complete or not there at all: it gets its
// name when everything is in it, and then replaces an older one.
#pragma once

#include <filesystem>
#include <string>

#include "tracing/model/timeline/traced_system.hpp"

namespace tracing {

// The JSON format of Chrome's trace events, which ui.perfetto.dev, Perfetto's trace processor and chrome://tracing
// read: processes, threads, callbacks, publications, messages as flows, latencies as counters, lifecycle states, states
// of threads.
void export_perfetto(const TracedSystem& system, const std::filesystem::path& file);

// One CSV file for each table of tracing/show/tables. The directory is made if it does not exist.
void export_csv(const TracedSystem& system, const std::filesystem::path& directory);

// An SQLite database with the tables of tracing/show/tables, and two views.
void export_sqlite(const TracedSystem& system, const std::filesystem::path& file);

// Passages of chains as traces of OpenTelemetry: a request of OTLP in its JSON form.
void export_otlp(const TracedSystem& system, const std::filesystem::path& file);

// The graph of nodes and topics for Graphviz: dot -Tsvg FILE.
void export_dot(const TracedSystem& system, const std::filesystem::path& file);

// The same graph, drawn by Graphviz's program dot, which must be in PATH.
void export_svg(const TracedSystem& system, const std::filesystem::path& file);

// What export_dot() writes.
std::string dot_text(const TracedSystem& system);

}  // namespace tracing
