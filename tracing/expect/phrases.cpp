// SPDX-License-Identifier: Apache-2.0
#include "tracing/expect/phrases.hpp"

#include <fmt/format.h>

#include "tracing/expect/event_table.hpp"

namespace launch_trace_testing {

std::string count_text(Count count) {
  if (count.most == 0) {
    return "no";
  }
  if (count.least == count.most) {
    return fmt::format("exactly {}", count.least);
  }
  if (count.most == Count{}.most) {
    return fmt::format("at least {}", count.least);
  }
  if (count.least == 0) {
    return fmt::format("at most {}", count.most);
  }
  return fmt::format("{} to {}", count.least, count.most);
}

std::string bounds_text(Bounds bounds) {
  std::string text;
  if (bounds.most == Bounds{}.most) {
    text = "at least " + duration_text(bounds.least.count());
  } else if (bounds.least.count() <= 0) {
    text = "at most " + duration_text(bounds.most.count());
  } else {
    text = duration_text(bounds.least.count()) + " to " + duration_text(bounds.most.count());
  }
  return bounds.share >= 1 ? text : text + fmt::format(" for {:g} % of them", bounds.share * 100);
}

}  // namespace launch_trace_testing
