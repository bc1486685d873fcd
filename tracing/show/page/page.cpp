// SPDX-License-Identifier: Apache-2.0
#include "tracing/show/page/page.hpp"

#include <stdexcept>

namespace tracing {

void fill_place(std::string& page, std::string_view comment, const std::string& text) {
  const std::size_t at = page.find(comment);
  if (at == std::string::npos) {
    throw std::logic_error("the page has no place for " + std::string(comment));
  }
  page.replace(at, comment.size(), text);
}

std::string script_text(std::string json) {
  for (std::size_t at = json.find('<'); at != std::string::npos; at = json.find('<', at)) {
    json.replace(at, 1, "\\u003c");
  }
  return json;
}

std::string html_page(const TracedSystem& system) {
  std::string page(kPageTemplate);
  fill_place(page, "/*columns*/", page_columns(system.timeline));
  fill_place(page, "/*facts*/", page_facts(system));
  fill_place(page, "<!--before-->", "");
  return page;
}

}  // namespace tracing
