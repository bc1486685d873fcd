// SPDX-License-Identifier: Apache-2.0
#include "launcher/language/setting.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <limits>
#include <sstream>
#include <type_traits>

#include "base/diagnostics/diagnostic.hpp"

namespace launch {

namespace {

template <typename Value>
struct WithoutOptional {
  using Type = Value;
};
template <typename Value>
struct WithoutOptional<std::optional<Value>> {
  using Type = Value;
};
template <typename Pointer>
using ValueAt = typename WithoutOptional<std::remove_pointer_t<Pointer>>::Type;

using Duration = std::chrono::nanoseconds;

template <typename Value>
constexpr bool kIsCount = std::is_unsigned_v<Value> && !std::is_same_v<Value, bool>;
template <typename Value>
constexpr bool kIsFromZero =
    kIsCount<Value> || std::is_same_v<Value, Duration> || std::is_same_v<Value, NumberFromZero>;

template <typename Value>
Value to_value(double number) {
  if constexpr (std::is_same_v<Value, std::uint32_t>) {
    return static_cast<Value>(std::min<double>(number, std::numeric_limits<Value>::max()));
  } else if constexpr (std::is_same_v<Value, Duration>) {
    return as_duration(number);
  } else {
    return static_cast<Value>(number);
  }
}

std::size_t read_choice(const AttributeSpec& attribute, const Fields& fields, Scope& scope,
                        const std::vector<std::string>& words) {
  const Template& text = fields.text(attribute.name);
  const std::string given = text.perform(scope);
  const auto found = std::find(words.begin(), words.end(), given);
  if (found == words.end()) {
    throw LaunchError(fmt::format("{} is expected to be {}, got '{}'", attribute.name, fmt::join(words, " or "), given),
                      text.where());
  }
  return static_cast<std::size_t>(found - words.begin());
}

}  // namespace

Duration as_duration(double seconds) {
  return std::chrono::duration_cast<Duration>(std::chrono::duration<double>(seconds));
}

void check_setting(const AttributeSpec& attribute, const Fields& fields, const SettingPlace& place) {
  std::visit(
      [&](const auto& at) {
        if constexpr (kIsFromZero<ValueAt<std::decay_t<decltype(at)>>>) {
          fields.number(attribute.name)->require_not_negative();
        }
      },
      place);
}

bool is_literal(const AttributeSpec& attribute, const Fields& fields) {
  return attribute.type == AttributeType::kLiteral || fields.text(attribute.name).is_literal();
}

void perform_setting(const AttributeSpec& attribute, const Fields& fields, Scope& scope, const SettingPlace& place) {
  std::visit(
      [&](const auto& at) {
        using Place = std::decay_t<decltype(at)>;
        using Read = ValueAt<Place>;
        if constexpr (std::is_same_v<Place, SettingChoice>) {
          at.choose(read_choice(attribute, fields, scope, at.words));
        } else if constexpr (std::is_same_v<Read, bool>) {
          *at = fields.boolean(attribute.name, false).perform(scope);
        } else if constexpr (std::is_same_v<Read, std::string>) {
          *at = attribute.type == AttributeType::kLiteral ? fields.literal(attribute.name)
                                                          : fields.text(attribute.name).perform(scope);
        } else if constexpr (std::is_same_v<Read, std::vector<std::string>>) {
          *at = perform_names(fields, attribute.name, scope);
        } else {
          NumberField field = *fields.number(attribute.name);
          if constexpr (kIsFromZero<Read>) {
            field.require_not_negative();
          }
          const double number = field.perform(scope);
          if constexpr (std::is_same_v<Place, NumberFromZero>) {
            *at.number = number;
          } else {
            *at = to_value<Read>(number);
          }
        }
      },
      place);
}

SettingValue shown_value(const SettingPlace& place) {
  return std::visit(
      [](const auto& at) -> SettingValue {
        using Place = std::decay_t<decltype(at)>;
        using Shown = std::remove_pointer_t<Place>;
        if constexpr (std::is_same_v<Place, SettingChoice>) {
          return at.words[at.chosen];
        } else if constexpr (std::is_same_v<Place, NumberFromZero>) {
          return shown_value(at.number);
        } else if constexpr (!std::is_same_v<Shown, ValueAt<Place>>) {  // optional
          return *at ? shown_value(&**at) : SettingValue(std::string());
        } else if constexpr (std::is_same_v<Shown, double>) {
          return fmt::format("{}", *at);
        } else if constexpr (std::is_same_v<Shown, Duration>) {
          return fmt::format("{}", std::chrono::duration<double>(*at).count());
        } else if constexpr (std::is_integral_v<Shown> && !std::is_same_v<Shown, bool>) {
          return static_cast<std::int64_t>(*at);
        } else {
          return *at;
        }
      },
      place);
}

std::vector<std::string> perform_words(const Fields& fields, std::string_view attribute, Scope& scope) {
  std::vector<std::string> performed;
  for (const Template& word : fields.words(attribute)) {
    if (std::string text = word.perform(scope); !text.empty()) {
      performed.push_back(std::move(text));
    }
  }
  return performed;
}

std::vector<std::string> split_names(const std::string& text) {
  std::istringstream words(text);
  return {std::istream_iterator<std::string>(words), std::istream_iterator<std::string>()};
}

std::vector<std::string> perform_names(const Fields& fields, std::string_view attribute, Scope& scope) {
  std::vector<std::string> names;
  for (const std::string& text : perform_words(fields, attribute, scope)) {
    std::ranges::move(split_names(text), std::back_inserter(names));
  }
  return names;
}

}  // namespace launch
