// SPDX-License-Identifier: Apache-2.0
// A page with two runs of a system side by side.
#pragma once

#include <string>
#include <vector>

namespace tracing {

// One of the runs.
struct PageRun {
  std::string facts;    // page_facts()
  std::string columns;  // page_columns()
  // What the comparison calls the objects of the run, by their ids.
  struct Names {
    std::vector<std::string> callbacks;
    std::vector<std::string> steps;  // callbacks as steps of chains
    std::vector<std::string> subscriptions;
    std::vector<std::string> chains;  // those that the comparison has; it does not know chains that users name
  } names;
};

struct PageRuns {
  const PageRun& before;
  const PageRun& after;
};

// `comparison` is the JSON of docs/schema/comparison.schema.json.
std::string comparison_page(const PageRuns& runs, const std::string& comparison);

}  // namespace tracing
