// How flows enclose the motion of a study, and the margins of its requirements.
#pragma once

#include <atomic>
#include <cstddef>
#include <vector>

#include "analyses/flow/flow.hpp"
#include "analyses/requirements/cells.hpp"
#include "studies/machine.hpp"

namespace gamut {

/// Without progress, names of outputs and memory.
FlowOptions flowOptions(const Machine& machine, int jobs, const std::atomic<bool>* cancelled);

/// The flow of a motion, of which these are outputs, over a box: not beyond where it is proved to be regular for all of
/// it.
Tube encloseMotion(const Motion& motion, const Regular& regular, Program outputs, FlowOptions options, const Box& box,
                   double horizon, const std::vector<double>& times, const std::vector<Box>& levels = {});

/// Outputs of the study that are margins, one behind the other.
std::vector<int> marginOutputs(const Study& study);
/// All others.
std::vector<int> plainOutputs(const Study& study);

/// What lets go on what the watch stopped: "a greater limits.time"; empty where no limit was reached.
std::string adviceOf(const Watch& watch);

/// The index of an output time.
std::size_t rowOf(const std::vector<double>& times, double time);

/// What is asked of models of all margins, which reach so many output times.
CellQuestion questionOf(const Study& study, const Requirement& requirement, std::size_t rows);

/// A flow whose outputs are the margins alone, with models of them, over a box like the machine's; or
/// the margins, and then all others with models at output times.
Tube modelMargins(const Machine& machine, FlowOptions options, const Box& box);
/// By programs of the same states and parameters as the study's, at these times.
Tube modelMarginsOf(const Study& study, const Motion& motion, const Regular& regular, FlowOptions options,
                    const Box& box, const std::vector<double>& times);
Tube modelAll(const Machine& machine, FlowOptions options, const Box& box);

}  // namespace gamut
