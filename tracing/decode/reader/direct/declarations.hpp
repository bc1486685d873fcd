// SPDX-License-Identifier: Apache-2.0
// What the metadata of a trace declare, also where they end early. Private to the reader.
#pragma once

#include <cstddef>
#include <filesystem>

#include "tracing/decode/ctf/trace_class.hpp"

namespace tracing {

struct Declarations {
  ctf::TraceClass trace;
  std::size_t size = 0;  // of the text
  bool is_cut = false;   // the file is damaged or ends early
};

// `is_open`: the trace is still being written. Throws ctf::UnsupportedTrace when another reader must read it,
// TraceReadError when no reader can.
Declarations read_declarations(const std::filesystem::path& metadata, bool is_open);

}  // namespace tracing
