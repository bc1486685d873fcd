// SPDX-License-Identifier: Apache-2.0
// Results of the whole trace that the page shows as they are, made from the rows of their fields.
#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <string>

#include "tracing/model/analysis/results.hpp"
#include "tracing/model/timeline/traced_system.hpp"

namespace tracing {

using PageJson = nlohmann::ordered_json;

// Keys are the names of fields without _ns. Points in time count from `begin_ns`.
class ResultFacts {
 public:
  explicit ResultFacts(std::int64_t begin_ns) : begin_ns_(begin_ns) {}

  template <class Value>
  PageJson of(const Value& value) const {
    return value;
  }
  template <class Value>
  PageJson of(const std::optional<Value>& value) const {
    return value ? of(*value) : PageJson(nullptr);
  }
  // Null if nothing was measured.
  PageJson of(const DurationSummary& summary) const {
    return summary.count == 0 ? PageJson(nullptr) : with_fields(PageJson::object(), summary, kDurationFields);
  }
  template <HasFields Result>
  PageJson of(const std::vector<Result>& results) const {
    PageJson list = PageJson::array();
    for (const Result& result : results) {
      list.push_back(with(PageJson::object(), result));
    }
    return list;
  }
  // The object with the fields of the result. A key that it has keeps its place.
  template <HasFields Result>
  PageJson with(PageJson object, const Result& result) const {
    return with_fields(std::move(object), result, Result::kFields);
  }

 private:
  template <class Result, std::size_t kCount>
  PageJson with_fields(PageJson object, const Result& result, const Field<Result> (&fields)[kCount]) const {
    for (const Field<Result>& field : fields) {
      if (field.has(trait::kProcess | trait::kNotOnPage) || field.member.is_list() || !field.is_in(result)) {
        continue;
      }
      const std::string name = field.name;
      PageJson& value = object[name.ends_with("_ns") ? name.substr(0, name.size() - 3) : name];
      field.member.visit([&](auto member) { value = of(std::invoke(member, result)); });
      if (field.has(trait::kTime) && !value.is_null()) {
        value = value.template get<std::int64_t>() - begin_ns_;
      }
    }
    return object;
  }

  std::int64_t begin_ns_;
};

// starts, startup, calls, actions, state_memory, callback_memory, cost, absences, overwritten.
PageJson result_facts(const TracedSystem& system);

}  // namespace tracing
