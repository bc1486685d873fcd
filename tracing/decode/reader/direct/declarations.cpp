// SPDX-License-Identifier: Apache-2.0
#include "tracing/decode/reader/direct/declarations.hpp"

#include <fmt/format.h>

#include <string>
#include <string_view>

#include "tracing/decode/ctf/metadata_text.hpp"
#include "tracing/decode/reader/trace_read_error.hpp"

namespace tracing {

namespace fs = std::filesystem;

namespace {

// The metadata of a trace that is still being written may end anywhere. What follows the last whole block is left out.
ctf::TraceClass parse_growing_metadata(const std::string& text) {
  constexpr std::string_view kEndOfBlock = "\n};";
  try {
    return ctf::parse_metadata(text);
  } catch (const ctf::UnsupportedTrace&) {
    const std::size_t end = text.rfind(kEndOfBlock);
    return end == std::string::npos ? ctf::TraceClass() : ctf::parse_metadata(text.substr(0, end + kEndOfBlock.size()));
  }
}

// libbabeltrace2 does not come to an end with such metadata.
ctf::TraceClass parse_cut_metadata(const fs::path& file, const std::string& text) {
  ctf::TraceClass declarations;
  try {
    declarations = parse_growing_metadata(text);
  } catch (const ctf::UnsupportedTrace&) {
  }
  if (declarations.streams.empty()) {
    throw TraceReadError(fmt::format("'{}' is damaged or ends early, before it describes an event", file.string()), "");
  }
  return declarations;
}

}  // namespace

Declarations read_declarations(const fs::path& metadata, bool is_open) {
  const auto [text, is_cut] = ctf::read_metadata_text(metadata);
  if (is_open) {
    return {parse_growing_metadata(text), text.size(), is_cut};
  }
  return {is_cut ? parse_cut_metadata(metadata, text) : ctf::parse_metadata(text), text.size(), is_cut};
}

}  // namespace tracing
