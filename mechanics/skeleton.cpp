// The words of an element say what it is: which frames it joins, whether it moves one, and by what.
#include "mechanics/skeleton.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "mechanics/assembly.hpp"
#include "mechanics/rotation.hpp"
#include "scalars/program/program.hpp"
#include "scalars/recorded.hpp"

namespace gamut {
namespace {

/// What one element says of itself.
class Words final : public Fields {
 public:
  struct NamedFrame {
    std::string key, frame;
  };

  void frame(const Word& word, std::string& name) override { frames.push_back({word.key, name}); }
  void movedFrame(const Word& word, std::string& name, const std::string& /*from*/) override {
    frames.push_back({word.key, name});
    movesFrame = true;
  }
  void carriesMass(const std::string& /*frame*/) override { isMass = true; }
  void choice(const Word&, std::string&, const std::vector<std::string>&) override {}
  void axis(const Word& word, Axis& axis) override { axes.emplace_back(word.key, axis); }
  void rotations(const Word&, std::vector<FixedRotation>&) override {}
  void number(const Word& word, Expression& number) override {
    if (word.key == "mass") mass = number;
    isElastic = isElastic || word.key == "stiffness" || word.key == "damping";
  }
  void numbers(const Word& word, std::span<Expression> numbers, std::span<const char* const> names,
               std::size_t) override {
    if (word.unit == "m" && std::ranges::equal(names, components))
      vectors.emplace_back(word.key, ExpressionVector{numbers[0], numbers[1], numbers[2]});
    isElastic = isElastic || word.key == "stiffness" || word.key == "damping";
  }
  void coordinate(const Word&, Expression&, Coordinate, const Word& rate, Expression&) override { count(rate); }
  void position(const Word&, Expression&) override {}
  void speed(const Word& word, Expression&) override { count(word); }
  std::string state(const Word& word, Expression&) override { return word.unit; }
  Coordinate coordinateOf(const Word&, std::string&) override { return Coordinate::angle; }
  void timeFunction(const Word&, Expression&) override {}
  void signal(const Word&, Expression&) override {}
  void signals(const Word&, ExpressionVector&) override {}
  void measure(const Word&) override {}

  /// A vector by its key; zero where there is none.
  ExpressionVector vector(const std::string& key) const {
    for (const auto& [name, vector] : vectors)
      if (name == key) return vector;
    return {0.0, 0.0, 0.0};
  }

  std::vector<NamedFrame> frames;
  std::vector<std::pair<std::string, Axis>> axes;
  std::vector<std::pair<std::string, ExpressionVector>> vectors;
  std::optional<Expression> mass;
  int turns = 0, slides = 0;
  bool movesFrame = false, isMass = false, isElastic = false;

 private:
  void count(const Word& speed) { ++(speed.unit == "rad/s" ? turns : slides); }
};

class Finder {
 public:
  explicit Finder(const Mechanism& mechanism) {
    for (Described element : mechanism.elements()) take(element);
  }

  Skeleton skeleton;

 private:
  void take(Described& element) {
    Words words;
    element.describe(words);
    using enum Skeleton::Kind;
    const std::string& name = element.name();
    Skeleton::Part part{name, element.type(), rigid, 0, 0, words.turns, words.slides};
    if (words.isMass && !words.frames.empty()) {
      part.kind = mass;
      part.mass = words.mass.value_or(Expression(0.0));
      part.from = pointOf(words.frames[0].frame);
      part.to = pointOf(words.frames[0].frame, name + ".centre", words.vector("centre"));
    } else if (words.frames.size() != 2) {
      return;
    } else if (words.movesFrame) {
      if (words.turns + words.slides > 0)
        part.kind = joint;
      else if (std::ranges::count(ground_, words.frames[0].frame) > 0)
        ground_.push_back(words.frames[1].frame);
      part.from = pointOf(words.frames[0].frame);
      part.to = pointOf(words.frames[1].frame);
    } else if (words.isElastic && words.axes.empty()) {  // no contact, which has a normal
      part.kind = spring;
      const auto end = [&](const Words::NamedFrame& of) {
        return pointOf(of.frame, name + "." + of.key, words.vector(of.key + "_point"));
      };
      part.from = end(words.frames[0]);
      part.to = end(words.frames[1]);
    } else {
      return;
    }
    if (part.kind == joint)
      for (std::size_t i = 0; i < words.axes.size(); ++i)  // of two hinges the second is fixed in what they move
        skeleton.axes.push_back({name + "." + words.axes[i].first, skeleton.parts.size(),
                                 words.frames[i == 0 ? 0 : 1].frame, words.axes[i].second});
    skeleton.parts.push_back(std::move(part));
  }

