// SPDX-License-Identifier: Apache-2.0
// Numbers of the protocol's CompletionItemKind.
#pragma once

namespace launch::lsp {

constexpr int kFunctionItem = 3;
constexpr int kVariableItem = 6;
constexpr int kClassItem = 7;
constexpr int kModuleItem = 9;
constexpr int kPropertyItem = 10;
constexpr int kValueItem = 12;
constexpr int kFileItem = 17;
constexpr int kFolderItem = 19;

}  // namespace launch::lsp
