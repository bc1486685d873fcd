// SPDX-License-Identifier: Apache-2.0
// A CompletionItem of the protocol.
#pragma once

#include <string>

#include "programs/launch/lsp/features.hpp"

namespace launch::lsp {

// CompletionItemKind
constexpr int kFunctionItem = 3;
constexpr int kVariableItem = 6;
constexpr int kClassItem = 7;
constexpr int kModuleItem = 9;
constexpr int kPropertyItem = 10;
constexpr int kValueItem = 12;
constexpr int kFileItem = 17;
constexpr int kFolderItem = 19;

// `replaced`: the part of the text that the item takes the place of. `insert`: what is written; empty: the label.
inline Json completion_item(const Reading& reading, Span replaced, const std::string& label, int kind,
                            const std::string& documentation, const std::string& insert) {
  Json item = {{"label", label},
               {"kind", kind},
               {"textEdit",
                {{"range", reading.document.range(replaced.begin, replaced.end)},
                 {"newText", insert.empty() ? label : insert}}}};
  if (!documentation.empty()) {
    item["documentation"] = documentation;
  }
  return item;
}

}  // namespace launch::lsp
