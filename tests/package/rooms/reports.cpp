// All rooms: a study is read, run, kept, read again, judged and told. It fails unless every sample lies inside.
#include <gamut/reports/report.hpp>
#include <gamut/reports/verdict.hpp>
#include <gamut/studies/results/results_file.hpp>
#include <gamut/studies/running/run.hpp>
#include <gamut/studies/study.hpp>

using namespace gamut;

int main(int, char** arguments) {
  writeResults(run(readStudy(arguments[1])), "study.h5");
  const Results results = readResults("study.h5");
  return judge(results).word == Agreement::inside && !renderReport(results).empty() ? 0 : 1;
}
