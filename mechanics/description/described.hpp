// A Described holds the description of an element of any type, by value. A type is any struct with
//
//   static constexpr const char* type = "drag";          its word in files
//   static constexpr const char* summary = "air drag …"; half a sentence
//   std::string name;
//   void describe(Fields& f);                             what it consists of
//   template <class S> void assemble(Assembler<S>& a) const;
//
// and, if some values make no sense, `std::vector<Fault> faults(const RangeOf& rangeOf) const`; if a range of values
// makes none that a single value would not, `doubts(const RangeOf& nominal, const RangeOf& range) const` likewise. Its
// assembly for every scalar is compiled where it is instantiated: for own types where they become a Described, for
// those of the library once, by GAMUT_ASSEMBLE in their own file. These have `static constexpr int order` too, their
// place in the documentation, by which elements/all.* list them, and, where URDF has such joints, its words in `urdf`.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "mechanics/description/fields.hpp"
#include "mechanics/scalars.hpp"

namespace gamut {

template <class S>
class Assembler;

/// The range of a number within what is known of its parameters.
using RangeOf = std::function<Interval(const Expression& number)>;

/// What is wrong with the numbers of an element.
struct Fault {
  std::string key;       ///< of the number
  std::string sentence;  ///< "the mass of 'bob' is negative"
  std::string expected;  ///< "a mass of at least 0 kg"
  bool isFatal = false;  ///< what would be computed for such values is not what they say
};

class Described {
 public:
  template <class T>
  requires requires(T element, Fields& fields) { element.describe(fields), element.name, T::type; }
  Described(T element) : model_(std::make_unique<Model<T>>(std::move(element))) {}  // NOLINT(google-explicit-*): is one
  Described(const Described& other) : model_(other.model_->clone()) {}
  Described(Described&&) noexcept = default;
  Described& operator=(Described other) noexcept {
    model_ = std::move(other.model_);
    return *this;
  }
  ~Described() = default;

  std::string type() const { return model_->type(); }
  std::string summary() const { return model_->summary(); }
  /// Types of joints in URDF files that it is; most are none.
  std::vector<std::string> urdfTypes() const { return model_->urdfTypes(); }
  const std::string& name() const { return model_->name(); }
  void setName(std::string name) { model_->name() = std::move(name); }
  /// The element itself, if it is a T, else null.
  template <class T>
  const T* as() const {
    const auto* model = dynamic_cast<const Model<T>*>(model_.get());
    return model == nullptr ? nullptr : &model->element;
  }
  void describe(Fields& fields) { model_->describe(fields); }
  template <class S>
  void assemble(Assembler<S>& assembler) const {
    model_->assemble(assembler);
  }
  std::vector<Fault> faults(const RangeOf& rangeOf) const { return model_->faults(rangeOf); }
  std::vector<Fault> doubts(const RangeOf& nominal, const RangeOf& range) const {
    return model_->doubts(nominal, range);
  }

 private:
  struct Concept {
    virtual ~Concept() = default;
    virtual std::unique_ptr<Concept> clone() const = 0;
    virtual std::string type() const = 0;
    virtual std::string summary() const = 0;
    virtual std::vector<std::string> urdfTypes() const = 0;
    virtual std::string& name() = 0;
    virtual void describe(Fields& fields) = 0;
#define GAMUT_ASSEMBLED_BY(FUNCTION, SCALAR) virtual void FUNCTION(Assembler<SCALAR>& assembler) const = 0;
    GAMUT_FOR_EVERY_SCALAR(GAMUT_ASSEMBLED_BY, assemble)
#undef GAMUT_ASSEMBLED_BY
    virtual std::vector<Fault> faults(const RangeOf& rangeOf) const = 0;
    virtual std::vector<Fault> doubts(const RangeOf& nominal, const RangeOf& range) const = 0;
  };

  template <class T>
  struct Model final : Concept {
    explicit Model(T own) : element(std::move(own)) {}
    std::unique_ptr<Concept> clone() const override { return std::make_unique<Model>(element); }
    std::string type() const override { return T::type; }
    std::string summary() const override { return T::summary; }
    std::vector<std::string> urdfTypes() const override {
      if constexpr (requires { T::urdf; }) return {T::urdf.begin(), T::urdf.end()};
      return {};
    }
    std::string& name() override { return element.name; }
    void describe(Fields& fields) override { element.describe(fields); }
#define GAMUT_ASSEMBLED_BY(FUNCTION, SCALAR) \
  void FUNCTION(Assembler<SCALAR>& assembler) const override { element.FUNCTION(assembler); }
    GAMUT_FOR_EVERY_SCALAR(GAMUT_ASSEMBLED_BY, assemble)
#undef GAMUT_ASSEMBLED_BY
    std::vector<Fault> faults(const RangeOf& rangeOf) const override {
      if constexpr (requires { element.faults(rangeOf); }) return element.faults(rangeOf);
      return {};
    }
    std::vector<Fault> doubts(const RangeOf& nominal, const RangeOf& range) const override {
      if constexpr (requires { element.doubts(nominal, range); }) return element.doubts(nominal, range);
      return {};
    }
    T element;
  };

  std::unique_ptr<Concept> model_;
};

}  // namespace gamut

/// Compiles the assembly of an element type of the library for every scalar.
#define GAMUT_ASSEMBLE(Type) GAMUT_FOR_EVERY_SCALAR(GAMUT_ASSEMBLE_FOR, Type)
#define GAMUT_ASSEMBLE_FOR(Type, SCALAR) template void Type::assemble(Assembler<SCALAR>&) const;
