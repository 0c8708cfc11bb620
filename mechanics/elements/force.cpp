// With d the point and A = Rᵀ, or 1 for components in the frame:  f += A F,  τ += A M + d × A F.
#include "mechanics/elements/force.hpp"

#include "mechanics/assembler.hpp"

namespace gamut {
namespace {

template <class S>
using SignalVector = std::array<Signal<S>, 3>;

template <class S>
class FrameLoad final : public Load<S> {
 public:
  FrameLoad(Frame<S>& at, Vector3<S> point, bool isInFrame, SignalVector<S> force, SignalVector<S> moment)
      : at_(at),
        point_(std::move(point)),
        isInFrame_(isInFrame),
        force_(std::move(force)),
        moment_(std::move(moment)) {}

  S power() const { return present(force_).dot(at_.v + at_.omega.cross(point_)) + present(moment_).dot(at_.omega); }

 private:
  Vector3<S> present(const SignalVector<S>& signals) const {
    const Vector3<S> given(signals[0](), signals[1](), signals[2]());
    return isInFrame_ ? given : Vector3<S>(at_.R.transpose() * given);
  }
  void applyForce() override {
    const Vector3<S> force = present(force_);
    at_.f += force;
    at_.tau += present(moment_) + point_.cross(force);
  }

  Frame<S>& at_;
  Vector3<S> point_;
  bool isInFrame_;
  SignalVector<S> force_, moment_;
};

}  // namespace

void Force::describe(Fields& f) {
  f.frame({"at", "", "the frame that it acts on"}, at);
  f.signals({"force", "N", ""}, force);
  f.signals({"moment", "N m", ""}, moment);
  f.vector({"point", "m", "where the force acts, in `at`"}, point);
  f.choice({"in", "", "whose axes the components have: `\"inertial\"` (unless given) or `\"frame\"`, those of `at`"},
           in, {"inertial", "frame"});
  f.measure({"power", "W", "that it brings in"});
}

template <class S>
void Force::assemble(Assembler<S>& a) const {
  const auto signals = [&](const ExpressionVector& v) {
    return SignalVector<S>{a.signal(v[0]), a.signal(v[1]), a.signal(v[2])};
  };
  const auto& load =
      a.template add<FrameLoad<S>>(a.frame(at), a.vector(point), in == "frame", signals(force), signals(moment));
  a.measure("power", [&load] { return load.power(); });
}

GAMUT_ASSEMBLE(Force)

}  // namespace gamut
