// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/compare/run_summary.hpp"

namespace tracing::compare {

const char* kind_name(Kind kind) {
  switch (kind) {
    case Kind::kCallback:
      return "callback";
    case Kind::kHop:
      return "hop";
    case Kind::kChain:
      return "chain";
    case Kind::kCall:
      break;
  }
  return "call";
}

std::optional<Kind> kind_of(const std::string& name) {
  for (const Kind kind : {Kind::kCallback, Kind::kHop, Kind::kChain, Kind::kCall}) {
    if (name == kind_name(kind)) {
      return kind;
    }
  }
  return std::nullopt;
}

}  // namespace tracing::compare
