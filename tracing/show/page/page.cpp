// SPDX-License-Identifier: Apache-2.0
#include "tracing/show/page/page.hpp"

#include <stdexcept>

namespace tracing {

namespace {

// Writes what is before the place, and returns what is behind it.
std::string_view write_until(std::string_view page, std::string_view place, const WriteText& write) {
  const std::size_t at = page.find(place);
  if (at == std::string_view::npos) {
    throw std::logic_error("the page has no place for " + std::string(place));
  }
  write(page.substr(0, at));
  return page.substr(at + place.size());
}

}  // namespace

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

void write_html_page(const TracedSystem& system, const WriteText& write) {
  std::string_view rest = write_until(kPageTemplate, "/*facts*/", write);
  write(page_facts(system));
  rest = write_until(rest, "/*columns*/", write);
  write_page_columns(system.timeline, write);
  rest = write_until(rest, "<!--before-->", write);
  write(rest);
}

std::string page_columns(const timeline::Timeline& timeline) {
  std::string columns;
  write_page_columns(timeline, [&columns](std::string_view part) { columns += part; });
  return columns;
}

std::string html_page(const TracedSystem& system) {
  std::string page;
  write_html_page(system, [&page](std::string_view part) { page += part; });
  return page;
}

}  // namespace tracing
