// SPDX-License-Identifier: Apache-2.0
#include "tracing/show/page/page.hpp"

#include <stdexcept>

namespace tracing {

namespace {

void replace(std::string& page, std::string_view place, const std::string& text) {
  const std::size_t at = page.find(place);
  if (at == std::string::npos) {
    throw std::logic_error("the page has no place for " + std::string(place));
  }
  page.replace(at, place.size(), text);
}

}  // namespace

std::string html_page(const TracedSystem& system) {
  std::string page(kPageTemplate);
  replace(page, "/*columns*/", page_columns(system.timeline));
  replace(page, "/*facts*/", page_facts(system));
  return page;
}

}  // namespace tracing
