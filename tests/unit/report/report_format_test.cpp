// SPDX-License-Identifier: Apache-2.0
// docs/schema/report.schema.json and the tables of docs/report_format.md say what the rows of the results say.
// LAUNCH_UPDATE_GOLDEN=1 writes both anew; read them before committing.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tracing/show/report/comparison_report.hpp"
#include "tracing/show/report/report_keys.hpp"

namespace tracing {
namespace {

using Json = nlohmann::ordered_json;

// The schema of each key, by the type of its value.
class Schema {
 public:
  template <class Value>
  void operator()(const char* key, const Value& value) {
    properties_[key] = key == std::string("version") ? Json{{"const", 1}} : of(value);
  }
  const Json& properties() const { return properties_; }

  template <std::size_t kCount>
  Json durations(const Field<DurationSummary> (&fields)[kCount]) const {
    Json schema = object(fields);
    Json& required = schema["required"];
    const Json with_count(required.begin() + 1, required.end());
    return {{"properties", schema["properties"]}, {"required", {"count"}}, {"then", {{"required", with_count}}}};
  }

 private:
  Json of(bool) const { return {{"type", "boolean"}}; }
  Json of(std::int64_t) const { return {{"type", "integer"}}; }
  Json of(std::uint32_t) const { return of(std::uint64_t{}); }
  Json of(std::uint64_t) const { return {{"type", "integer"}, {"minimum", 0}}; }
  Json of(double) const { return {{"type", "number"}}; }
  Json of(const std::string&) const { return {{"type", "string"}}; }
  Json of(const DurationSummary&) const { return {{"$ref", "#/$defs/durations"}}; }
  template <class Value>
  Json of(const std::optional<Value>&) const {
    return {{"anyOf", {of(Value{}), {{"type", "null"}}}}};
  }
  template <class Value>
  Json of(const std::vector<Value>&) const {
    return {{"type", "array"}, {"items", of(Value{})}};
  }
  template <HasFields Result>
  Json of(const Result&) const {
    return object(Result::kFields);
  }
  Json of(const ChainResult& chain) const { return also(object(ChainResult::kFields), "steps", of(chain.steps)); }
  Json of(const StartupResult& startup) const {
    Json schema = also({{"type", "object"}}, "begin_ns", of(startup.begin_ns));
    return also(also(schema, "ready_ns", of(startup.ready_ns)), "critical_path", of(startup.critical_path));
  }
  Json of(const RecordedVerdict& verdict) const {
    const Json schema = also({{"type", "object"}}, "ns_per_event", of(double{}));
    return {{"anyOf", {also(schema, "processes", of(verdict.processes)), {{"type", "null"}}}}};
  }

  static Json also(Json object, const char* key, const Json& schema) {
    object["properties"][key] = schema;
    object["required"].push_back(key);
    return object;
  }
  template <class Result, std::size_t kCount>
  Json object(const Field<Result> (&fields)[kCount]) const {
    Json schema{{"type", "object"}, {"properties", Json::object()}, {"required", Json::array()}};
    const Result result;
    for (const Field<Result>& field : fields) {
      field.member.visit([&](auto member) {
        Json type = of(std::decay_t<decltype(std::invoke(member, result))>{});
        if (!field.member.words().empty()) {
          type = {{"enum", field.member.words()}};
        }
        if (field.has(trait::kProcess)) {
          schema["properties"][vpid_key(field.name)] = of(std::optional<std::int64_t>{});
          schema["required"].push_back(vpid_key(field.name));
        }
        schema["properties"][field.name] = type;
      });
      if (field.when == nullptr) {
        schema["required"].push_back(field.name);
      }
    }
    return schema;
  }
  static Json of(const char*) { return {}; }  // a word

  Json properties_;
};

bool contains(const Json& list, const Json& value) {
  return std::find(list.begin(), list.end(), value) != list.end();
}

// What the file says, brought up to date. A key keeps its place and its limits in the file. A key that is new in an
// object is not required: older reports lack it.
Json updated(const Json& file, const Json& now) {
  if (!file.is_object() || !now.is_object()) {
    return now;
  }
  Json result = file;
  for (const auto& [key, value] : now.items()) {
    if (!file.contains(key)) {
      result[key] = value;
    } else if (key == "properties") {
      result[key] = updated(file[key], value);
      for (const auto& [name, schema] : file[key].items()) {
        if (!value.contains(name)) {
          result[key].erase(name);
        }
      }
    } else if (key == "enum") {
      result[key] = Json::array();
      for (const Json& word : file[key]) {
        if (contains(value, word)) {
          result[key].push_back(word);
        }
      }
      for (const Json& word : value) {
        if (!contains(file[key], word)) {
          result[key].push_back(word);
        }
      }
    } else if (key == "required") {
      for (const Json& name : file[key]) {
        EXPECT_TRUE(!now.contains("properties") || contains(value, name)) << name << " is not in every result";
      }
    } else if (key == "anyOf" && file[key].size() == value.size()) {
      for (std::size_t i = 0; i < value.size(); ++i) {
        result[key][i] = updated(file[key][i], value[i]);
      }
    } else {
      result[key] = updated(file[key], value);
    }
  }
  return result;
}

std::string in_a_line(const Json& json) {
  std::string text;
  const auto add = [&text](const std::string& part) { text += (text.empty() ? "" : ", ") + part; };
  if (json.is_object()) {
    for (const auto& [key, value] : json.items()) {
      add(Json(key).dump() + ": " + in_a_line(value));
    }
    return "{" + text + "}";
  }
  if (json.is_array()) {
    for (const Json& value : json) {
      add(in_a_line(value));
    }
    return "[" + text + "]";
  }
  return json.dump();
}

// A line for each key of a report.
std::string in_lines(const Json& schema) {
  std::string text;
  for (const auto& [key, value] : schema.items()) {
    std::string lines;
    if (key == "properties" || key == "$defs") {
      for (const auto& [name, one] : value.items()) {
        lines += fmt::format("{}    \"{}\": {}", lines.empty() ? "" : ",\n", name, in_a_line(one));
      }
      lines = "{\n" + lines + "\n  }";
    }
    text += fmt::format("{}  \"{}\": {}", text.empty() ? "" : ",\n", key, lines.empty() ? in_a_line(value) : lines);
  }
  return "{\n" + text + "\n}\n";
}

// A table for each structure, in the order of the report.
class Tables {
 public:
  template <HasFields Result>
  void operator()(const char* key, const std::vector<Result>&) {
    section(fmt::format("`{}`", key), Result::kFields);
    if constexpr (std::is_same_v<Result, ChainResult>) {
      section("`steps` of `chains`", ChainResult::Step::kFields);
    }
  }
  void operator()(const char* key, const std::optional<StartupResult>&) {
    section(fmt::format("`critical_path` of `{}`", key), StartStep::kFields);
  }
  void operator()(const char* key, const RecordedVerdict&) {
    section(fmt::format("`processes` of `{}`", key), RecordedVerdict::ProcessCost::kFields);
  }
  template <class Value>
  void operator()(const char*, const Value&) {}

