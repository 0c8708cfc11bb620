// The header for programs outside: record a right-hand side, enclose its flow.
//
//     #include <gamut/flow.hpp>        // link to Gamut::gamut
//
// It brings record() and Program, Flow, DerivativeFlow and Tube, Box and Interval, all in namespace gamut.
#pragma once

#include "analyses/flow/derivatives.hpp"
#include "analyses/flow/flow.hpp"
