// SPDX-License-Identifier: Apache-2.0
// Gives what has come of a live session to a sink, in parts, so that the caller can do something else in between.
#pragma once

#include "tracing/decode/reader/live_reader.hpp"
#include "tracing/decode/reader/trace_sink.hpp"

namespace tracing {

// Not much more than is read in an instant. Returns kItem when there may be more. Throws TraceReadError.
LiveReader::State read_some(LiveReader& reader, TraceSink& sink);

}  // namespace tracing