  std::size_t pointOf(const std::string& frame) {
    const auto found = std::ranges::find(skeleton.points, frame, &Skeleton::Point::name);
    if (found == skeleton.points.end()) return pointOf(frame, frame, {0.0, 0.0, 0.0});
    return static_cast<std::size_t>(found - skeleton.points.begin());
  }
  std::size_t pointOf(const std::string& frame, const std::string& name, const ExpressionVector& offset) {
    skeleton.points.push_back({name, frame, offset, false, std::ranges::count(ground_, frame) > 0});
    return skeleton.points.size() - 1;
  }

  std::vector<std::string> ground_{Mechanism::inertialFrame};  // frames
};

/// x, y, z of every vector that `vectorOf` makes of what is in the list.
template <class S, class List, class VectorOf>
std::vector<S> componentsOf(const List& list, const VectorOf& vectorOf) {
  std::vector<S> all;
  for (const auto& one : list) {
    const Vector3<S> vector = vectorOf(one);
    for (int i = 0; i < 3; ++i) all.push_back(vector[i]);
  }
  return all;
}

template <class S>
MovingPoint<S> movingPoint(const Assembly<S>& assembly, const Skeleton::Point& point) {
  Vector3<S> offset;
  for (int i = 0; i < 3; ++i) offset[i] = assembly.number(point.offset[static_cast<std::size_t>(i)]);
  return assembly.frame(point.frame).inInertial({offset, zeroVector<S>()});
}

/// Points of the same nodes in the recorded program are one.
void join(Skeleton& skeleton, const Program& positions) {
  std::vector<Skeleton::Point> points;
  std::vector<std::vector<int>> known;
  std::vector<std::size_t> place;
  for (std::size_t i = 0; i < skeleton.points.size(); ++i) {
    const auto begin = positions.outputNodes().begin() + static_cast<std::ptrdiff_t>(3 * i);
    const std::vector<int> nodes(begin, begin + 3);
    const auto found = std::ranges::find(known, nodes);
    place.push_back(static_cast<std::size_t>(found - known.begin()));
    if (found != known.end()) {
      Skeleton::Point& first = points[place.back()];
      first.isGround = first.isGround || skeleton.points[i].isGround;
      continue;
    }
    known.push_back(nodes);
    points.push_back(skeleton.points[i]);
    points.back().isFixed = std::ranges::all_of(nodes, [&](int node) { return positions.isInvariant(node); });
  }
  skeleton.points = std::move(points);
  for (Skeleton::Part& part : skeleton.parts) part.from = place[part.from], part.to = place[part.to];
}

}  // namespace

Skeleton skeletonOf(const Mechanism& mechanism, const std::vector<std::string>& freeParameters) {
  Skeleton skeleton = Finder(mechanism).skeleton;
  if (skeleton.points.empty()) return skeleton;
  const int states = static_cast<int>(mechanism.stateNames().size()),
            parameters = static_cast<int>(freeParameters.size());
  join(skeleton, record(states, parameters, static_cast<int>(3 * skeleton.points.size()),
                        [&](auto t, const auto& x, const auto& p, auto& y) {
                          Assembly<Recorded> assembly(mechanism, freeParameters, p);
                          assembly.setMotion(x, t);
                          std::ranges::copy(positionsOf(assembly, skeleton), y.begin());
                        }));
  return skeleton;
}

template <class S>
std::vector<S> positionsOf(const Assembly<S>& assembly, const Skeleton& skeleton) {
  return componentsOf<S>(skeleton.points, [&](const auto& point) { return movingPoint(assembly, point).position; });
}

template <class S>
std::vector<S> velocitiesOf(const Assembly<S>& assembly, const Skeleton& skeleton) {
  return componentsOf<S>(skeleton.points, [&](const auto& point) { return movingPoint(assembly, point).velocity; });
}

template <class S>
std::vector<S> axesOf(const Assembly<S>& assembly, const Skeleton& skeleton) {
  return componentsOf<S>(skeleton.axes, [&](const Skeleton::JointAxis& of) -> Vector3<S> {
    return assembly.frame(of.frame).R * of.axis.unit<S>();
  });
}

#define GAMUT_COMPILE_FUNCTION(FUNCTION, S) template std::vector<S> FUNCTION(const Assembly<S>&, const Skeleton&);
GAMUT_FOR_EVERY_SCALAR(GAMUT_COMPILE_FUNCTION, positionsOf)
GAMUT_FOR_EVERY_SCALAR(GAMUT_COMPILE_FUNCTION, velocitiesOf)
GAMUT_FOR_EVERY_SCALAR(GAMUT_COMPILE_FUNCTION, axesOf)

}  // namespace gamut
