// SPDX-License-Identifier: Apache-2.0
// Texts in attributes that speak of a message: its type, its values as YAML, a condition on its fields.
#pragma once

#include <memory>
#include <string>

#include "base/diagnostics/diagnostic.hpp"
#include "launcher/message_types/interface_type.hpp"
#include "launcher/substitution/scope.hpp"

namespace launch {

// The text of an attribute with its places. With a substitution or an escape the text is not in the file as it is, so
// that it has none of its own.
inline LocatedText located(const std::string& text, const SourceRange& where) {
  const bool verbatim = where && where.end <= where.file->text().size() &&
                        where.file->text().compare(where.begin, where.end - where.begin, text) == 0;
  return verbatim ? LocatedText(text, where) : LocatedText(text);
}

// Gives the errors of `act` that have no place this one.
template <typename Act>
void at_place(const SourceRange& where, const Act& act) {
  try {
    act();
  } catch (const LaunchError& error) {
    std::vector<Diagnostic> placed = error.diagnostics();
    for (Diagnostic& each : placed) {
      each.where = each.where ? each.where : where;
    }
    throw LaunchError(std::move(placed));
  }
}

}  // namespace launch
