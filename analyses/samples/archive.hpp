// What of samples is kept in archives, beside what says so itself.
#pragma once

#include "analyses/samples/courses.hpp"
#include "analyses/samples/cvode.hpp"
#include "analyses/samples/ensemble.hpp"
#include "analyses/table.hpp"
#include "scalars/archive.hpp"

namespace gamut {

void archive(Archive& all, Table& table);
void archive(Archive& all, Envelope& envelope);
void archive(Archive& all, Integration& run);
void archive(Archive& all, FailedSample& sample);
void archive(Archive& all, Convergence& first);
void archive(Archive& all, SwitchingCourse& course);

}  // namespace gamut
