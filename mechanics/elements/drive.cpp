// q = s(t), q̇ = s'(t), q̈ = s''(t): ahead of the joint, so that motion passes on through it.
#include "mechanics/elements/drive.hpp"

#include "mechanics/assembler.hpp"
#include "mechanics/spline.hpp"

namespace gamut {
namespace {

template <class S>
class PrescribedMotion final : public Load<S> {
 public:
  PrescribedMotion(Variable<S>& variable, TimeFunction<S> motion) : variable_(variable), motion_(std::move(motion)) {}

  void doMotion(MotionLevel level = MotionLevel::all) override {
    if (level == MotionLevel::acceleration) {
      variable_.acceleration = S(0.0);  // J u̇ is what speeds of the system bring about
      return;
    }
    const auto [position, rate, acceleration] = motion_();
    variable_.position = position;
    variable_.rate = rate;
    variable_.acceleration = acceleration;
  }

 private:
  void applyForce() override {}

  Variable<S>& variable_;
  TimeFunction<S> motion_;
};

/// Of a motion that slides.
void describeProfile(Fields& f, const std::string& joint, DrivenProfile& profile) {
  f.number(
      {"profile_speed", "m/s",
       "only of a joint that slides, alone and across `along`: its motion is the height of a profile, such as a road, "
       "over which the machine goes at this speed, and which its picture shows; no motion depends on that. 0, none, "
       "unless given"},
      profile.speed);
  f.axis({"along", "",
          "in which the machine goes over the profile, in the frame that carries the joint; `\"x\"` "
          "unless given"},
         profile.along);
  f.drawsProfile(joint, profile.speed, profile.along);
}

void describeNeeds(Fields& f, Coordinate kind) {
  f.measureSolved({"force", forceUnitOf(kind), "that it needs, in the direction in which the coordinate grows"});
  f.measureSolved({"power", "W", "that it brings in"});
}

/// All other forces on the coordinate, those of inertia among them, are held.
template <class S>
void addDrive(Assembler<S>& a, const std::string& joint, TimeFunction<S> motion) {
  const Variable<S>& driven = a.coordinate(joint);
  a.template addGiven<PrescribedMotion<S>>(a.coordinate(joint), std::move(motion));
  a.measureSolved("force", [&driven] { return S(-driven.force); });
  a.measureSolved("power", [&driven] { return S(-driven.force * driven.rate); });
}

}  // namespace

void Drive::describe(Fields& f) {
  const Coordinate kind = f.drivenCoordinate({"joint", "", "the joint, or one of its coordinates"}, joint);
  f.timeFunction({"position", unitOf(kind), "at time `t`", true}, position);
  describeProfile(f, joint, profile);
  describeNeeds(f, kind);
}

template <class S>
void Drive::assemble(Assembler<S>& a) const {
  addDrive(a, joint, a.timeFunction(position));
}

void TableDrive::describe(Fields& f) {
  const Coordinate kind = f.drivenCoordinate({"joint", "", "the joint, or one of its coordinates"}, joint);
  f.table(
      {"file", "", "beside the study; its first row names the columns, its first column is time in s", true},
      {"column", unitOf(kind), "that holds the positions; a unit may follow its name in the file: `hip [deg]`", true},
      kind, table);
  describeProfile(f, joint, profile);
  describeNeeds(f, kind);
}

template <class S>
void TableDrive::assemble(Assembler<S>& a) const {
  addDrive<S>(a, joint, [&time = a.time(), spline = CubicSpline(table)] { return spline.at(time); });
}

GAMUT_ASSEMBLE(Drive)
GAMUT_ASSEMBLE(TableDrive)

}  // namespace gamut
