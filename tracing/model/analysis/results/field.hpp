// SPDX-License-Identifier: Apache-2.0
// The fields of a result, a row for each. Every output for programs comes from these rows: the JSON of the report and
// its schema, the facts of the page, the tables of CSV and SQL, and what docs/report_format.md says.
//
// A structure of results has a table kFields below it, in the order of the output:
//
//   inline constexpr Field<NodeResult> NodeResult::kFields[] = {
//       {"name", &NodeResult::name, "its full name"},
//       {"callback_ns", &NodeResult::callback_ns, "time in callbacks"},
//   };
//
// An output goes through the rows and asks each one for its value:
//
//   for (const Field<NodeResult>& field : NodeResult::kFields) {
//     field.member.visit([&](auto member) { json[field.name] = json_of(std::invoke(member, result)); });
//   }
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "tracing/model/execution/duration_statistics.hpp"

namespace tracing {

// Where a value comes from: a member of one of these types, or a function without arguments. (A std::variant would do
// the same, but takes seconds to compile in every file that sees results.)
template <class Result>
class Member {
 public:
  using Words = std::span<const char* const>;

  constexpr Member(bool Result::*of) : type_(Type::kFlag), flag_(of) {}
  constexpr Member(std::uint32_t Result::*of) : type_(Type::kSmall), small_(of) {}
  constexpr Member(std::uint64_t Result::*of) : type_(Type::kCount), count_(of) {}
  constexpr Member(std::int64_t Result::*of) : type_(Type::kInteger), integer_(of) {}
  constexpr Member(double Result::*of) : type_(Type::kNumber), number_(of) {}
  constexpr Member(std::string Result::*of) : type_(Type::kText), text_(of) {}
  constexpr Member(DurationSummary Result::*of) : type_(Type::kDurations), durations_(of) {}
  constexpr Member(std::optional<std::uint64_t> Result::*of) : type_(Type::kMaybeCount), maybe_count_(of) {}
  constexpr Member(std::optional<std::int64_t> Result::*of) : type_(Type::kMaybeInteger), maybe_integer_(of) {}
  constexpr Member(std::optional<double> Result::*of) : type_(Type::kMaybeNumber), maybe_number_(of) {}
  constexpr Member(std::vector<std::uint64_t> Result::*of) : type_(Type::kCounts), counts_(of) {}
  constexpr Member(std::vector<std::string> Result::*of) : type_(Type::kTexts), texts_(of) {}
  constexpr Member(double (Result::*of)() const) : type_(Type::kNumberOf), number_of_(of) {}
  constexpr Member(std::string (Result::*of)() const) : type_(Type::kTextOf), text_of_(of) {}
  // One of these words.
  constexpr Member(const char* (Result::*of)() const, Words words)
      : type_(Type::kWordOf), word_of_(of), words_(words) {}

  // Calls use(member). std::invoke(member, result) is the value of a result.
  template <class Use>
  void visit(const Use& use) const {
    switch (type_) {
      case Type::kFlag:
        return use(flag_);
      case Type::kSmall:
        return use(small_);
      case Type::kCount:
        return use(count_);
      case Type::kInteger:
        return use(integer_);
      case Type::kNumber:
        return use(number_);
      case Type::kText:
        return use(text_);
      case Type::kDurations:
        return use(durations_);
      case Type::kMaybeCount:
        return use(maybe_count_);
      case Type::kMaybeInteger:
        return use(maybe_integer_);
      case Type::kMaybeNumber:
        return use(maybe_number_);
      case Type::kCounts:
        return use(counts_);
      case Type::kTexts:
        return use(texts_);
      case Type::kNumberOf:
        return use(number_of_);
      case Type::kTextOf:
        return use(text_of_);
      case Type::kWordOf:
        return use(word_of_);
    }
  }

  bool is_text() const { return type_ == Type::kText; }
  // The text that a result holds; nullptr if the value is none.
  std::string* text_in(Result& result) const { return is_text() ? &(result.*text_) : nullptr; }
  bool is_list() const { return type_ == Type::kCounts || type_ == Type::kTexts; }
  // All that the value may be; empty if it is no word.
  Words words() const { return words_; }

 private:
  enum class Type {
    kFlag,
    kSmall,
    kCount,
    kInteger,
    kNumber,
    kText,
    kDurations,
    kMaybeCount,
    kMaybeInteger,
    kMaybeNumber,
    kCounts,
    kTexts,
    kNumberOf,
    kTextOf,
    kWordOf
  };
  Type type_;
  union {
    bool Result::*flag_;
    std::uint32_t Result::*small_;
    std::uint64_t Result::*count_;
    std::int64_t Result::*integer_;
    double Result::*number_;
    std::string Result::*text_;
    DurationSummary Result::*durations_;
    std::optional<std::uint64_t> Result::*maybe_count_;
    std::optional<std::int64_t> Result::*maybe_integer_;
    std::optional<double> Result::*maybe_number_;
    std::vector<std::uint64_t> Result::*counts_;
    std::vector<std::string> Result::*texts_;
    double (Result::*number_of_)() const;
    std::string (Result::*text_of_)() const;
    const char* (Result::*word_of_)() const;
  };
  Words words_;
};

// What outputs must know of a field beside its type.
namespace trait {
enum Trait : unsigned {
  kPlain = 0,
  kTime = 1,         // a point in time; on the page since the begin of the timeline
  kProcess = 2,      // an index in TraceOverview::processes: JSON has its vpid beside it, the page leaves it out
  kNotOnPage = 4,    // nor are lists
  kNotInTables = 8,  // of CSV and SQL
};
}  // namespace trait

template <class Result>
struct Field {
  const char* name;  // durations end with _ns; the page leaves this out
  Member<Result> member;
  const char* help;  // for docs/report_format.md; empty: the name says it all
  unsigned traits = trait::kPlain;
  bool (Result::*when)() const = nullptr;  // whether a result has the field; nullptr: each one has

  bool is_in(const Result& result) const { return when == nullptr || (result.*when)(); }
  bool has(unsigned wanted) const { return (traits & wanted) != 0; }
};

// The part of a distribution. All but `count` have no meaning when it is 0.
inline constexpr Field<DurationSummary> kDurationFields[] = {
    {"count", &DurationSummary::count, ""},
    {"mean_ns", &DurationSummary::mean_ns, "with decimals"},
    {"stddev_ns", &DurationSummary::stddev_ns, "of the sample, with decimals", trait::kNotOnPage},
    {"min_ns", &DurationSummary::min_ns, "", trait::kNotOnPage},
    {"p50_ns", &DurationSummary::p50_ns, "nearest rank: the smallest value that at least half of all don't exceed"},
    {"p90_ns", &DurationSummary::p90_ns, ""},
    {"p99_ns", &DurationSummary::p99_ns, ""},
    {"p999_ns", &DurationSummary::p999_ns, "99.9 %", trait::kNotOnPage},
    {"p9999_ns", &DurationSummary::p9999_ns, "99.99 %", trait::kNotOnPage},
    {"max_ns", &DurationSummary::max_ns, ""},
    {"percentiles_are_exact", &DurationSummary::percentiles_are_exact,
     "false above 4,096 values; the percentiles are then exact to 0.2 %", trait::kNotOnPage},
};

// "vpid" beside the "process" that is an index.
inline std::string vpid_key(std::string process_key) {
  return process_key.replace(process_key.rfind("process"), std::string::npos, "vpid");
}

// A structure with rows.
template <class Result>
concept HasFields = requires { Result::kFields; };

}  // namespace tracing
