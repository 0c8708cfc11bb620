#include "mechanics/elements/bushing.hpp"

#include "mechanics/assembler.hpp"
#include "mechanics/measurements.hpp"
#include "mechanics/resisting.hpp"

namespace gamut {
namespace {

template <class S>
class BushingLoad final : public Load<S>, public Resisting<S> {
 public:
  struct Numbers {
    Vector3<S> stiffness, damping, angularStiffness, angularDamping;
  };

  BushingLoad(Frame<S>& from, Vector3<S> fromPoint, Frame<S>& to, Vector3<S> toPoint, Numbers numbers)
      : from_(from),
        to_(to),
        fromPoint_(fromPoint),
        toPoint_(toPoint),
        motion_(from, std::move(fromPoint), to, std::move(toPoint)),
        is_(std::move(numbers)) {}

  /// On `to`, at its point, in the axes of `from`.
  Vector3<S> force() const {
    return -(is_.stiffness.cwiseProduct(motion_.position()) + is_.damping.cwiseProduct(motion_.velocity()));
  }
  /// Σ c_i (A e_i) × e_i, and damping.
  Vector3<S> moment() const {
    const Matrix3<S> a = motion_.orientation();
    Vector3<S> sum = -is_.angularDamping.cwiseProduct(motion_.angularVelocity());
    for (int i = 0; i < 3; ++i) {
      Vector3<S> axis = zeroVector<S>();
      axis[i] = S(1.0);
      sum += Vector3<S>(a.col(i)).cross(axis) * turning(i);
    }
    return sum;
  }

  S potentialEnergy(const Vector3<S>&) const override {
    const Vector3<S> x = motion_.position();
    const Matrix3<S> a = motion_.orientation();
    S energy(0.0);
    for (int i = 0; i < 3; ++i)
      energy = energy + S(0.5) * (is_.stiffness[i] * square(x[i])) + turning(i) * (S(1.0) - a(i, i));
    return energy;
  }

  /// Along and about the axes of `from`.
  std::vector<S> resistances() const override {
    std::vector<S> all;
    for (const Vector3<S>* each : {&is_.damping, &is_.angularDamping})
      for (int i = 0; i < 3; ++i) all.push_back((*each)[i]);
    return all;
  }
  void release() override { is_.damping = is_.angularDamping = zeroVector<S>(); }

 private:
  /// c_i.
  S turning(int i) const {
    const Vector3<S>& k = is_.angularStiffness;
    return S(0.5) * (k[(i + 1) % 3] + k[(i + 2) % 3] - k[i]);
  }
  /// Both ends feel it at the same place.
  void applyForce() override {
    const Vector3<S> f = force(), m = moment(), place = motion_.position() + fromPoint_;
    from_.f -= f;
    from_.tau -= m + place.cross(f);
    const auto behind = [this](const Vector3<S>& x) { return Vector3<S>(to_.R.transpose() * Vector3<S>(from_.R * x)); };
    const Vector3<S> local = behind(f);
    to_.f += local;
    to_.tau += behind(m) + toPoint_.cross(local);
  }

  Frame<S>& from_;
  Frame<S>& to_;
  Vector3<S> fromPoint_, toPoint_;
  RelativeMotionOf<S> motion_;
  Numbers is_;
};

}  // namespace

void Bushing::describe(Fields& f) {
  f.frame({"from", "", "the frame at one end"}, from);
  f.otherFrame({"to", "", "the frame at the other end"}, to, from);
  f.vector({"stiffness", "N/m", "along x, y, z of `from`"}, stiffness);
  f.vector({"damping", "N s/m", "along x, y, z of `from`"}, damping);
  f.vector({"angular_stiffness", "N m/rad", "about x, y, z of `from`"}, angularStiffness);
  f.vector({"angular_damping", "N m s/rad", "about x, y, z of `from`"}, angularDamping);
  f.vector({"from_point", "m", "where it sits in `from`"}, fromPoint);
  f.vector({"to_point", "m", "where it sits in `to`"}, toPoint);
  f.drawsSpring({from, fromPoint}, {to, toPoint}, {1.0, 0.0});
  for (const char* component : components) {
    f.measure({std::string("force.") + component, "N", "on `to`, in the axes of `from`"});
    f.measure({std::string("moment.") + component, "N m", "on `to` about its point, in the axes of `from`"});
  }
}

template <class S>
void Bushing::assemble(Assembler<S>& a) const {
  const auto& load = a.template add<BushingLoad<S>>(
      a.frame(from), a.vector(fromPoint), a.frame(to), a.vector(toPoint),
      typename BushingLoad<S>::Numbers{a.vector(stiffness), a.vector(damping), a.vector(angularStiffness),
                                       a.vector(angularDamping)});
  for (int i = 0; i < 3; ++i) {
    const std::string component = components[i];
    a.measure("force." + component, [&load, i] { return S(load.force()[i]); });
    a.measure("moment." + component, [&load, i] { return S(load.moment()[i]); });
  }
}

GAMUT_ASSEMBLE(Bushing)

}  // namespace gamut