  template <class Result, std::size_t kCount>
  void section(const std::string& title, const Field<Result> (&fields)[kCount]) {
    text_ += fmt::format("\n### {}\n\n| key | value |\n| --- | --- |\n", title);
    for (const Field<Result>& field : fields) {
      if (field.has(trait::kProcess)) {
        text_ += fmt::format("| `{}` | number of the process |\n", vpid_key(field.name));
      }
      std::string help = field.help;
      for (const char* const word : field.member.words()) {
        help += fmt::format("{}`{}`", word == field.member.words().front() ? ": " : ", ", word);
      }
      text_ += fmt::format("| `{}` |{}{} |\n", field.name, help.empty() ? "" : " ", help);
    }
  }
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

std::string text_of(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

void expect_content(const std::filesystem::path& file, const std::string& expected) {
  if (std::getenv("LAUNCH_UPDATE_GOLDEN") != nullptr) {
    std::ofstream(file) << expected;
  }
  EXPECT_EQ(text_of(file), expected) << "LAUNCH_UPDATE_GOLDEN=1 writes it anew";
}

const std::filesystem::path kDocs = DOCS;

TEST(ReportFormat, TheSchemaHasEveryField) {
  const std::filesystem::path file = kDocs / "schema" / "report.schema.json";
  Schema schema;
  visit_report({}, schema);
  const Json now{{"properties", schema.properties()}, {"$defs", {{"durations", schema.durations(kDurationFields)}}}};
  expect_content(file, in_lines(updated(Json::parse(text_of(file)), now)));
}

TEST(ReportFormat, ThePageDescribesEveryField) {
  const std::filesystem::path file = kDocs / "report_format.md";
  const std::string text = text_of(file);
  const std::string begin = "<!-- From the rows of the results. -->\n";
  const std::string end = "\n<!-- End of the rows. -->\n";
  const std::size_t from = text.find(begin) + begin.size();
  Tables tables;
  visit_report({}, tables);
  tables.section("Distributions", kDurationFields);
  expect_content(file, text.substr(0, from) + tables.text() + text.substr(text.find(end)));
}

// The schema of an object with rows, which has their sentences, too.
template <class Result, std::size_t kCount>
void expect_rows(const Json& schema, const Field<Result> (&fields)[kCount]) {
  Json names = Json::array();
  for (const Field<Result>& field : fields) {
    names.push_back(field.name);
    EXPECT_EQ(schema["properties"][field.name].value("description", ""), field.help) << field.name;
  }
  EXPECT_EQ(schema["required"], names);
  EXPECT_EQ(schema["properties"].size(), kCount);
}

TEST(ReportFormat, TheSchemaOfAComparisonHasEveryField) {
  const Json schema = Json::parse(text_of(kDocs / "schema" / "comparison.schema.json"));
  expect_rows(schema["$defs"]["change"], compare::Change::kFields);
  expect_rows(schema["properties"]["overall"]["anyOf"][1], compare::Overall::kFields);
  expect_rows(schema["$defs"]["lone"], compare::Lone::kFields);
  expect_rows(schema["$defs"]["side"]["properties"]["runs"]["items"], compare::RunSummary::kFields);
}

TEST(ReportFormat, ANewFieldGetsAPlaceAtTheEndAndIsNotRequired) {
  const Json file = Json::parse(R"({"properties": {"b": {"type": "number", "maximum": 1}, "gone": {}, "a": {}},
                                    "required": ["b"]})");
  const Json now = Json::parse(R"({"properties": {"a": {"type": "string"}, "b": {"type": "number"}, "c": {}},
                                   "required": ["a", "b", "c"]})");
  EXPECT_EQ(in_a_line(updated(file, now)),
            R"({"properties": {"b": {"type": "number", "maximum": 1}, "a": {"type": "string"}, "c": {}}, )"
            R"("required": ["b"]})");
}

}  // namespace
}  // namespace tracing
