// SPDX-License-Identifier: Apache-2.0
#include "actions/values/message_texts.hpp"

namespace launch {

LocatedText located(const std::string& text, const SourceRange& where) {
  const bool verbatim = where && where.end <= where.file->text().size() &&
                        where.file->text().compare(where.begin, where.end - where.begin, text) == 0;
  return verbatim ? LocatedText(text, where) : LocatedText(text);
}

}  // namespace launch
