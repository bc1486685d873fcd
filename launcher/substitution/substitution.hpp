// SPDX-License-Identifier: Apache-2.0
// Substitutions: the $(…) of launch files, parsed at load and performed at visit.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/diagnostics/diagnostic.hpp"
#include "base/diagnostics/source.hpp"
#include "launcher/substitution/scope.hpp"

namespace launch {

class Substitution {
 public:
  explicit Substitution(SourceRange where) : where_(std::move(where)) {}
  virtual ~Substitution() = default;

  // The text that stands for this substitution now. Throws LaunchError pointing at where().
  virtual std::string perform(Scope& scope) const = 0;

  // As `ros2 launch --show-args` prints it: 'text', EnvVar('HOME'), LaunchConfig('x').
  virtual std::string describe() const = 0;

  const SourceRange& where() const { return where_; }

 private:
  SourceRange where_;
};

using SubstitutionPtr = std::shared_ptr<const Substitution>;

// Literal text, already unescaped.
class Text : public Substitution {
 public:
  Text(std::string text, SourceRange where) : Substitution(std::move(where)), text_(std::move(text)) {}
  std::string perform(Scope&) const override { return text_; }
  std::string describe() const override;
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

// A parsed template: literal runs and substitutions in order, pasted together when performed. Copies share their parts.
class Template {
 public:
  Template() = default;
  Template(std::vector<SubstitutionPtr> parts, SourceRange where);
  // Literal text, already unescaped: what most templates are.
  Template(std::string literal, SourceRange where);

  std::string perform(Scope& scope) const;
  // The parts joined by " + "; '' when empty.
  std::string describe() const;

  // True when it holds no substitution but literal text.
  bool is_literal() const;
  bool empty() const { return body_ == nullptr || (!body_->literal && body_->parts.empty()); }
  std::vector<SubstitutionPtr> parts() const;
  const SourceRange& where() const;

 private:
  struct Body {
    std::optional<std::string> literal;  // instead of parts
    std::vector<SubstitutionPtr> parts;
    SourceRange where;
  };
  std::shared_ptr<const Body> body_;
};

}  // namespace launch
