// SPDX-License-Identifier: Apache-2.0
#include "tracing/show/page/comparison_page.hpp"

#include <nlohmann/json.hpp>

#include "tracing/show/page/page.hpp"

namespace tracing {

namespace {

nlohmann::ordered_json names_json(const PageRun::Names& names) {
  return {{"callbacks", names.callbacks},
          {"steps", names.steps},
          {"subscriptions", names.subscriptions},
          {"chains", names.chains}};
}

std::string data_element(const char* type, const char* id, const std::string& text) {
  return std::string("<script type=\"") + type + "\" id=\"" + id + "\">" + text + "</script>\n";
}

}  // namespace

std::string comparison_page(const PageRuns& runs, const std::string& comparison) {
  nlohmann::ordered_json result = nlohmann::ordered_json::parse(comparison);
  result["names"] = nlohmann::ordered_json::array({names_json(runs.before.names), names_json(runs.after.names)});
  std::string page(kPageTemplate);
  fill_place(page, "/*columns*/", runs.after.columns);
  fill_place(page, "/*facts*/", runs.after.facts);
  fill_place(
      page, "<!--before-->",
      data_element("application/json", "facts-before", runs.before.facts) +
          data_element("text/plain", "columns-before", runs.before.columns) +
          data_element("application/json", "comparison",
                       script_text(result.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace))));
  return page;
}

}  // namespace tracing
