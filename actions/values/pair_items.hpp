// SPDX-License-Identifier: Apache-2.0
// Items that are a name and a value: <env>, <keep>, <arg>, <let>.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "launcher/language/fields.hpp"

namespace launch {

inline ItemSpec pair_item(std::string tag, std::string help, std::string name_help) {
  return {std::move(tag),
          std::move(help),
          {{"name", AttributeType::kText, true, "", std::move(name_help)},
           {"value", AttributeType::kText, true, "", "its value"}}};
}

// The items of this tag, evaluated in the order of the file.
inline std::vector<std::pair<std::string, std::string>> perform_pairs(const Fields& fields, const char* tag,
                                                                      Scope& scope) {
  std::vector<std::pair<std::string, std::string>> pairs;
  for (const Fields* const item : fields.items(tag)) {
    std::string name = item->text("name").perform(scope);
    pairs.emplace_back(std::move(name), item->text("value").perform(scope));
  }
  return pairs;
}

}  // namespace launch
