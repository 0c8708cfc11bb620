#include "mechanics/elements/distance.hpp"

#include "mechanics/assembler.hpp"
#include "mechanics/springs.hpp"

namespace gamut {
namespace {

template <class S>
class Distancemeter final : public Load<S> {
 public:
  explicit Distancemeter(Chord<S> chord) : chord_(std::move(chord)) {}
  void doMotion(MotionLevel level = MotionLevel::all) override { chord_.doMotion(level); }
  const Chord<S>& chord() const { return chord_; }

 private:
  void applyForce() override {}
  Chord<S> chord_;
};

}  // namespace

void Distance::describe(Fields& f) {
  f.frame({"from", "", "the frame at one end"}, from);
  f.otherFrame({"to", "", "the frame at the other end"}, to, from);
  f.vector({"from_point", "m", "a point in `from`"}, fromPoint);
  f.vector({"to_point", "m", "a point in `to`"}, toPoint);
  f.measureLength({"length", "m", "the distance of the points"});
  f.measure({"rate", "m/s", "at which it grows"});
}

template <class S>
void Distance::assemble(Assembler<S>& a) const {
  Chord<S> chord(a.frame(from), a.vector(fromPoint), a.frame(to), a.vector(toPoint));
  const auto& meter = a.template add<Distancemeter<S>>(std::move(chord));
  a.measure("length", [&meter] { return meter.chord().length(); });
  a.measure("rate", [&meter] { return meter.chord().rate(); });
}

GAMUT_ASSEMBLE(Distance)

}  // namespace gamut
