// Substitutions: the $(…) of launch files, parsed at load and performed at visit.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "launcher/base/diagnostic.hpp"
#include "launcher/base/source.hpp"
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

// A parsed template: literal runs and substitutions in order, pasted together when performed. Cheap to copy.
class Template {
 public:
  Template() = default;
  Template(std::vector<SubstitutionPtr> parts, SourceRange where)
      : parts_(std::move(parts)), where_(std::move(where)) {}

  std::string perform(Scope& scope) const;
  // The parts joined by " + "; '' when empty.
  std::string describe() const;

  // True when it holds no substitution but literal text.
  bool is_literal() const;
  bool empty() const { return parts_.empty(); }
  const std::vector<SubstitutionPtr>& parts() const { return parts_; }
  const SourceRange& where() const { return where_; }

 private:
  std::vector<SubstitutionPtr> parts_;
  SourceRange where_;
};

}  // namespace launch
