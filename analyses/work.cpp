#include "analyses/work.hpp"

namespace gamut {

// Measured in 2026 on one core of a machine with vectors of eight doubles, on the studies of studies/examples/: the CPU
// time of what is counted (perf), divided by the count; of transforms, bins and samples that of whole stages. They are
// right to some 30 %, of edges and of samples to a factor.
const double Work::unitsOf[kinds] = {
    2.6,    // convolvedRow
    3.0,    // seriesProduct
    1.0,    // multipliedPair
    1.6,    // coefficient
    25.0,   // boundedNode
    1.0,    // matrixTerm
    0.06,   // columnTerm
    2.2,    // rangeTerm
    3.0,    // cellTerm
    1.0,    // transformed
    10.0,   // bin
    40.0,   // focalElement
    450,    // quickEdge
    2e4,    // preciseEdge
    2.4e5,  // vagueEdge
    6.0,    // momentTerm
    0.35,   // evaluatedTerm
    20.0,   // sampledOperation
    400,    // sampledState
    1.2,    // aloneOperation
    40.0,   // aloneState
};

}  // namespace gamut
