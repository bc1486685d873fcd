// SPDX-License-Identifier: Apache-2.0
#include "tracing/show/report/text_table.hpp"

#include <fmt/format.h>

namespace tracing {

std::string TextTable::row(const std::string& label, const std::vector<std::string>& cells) const {
  std::string text = label;
  if (label.size() > label_width_ && !cells.empty()) {
    text += fmt::format("\n{:{}}", "", label_width_);
  } else {
    text = fmt::format("{:{}}", label, label_width_);
  }
  for (std::size_t i = 0; i < cells.size(); ++i) {
    text += fmt::format(" {:>{}}", cells[i], widths_[i] - 1);
  }
  text.erase(text.find_last_not_of(' ') + 1);
  return text + '\n';
}

}  // namespace tracing
