// The program from outside: exit codes, what is printed where, and which files are touched.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <sys/wait.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "commands/table.hpp"
#include "studies/results/results_file.hpp"
#include "tests/commands/program.hpp"
#include "tests/studies/four_bar_text.hpp"
#include "tests/studies/sample_results.hpp"
#include "tests/studies/sample_study.hpp"

namespace gamut {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;
using Json = nlohmann::json;

using Program = FromOutside;

TEST_F(Program, TellsItsVersionAndItsExitCodes) {
  const Outcome version = gamut("--version");
  EXPECT_EQ(version.exitCode, 0);
  EXPECT_THAT(version.out, StartsWith("gamut "));
  const Outcome help = gamut("--help");
  EXPECT_EQ(help.exitCode, 0);
  EXPECT_THAT(help.out, HasSubstr("Exit codes:"));
  for (const Command& command : commands::table) EXPECT_THAT(help.out, HasSubstr(command.help)) << command.name;
}

TEST_F(Program, RefusesWrongUsageInOneLine) {
  folder_.write("s.toml", sampleStudy);
  for (const char* arguments : {"",
                                "walk",
                                "run",
                                "run s.toml --jobs 0",
                                "run s.toml --samples -3",
                                "run s.toml --seed x",
                                "run s.toml --seed -1",
                                "run s.toml --seed 18446744073709551616",
                                "run s.toml --samples",
                                "run s.toml --samples 1e3",
                                "run s.toml --time-limit 0",
                                "run s.toml --time-limit -1",
                                "run s.toml --memory-limit inf",
                                "run s.toml --memory-limit x",
                                "run s.toml --what",
                                "run ''",
                                "check ''",
                                "run s.toml -o /proc/x.h5",
                                "run s.toml -o none/x.h5",
                                "run s.toml -o s.toml --force",
                                "run s.toml -o x --report x",
                                "run s.toml -o ."}) {
    SCOPED_TRACE(arguments);
    const Outcome run = gamut(arguments);
    EXPECT_EQ(run.exitCode, 2);
    EXPECT_EQ(run.out, "");
    EXPECT_THAT(run.error, StartsWith("gamut: "));
    EXPECT_EQ(run.error.find('\n'), run.error.size() - 1);
  }
  EXPECT_EQ(folder_.count(), 1U);
  EXPECT_EQ(folder_.read("s.toml"), sampleStudy);
  EXPECT_EQ(gamut("").error, "gamut: a command is missing; see gamut --help\n");
  EXPECT_EQ(gamut("run").error, "gamut: STUDY.toml is missing; see gamut run --help\n");
  EXPECT_EQ(gamut("rum s.toml").error, "gamut: unknown command 'rum'; expected 'run'\n");
  EXPECT_EQ(
      gamut("walk").error,
      "gamut: unknown command 'walk'; expected one of: new, quantities, run, view, resume, extend, validate, check, "
      "compare, tolerance, sweep, report and 6 more\n");
  EXPECT_EQ(gamut("run s.toml --seed -1").error,
            "gamut: --seed: '-1' is no whole number from 0 to 9223372036854775807; see gamut run --help\n");
}

TEST_F(Program, SuggestsTheOptionThatComesNear) {
  EXPECT_EQ(gamut("run s.toml --smaples 5").error, "gamut: unknown option '--smaples'; expected '--samples'\n");
}

TEST_F(Program, TakesLimitsWithUnits) {
  folder_.write("s.toml", sampleStudy);
  EXPECT_THAT(gamut("run s.toml --json --quiet --time-limit '0.5 min' --memory-limit 1024MiB").out,
              HasSubstr(R"("limits":{"time":30.0,"memory":1073741824.0,)"));
  EXPECT_EQ(gamut("run s.toml --time-limit 5kg").error,
            "gamut: --time-limit: '5kg' is no time above 0, such as 90, \"5 min\" or \"2 h\"; see gamut run --help\n");
}

TEST_F(Program, FailsIfWhatItSaysDoesNotArrive) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full here";
  writeResults(sampleResults(), folder_.path("r.h5"));
  for (const char* command : {"info r.h5", "check r.h5"}) {
    const Outcome run = gamut(std::string(command) + " > /dev/full 2> .error; exit $?; true");
    EXPECT_EQ(run.exitCode, 4);
    EXPECT_THAT(run.error, StartsWith("gamut: standard output: cannot be written; "));
  }
}

TEST_F(Program, WritesWholeFilesWhereStandardStreamsAreClosed) {
  folder_.write("s.toml", sampleStudy);
  EXPECT_EQ(gamut("run s.toml <&- >&- 2>&-; exit $?; true").exitCode, 0);
  EXPECT_EQ(readResults(folder_.path("s.h5")).studyText, sampleStudy);
  EXPECT_THAT(folder_.read("s.html"), StartsWith("<!"));
}

TEST_F(Program, RefusesMoreOutputsThanTheMemoryHolds) {
  std::string study = sampleStudyWith("output_step = 0.1", "output_step = 1e-5");
  for (int i = 2; i < 2000; ++i)
    study += "[[output]]\nquantity = \"hinge.angle\"\nname = \"angle " + std::to_string(i) + "\"\n";
  folder_.write("s.toml", study);
  const Outcome run = gamut("run s.toml");
  EXPECT_EQ(run.exitCode, 2);
  EXPECT_THAT(run.error, HasSubstr("samples of 2000 outputs at 50001 times need "));
  EXPECT_THAT(run.error, HasSubstr(" GB, the memory limit is "));
  EXPECT_THAT(run.error, HasSubstr(" GB, or fewer outputs or output times"));
  EXPECT_EQ(folder_.count(), 1U);
}

/// Three million motions kept would be 2.5 GB.
TEST_F(Program, TakesNoMoreMemoryForMoreSamples) {
  std::filesystem::copy(GAMUT_SOURCE_DIR "/studies/examples/tip_position/study.toml", folder_.path("tip.toml"));
  const auto memoryOf = [&](int samples) {
    const Outcome run = gamut(fmt::format("run tip.toml --samples {} --jobs 2 --quiet --force", samples));
    EXPECT_EQ(run.exitCode, 0);
    const Results results = readResults(folder_.path("tip.h5"));
    EXPECT_EQ(results.stochastic.integrated, samples + 2 + 18 + 1 + 11);
    return results.memory;
  };
  constexpr int few = 100'000, many = 400'000;
  const double ofAllOutputs = 2 * sizeof(double) * (many - few);
  EXPECT_LT(memoryOf(many) - memoryOf(few), ofAllOutputs);
}

TEST_F(Program, RefusesABadStudyWithoutTouchingAnyFile) {
  folder_.write("s.toml", sampleStudyWith("horizon = 0.5", "horizon = -1"));
  for (const char* command : {"validate s.toml", "run s.toml --json"}) {
    const Outcome run = gamut(command);
    EXPECT_EQ(run.exitCode, 2);
    EXPECT_EQ(run.out, "");
    EXPECT_EQ(run.error, "s.toml:4:11: study.horizon is not positive; expected a time above 0 s\n");
  }
  EXPECT_EQ(gamut("validate none.toml").error, "none.toml: does not exist; expected a study file (TOML)\n");
  EXPECT_EQ(gamut("validate none.toml").exitCode, 2);
  EXPECT_EQ(folder_.count(), 1U);
}

TEST_F(Program, SaysNotesUnlessItIsQuiet) {
  folder_.write("s.toml", sampleStudyWith("mass = \"250 g\"", "mass = 1\ninertia = [1, 2, 3]") +
                              "[[uncertain]]\nquantity = \"bob.inertia.zz\"\ninterval = \"± 1 %\"\n");
  const Outcome run = gamut("validate s.toml");
  EXPECT_EQ(run.exitCode, 0);
  EXPECT_EQ(run.error,
            "s.toml:46:12: note: for some values in the intervals the inertia of 'bob' has a principal moment "
            "above the sum of the other two\n");
  EXPECT_EQ(gamut("validate s.toml --quiet").error, "");
}

TEST_F(Program, ValidatesWithoutWriting) {
  folder_.write("s.toml", sampleStudy);
  const Outcome run = gamut("validate s.toml");
  EXPECT_EQ(run.exitCode, 0);
  EXPECT_EQ(run.out, "s.toml: valid; dynamics with 3 elements, 1 uncertain quantity, 2 outputs at 6 times\n");
  EXPECT_EQ(folder_.count(), 1U);
}

TEST_F(Program, WritesResultsAndReportNamedAfterTheStudyAndPrintsJsonAlone) {
  folder_.write("swing.toml", sampleStudy);
  const Outcome run = gamut("run swing.toml --json --quiet --samples 20 --seed 5");
  ASSERT_EQ(run.exitCode, 0) << run.error;
  EXPECT_EQ(run.error, "");
  const Json json = Json::parse(run.out);
  EXPECT_EQ(json["verdict"], "inside");
  EXPECT_EQ(json["samples"], 20);
  EXPECT_EQ(json["reached"], 0.5);
  EXPECT_EQ(json["enclosure"]["angle"].size(), 6U);
  EXPECT_EQ(json["files"]["results"], "swing.h5");
  EXPECT_EQ(json["files"]["report"], "swing.html");
  EXPECT_THAT(folder_.read("swing.html"), HasSubstr("<html"));
  const Results results = readResults(folder_.path("swing.h5"));
  EXPECT_EQ(results.seed, 5U);
  EXPECT_EQ(results.studyText, sampleStudy);

  for (const auto& [name, times] : json["enclosure"].items())
    for (const auto& [time, bounds] : times.items()) {
      const Json sampled = json["envelope"][name][time];
      EXPECT_LE(bounds[0].get<double>(), sampled[0].get<double>()) << name << " at " << time;
      EXPECT_GE(bounds[1].get<double>(), sampled[1].get<double>()) << name << " at " << time;
    }

  const Outcome check = gamut("check swing.h5");
  EXPECT_EQ(check.exitCode, 0) << check.out;
  const Outcome info = gamut("info swing.h5");
  EXPECT_EQ(info.exitCode, 0);
  for (const char* word : {"Pendulum", "hinge.angle", "tip.position.z", "seed 5"})
    EXPECT_THAT(info.out, HasSubstr(word));
}

TEST_F(Program, WritesTheSamePageAgainFromTheResults) {
  const std::string kinematics = [] {
    std::string text = sampleStudyWith("dynamics", "kinematics");
    text.erase(text.find("horizon = 0.5\n"), 14);
    return text.erase(text.find("output_step = 0.1\n"), 18);
  }();
  const std::string studies[] = {sampleStudy, kinematics,
                                 sampleStudyWith("[\"interval\", \"stochastic\", \"fuzzy\"]", "[\"fuzzy\"]"),
                                 sampleStudyWith("\"Pendulum\"", "\"Pendel <b>µ</b> \\U0001F600\""),
                                 sampleStudyWith("[stochastic]", "[limits]\nenclosure_time = 1e-9\n[stochastic]")};
  for (const std::string& study : studies)
    for (const std::string name : {"s.toml", "a\n\x1b[31mb.toml", "\xff\xfe.toml"}) {
      SCOPED_TRACE(study + name);
      folder_.write(name, study);
      const Outcome run = gamut("run '" + name + "' -o s.h5 --force --quiet");
      EXPECT_TRUE(run.exitCode == 0 || run.exitCode == 3) << run.error;
      EXPECT_EQ(gamut("report s.h5 -o again.html --force").exitCode, 0);
      EXPECT_EQ(folder_.read("again.html"), folder_.read("s.html"));
    }
}

TEST_F(Program, NamesFilesAfterTheFolderOfAStudyToml) {
  std::filesystem::create_directory(folder_.path("arm"));
  folder_.write("arm/study.toml", sampleStudy);
  EXPECT_EQ(gamut("run arm/study.toml --quiet").exitCode, 0);
  EXPECT_TRUE(folder_.has("arm.h5"));
  EXPECT_TRUE(folder_.has("arm.html"));
}

TEST_F(Program, ReadsAStudyFromStandardInput) {
  folder_.write("s.toml", sampleStudy);
  EXPECT_EQ(gamut("validate - < s.toml").out,
            "standard input: valid; dynamics with 3 elements, 1 uncertain quantity, 2 outputs at 6 times\n");
  EXPECT_EQ(gamut("run - --quiet", "cat s.toml | ").exitCode, 0);
  EXPECT_EQ(readResults(folder_.path("study.h5")).studyText, sampleStudy);
  EXPECT_TRUE(folder_.has("study.html"));
  EXPECT_EQ(gamut("check study.h5").exitCode, 0);

  folder_.write("wrong.toml", sampleStudyWith("axis = \"x\"", "axis = \"w\""));
  const Outcome wrong = gamut("run - < wrong.toml");
  EXPECT_EQ(wrong.exitCode, 2);
  EXPECT_THAT(wrong.error, StartsWith("standard input:14:8: "));
  EXPECT_EQ(gamut("run - < .").error,
            "standard input: cannot be read (Is a directory); expected a study file (TOML)\n");
  EXPECT_EQ(gamut("run - <&-").error, "standard input:1:1: 'study' is missing; expected a table [study]\n");
}

TEST_F(Program, OverwritesOnlyWhenForced) {
  folder_.write("s.toml", sampleStudy);
  folder_.write("s.html", "precious");
  const Outcome refused = gamut("run s.toml");
  EXPECT_EQ(refused.exitCode, 2);
  EXPECT_EQ(refused.error, "gamut: s.html: exists already; expected another name, or --force\n");
  EXPECT_EQ(folder_.read("s.html"), "precious");
  EXPECT_FALSE(folder_.has("s.h5"));
  EXPECT_EQ(gamut("run s.toml --force --quiet").exitCode, 0);
  EXPECT_THAT(folder_.read("s.html"), HasSubstr("<html"));
}

TEST_F(Program, LeavesTheSecondRunOnOneOutputOut) {
  folder_.write("s.toml", sampleStudy);
  OutputFile first(folder_.path("s.h5"), OutputFile::Existing::isKept);
  const Outcome second = gamut("run s.toml");
  EXPECT_EQ(second.exitCode, 2);
  EXPECT_EQ(second.error, "gamut: s.h5: cannot be written; another run is about to write it\n");
  EXPECT_FALSE(folder_.has("s.html"));
}

TEST_F(Program, ReplacesNoDeviceEvenIfForced) {
  folder_.write("s.toml", sampleStudy);
  // Only root can make a device; what is no regular file otherwise is a pipe.
  const std::string device = folder_.path("device");
  const bool isMade =
      ::mknod(device.c_str(), S_IFCHR | 0600, ::makedev(1, 3)) == 0 || ::mkfifo(device.c_str(), 0600) == 0;
  ASSERT_TRUE(isMade);
  for (const char* arguments : {"run s.toml --force -o device", "run s.toml --force --report device"}) {
    const Outcome run = gamut(arguments);
    EXPECT_EQ(run.exitCode, 2);
    EXPECT_THAT(run.error, HasSubstr("it is a device, or another thing that is no regular file\n"));
  }
  EXPECT_FALSE(std::filesystem::is_regular_file(device));
  EXPECT_EQ(folder_.count(), 2U);
}

TEST_F(Program, SaysThatItsFilesDoNotFit) {
  folder_.write("s.toml", sampleStudy);
  const Outcome run = gamut("run s.toml --quiet", "ulimit -f 8 && ");
  EXPECT_EQ(run.exitCode, 4);
  EXPECT_EQ(run.error,
            "gamut: s.h5: cannot be written; files may not grow so large here, see ulimit -f (File too large)\n");
  EXPECT_EQ(folder_.count(), 1U);
}

/// What no number can hold is told as infinite: squares of it, on the way to indices, are no reason to give up either.
TEST_F(Program, RunsAndDrawsWhatIsInfiniteOrHuge) {
  for (const char* quantity : {"exp(800)*hinge.angle", "exp(exp(11*hinge.angle))", "1e200*hinge.angle",
                               "exp(700*hinge.angle)", "1e-300*hinge.angle"}) {
    SCOPED_TRACE(quantity);
    folder_.write("s.toml", sampleStudyWith("\"tip.position.z\"", "\"" + std::string(quantity) + "\""));
    const Outcome run = gamut("run s.toml --force");
    EXPECT_THAT(run.exitCode, ::testing::AnyOf(0, 3)) << run.error;
    EXPECT_EQ(run.error, "");
    EXPECT_THAT(folder_.read("s.html"), ::testing::EndsWith("</html>\n"));
    EXPECT_EQ(gamut("check s.h5").exitCode, run.exitCode);
    EXPECT_EQ(gamut("report s.h5 --force").exitCode, 0);
  }
}

TEST_F(Program, SaysWhatItFoundOnStandardOutput) {
  folder_.write("s.toml", sampleStudy);
  const Outcome run = gamut("run s.toml -o a.h5 --report b.html");
  EXPECT_EQ(run.exitCode, 0);
  EXPECT_EQ(run.error, "");  // no bar unless on a terminal
  for (const char* word : {"enclosure", "overestimation", "angle (rad)", "tip.position.z (m)", "a.h5", "b.html"})
    EXPECT_THAT(run.out, HasSubstr(word));
}

TEST_F(Program, GivesTheSameNumbersForTheSameSeedOnAnyNumberOfThreads) {
  folder_.write("s.toml", sampleStudy);
  const Json one = Json::parse(gamut("run s.toml --json --quiet --jobs 1").out);
  const Json two = Json::parse(gamut("run s.toml --json --quiet --jobs 2 --force").out);
  EXPECT_EQ(one["enclosure"], two["enclosure"]);
  EXPECT_EQ(one["envelope"], two["envelope"]);
}

TEST_F(Program, EndsEarlyWhereAnOutputLosesItsValue) {
  for (const char* compare : {"[\"interval\"]", "[\"fuzzy\"]", "[\"interval\", \"stochastic\", \"fuzzy\"]"}) {
    SCOPED_TRACE(compare);
    std::string study = sampleStudyWith("[\"interval\", \"stochastic\", \"fuzzy\"]", compare);
    study.replace(study.find("tip.position.z"), 14, "sqrt(hinge.angle - 0.2)");
    folder_.write("s.toml", study);
    const Outcome run = gamut("run s.toml --force");
    EXPECT_EQ(run.exitCode, 3) << run.error;
    EXPECT_THAT(run.out, HasSubstr("s: s.h5"));
    EXPECT_TRUE(folder_.has("s.html"));
  }
}

TEST_F(Program, RunsWithOneAnalysisAlone) {
  for (const char* analysis : {"interval", "stochastic", "fuzzy"}) {
    SCOPED_TRACE(analysis);
    folder_.write("s.toml",
                  sampleStudyWith("[\"interval\", \"stochastic\", \"fuzzy\"]", "[\"" + std::string(analysis) + "\"]"));
    const Outcome run = gamut("run s.toml --json --quiet --force");
    EXPECT_EQ(run.exitCode, 0) << run.error;
    EXPECT_TRUE(Json::parse(run.out)["verdict"].is_null());
    EXPECT_THAT(gamut("run s.toml --force").out, HasSubstr("\nNothing could be compared: "));
  }
}

TEST_F(Program, CheckFindsASampleOutsideItsEnclosureInTheStoredNumbers) {
  Results results = sampleResults();
  results.interval.at.upper(0, 0) = 0.4;  // the envelope there reaches to 0.85
  results.comparison.verdict = Agreement::inside;
  results.comparison.disputed.clear();
  writeResults(results, folder_.path("r.h5"));
  const Outcome run = gamut("check r.h5");
  EXPECT_EQ(run.exitCode, 1) << run.out;
}

/// Of wide tolerances of a linkage a proof takes seconds of CPU, before there is anything to write.
TEST_F(Program, EndsAtATimeLimitBeforeAStudyCanRun) {
  folder_.write("s.toml", testing::fourBarText("1", testing::uncertain({"a", "b", "c", "d"}, "± 45 %")));
  const Outcome run = gamut("run s.toml --time-limit 1");
  EXPECT_EQ(run.exitCode, 3) << run.error;
  EXPECT_THAT(run.error, HasSubstr("gamut: the time limit of 1.00 s of CPU was reached before the study could run (at "
                                   "work on: loops, "));
  for (const char* file : {"s.h5", "s.html"}) EXPECT_FALSE(std::filesystem::exists(folder_.path(file))) << file;
}

/// A kite's linkage folds flat.
TEST_F(Program, NotesWhereAMotionComesToBeforeItRuns) {
  std::string kite = testing::fourBarText("2", "");
  const std::string lengths = "a = \"0.3 m\", b = \"0.8 m\", c = \"0.6 m\", d = \"0.9 m\"";
  folder_.write("turning.toml", kite);
  kite.replace(kite.find(lengths), lengths.size(), "a = \"0.3 m\", b = \"0.3 m\", c = \"0.8 m\", d = \"0.8 m\"");
  folder_.write("kite.toml", kite);
  const Outcome run = gamut("validate kite.toml");
  EXPECT_EQ(run.exitCode, 0) << run.error;
  EXPECT_THAT(run.error, HasSubstr(": note: the nominal motion comes between 0.5535"));
  EXPECT_EQ(gamut("validate kite.toml --quiet").error, "");
  EXPECT_EQ(gamut("validate turning.toml").error, "");
}

TEST_F(Program, CheckTellsAnIncompleteRunApart) {
  Results results = sampleResults();
  results.comparison.disputed.clear();
  writeResults(results, folder_.path("r.h5"));
  EXPECT_EQ(gamut("check r.h5").exitCode, 3);
}

TEST_F(Program, KeepsWhatWasProvedWhenTheEnclosureEndsBeforeTheHorizon) {
  std::string study = sampleStudyWith("angle = \"30 deg\"", "angle = \"170 deg\"");
  study.replace(study.find("± 1 %"), std::string("± 1 %").size(), "± 9 deg");
  study.replace(study.find("horizon = 0.5"), 13, "horizon = 90.0");
  folder_.write("s.toml", study + "[interval]\nsplit = false\n");
  const Outcome run = gamut("run s.toml --json --quiet");
  ASSERT_EQ(run.exitCode, 3) << run.error;
  const Json json = Json::parse(run.out);
  EXPECT_EQ(json["verdict"], "incomplete");
  EXPECT_EQ(json["horizon"], 90);
  const double reached = json["reached"].get<double>();
  EXPECT_GT(reached, 0.5);
  EXPECT_LT(reached, 90);
  for (const auto& [time, bounds] : json["enclosure"]["angle"].items()) EXPECT_LE(std::stod(time), reached);
  EXPECT_FALSE(json["enclosure"]["angle"].empty());
  EXPECT_TRUE(json["envelope"]["angle"].contains("90"));
  const Outcome check = gamut("check s.h5");
  EXPECT_EQ(check.exitCode, 3);
  EXPECT_THAT(check.out, HasSubstr("90 s asked for"));
  EXPECT_TRUE(folder_.has("s.html"));
}

TEST_F(Program, RefusesWhatIsNoResultsFile) {
  folder_.write("s.toml", sampleStudy);
  for (const char* command : {"check s.toml", "info s.toml", "report s.toml", "check none.h5"}) {
    SCOPED_TRACE(command);
    const Outcome run = gamut(command);
    EXPECT_EQ(run.exitCode, 2);
    EXPECT_THAT(run.error, HasSubstr("; expected a results file written by gamut run\n"));
    EXPECT_EQ(run.error.find('\n'), run.error.size() - 1);
  }
}

/// What counts for others: exit codes by requirements, and the values that violate one.
TEST_F(Program, ChecksRequirements) {
  const auto studyWith = [](const std::string& requirement) {
    return sampleStudyWith("[stochastic]", "[[requirement]]\nname = \"limit\"\n" + requirement + "\n[stochastic]");
  };
  folder_.write("met.toml", studyWith("always = \"angle < 1\""));
  folder_.write("partly.toml", studyWith("always = \"angle < 30.1 deg\"\nuntil = 0"));
  folder_.write("none.toml", sampleStudy);
  EXPECT_THAT(gamut("run met.toml").out,
              StartsWith("The requirement is met in every case that the stated tolerances allow.\n"
                         "  met       limit: “angle” stays below 1 rad in every case.\nAll "));
  EXPECT_THAT(gamut("run met.toml --force --verbose").out,
              HasSubstr("in every case.\n    demanded    always angle < 1\n    guaranteed  met for every value"));
  EXPECT_EQ(gamut("run partly.toml --quiet").exitCode, 0);
  EXPECT_EQ(gamut("run none.toml --quiet").exitCode, 0);
  EXPECT_EQ(gamut("check met.h5 --requirements").exitCode, 0);
  EXPECT_EQ(gamut("check partly.h5").exitCode, 0);
  const Outcome partly = gamut("check partly.h5 --requirements");
  EXPECT_EQ(partly.exitCode, 1);
  EXPECT_THAT(partly.out, HasSubstr("  violated  limit: In some cases, “angle” does not stay below 30.1 deg at 0 s."));
  folder_.write("unnamed.toml",
                sampleStudyWith("[stochastic]", "[[requirement]]\nalways = \"angle < 1\"\n[stochastic]"));
  EXPECT_THAT(gamut("run unnamed.toml").out,
              HasSubstr("allow.\n  met       “angle” stays below 1 rad in every case.\n"));
  const Outcome none = gamut("check none.h5 --requirements");
  EXPECT_EQ(none.exitCode, 2);
  EXPECT_THAT(none.error, HasSubstr("holds no requirements; expected results of a study with [[requirement]]"));
  const Outcome violation = gamut("replay partly.h5 violation limit");
  EXPECT_EQ(violation.exitCode, 0);
  EXPECT_THAT(violation.out, StartsWith("time (s),angle (rad),tip.position.z (m),limit (rad)"));
  EXPECT_THAT(gamut("replay partly.h5 violation limits").error,
              HasSubstr("holds no requirement 'limits'; expected violation and one of 'limit'"));
  EXPECT_EQ(gamut("replay met.h5 violation limit").exitCode, 2);
  const Json requirement = Json::parse(gamut("run partly.toml --json --force").out)["requirements"][0];
  EXPECT_EQ(requirement["guaranteed"], "partly");
  EXPECT_GT(requirement["violation"]["start"], 0.525);
}

TEST_F(Program, SamplesWithoutIntegrating) {
  folder_.write("s.toml", sampleStudy);
  ASSERT_EQ(gamut("run s.toml --quiet").exitCode, 0);
  const Outcome csv = gamut("sample s.h5 --samples 2 --at 0.5 --outputs angle");
  EXPECT_EQ(csv.exitCode, 0);
  EXPECT_THAT(csv.out, StartsWith("sample,uncertain start (rad),time (s),angle (rad),error of angle (rad)\n0,0.5"));
  EXPECT_EQ(std::ranges::count(csv.out, '\n'), 3);
  EXPECT_EQ(gamut("sample s.h5 --samples 2 --at 0.5 --outputs angle").out, csv.out);
  EXPECT_NE(gamut("sample s.h5 --samples 2 --at 0.5 --outputs angle --seed 2").out, csv.out);
  EXPECT_EQ(gamut("sample s.h5 --samples 2 --at '500 ms' --outputs angle").out, csv.out);
  EXPECT_EQ(gamut("sample s.h5 --samples 100 -o all.h5").exitCode, 0);
  EXPECT_TRUE(folder_.has("all.h5"));
  EXPECT_EQ(gamut("sample s.h5 --samples 100 -o all.h5").exitCode, 2);
  const auto refusal = [&](const std::string& arguments) {
    const Outcome outcome = gamut("sample s.h5 --samples 2 " + arguments);
    EXPECT_EQ(outcome.exitCode, 2) << arguments;
    return outcome.error;
  };
  EXPECT_THAT(refusal("--at 0.45"), HasSubstr("s.h5: holds no polynomials of 0.45 s; expected an output time"));
  EXPECT_THAT(refusal("--at 5kg"), HasSubstr("--at: '5kg' is no time such as 0.5 or \"500 ms\""));
  EXPECT_THAT(refusal("--outputs speed"), HasSubstr("no polynomials of an output 'speed'; expected 'angle'"));
  EXPECT_THAT(refusal("--plan any"), HasSubstr("no sampling plan is called 'any'"));
  EXPECT_THAT(gamut("sample s.h5 --samples 100000000").error, HasSubstr("more than 2e+08 numbers"));
  folder_.write("alone.toml", sampleStudyWith("\"interval\", \"stochastic\", \"fuzzy\"", "\"stochastic\""));
  gamut("run alone.toml --quiet");
  EXPECT_THAT(gamut("sample alone.h5 --samples 2").error,
              HasSubstr("holds no polynomials of outputs; expected results"));
}

TEST_F(Program, TellsTolerances) {
  const std::string begin = "[[requirement]]\nname = \"limit\"\nuntil = 0\nalways = \"angle < ";
  folder_.write("wide.toml", sampleStudyWith("[stochastic]", begin + "31 deg\"\n[stochastic]"));
  folder_.write("narrow.toml", sampleStudyWith("[stochastic]", begin + "30.1 deg\"\n[stochastic]"));
  folder_.write("never.toml", sampleStudyWith("[stochastic]", begin + "29 deg\"\n[stochastic]"));
  folder_.write("none.toml", sampleStudy);
  const Outcome wide = gamut("tolerance wide.toml --quiet");
  EXPECT_EQ(wide.exitCode, 0);
  EXPECT_THAT(wide.out, StartsWith("All requirements are met, also with deviations 3.3"));
  const Outcome narrow = gamut("tolerance narrow.toml --json --quiet");
  EXPECT_EQ(narrow.exitCode, 1);
  const Json json = Json::parse(narrow.out);
  EXPECT_LE(json["together"]["factor"], 1.0 / 3);
  EXPECT_GT(json["together"]["factor"], 0.32);
  EXPECT_EQ(json["alone"]["start"]["limited_by"], "limit");
  EXPECT_EQ(gamut("tolerance never.toml --quiet").exitCode, 3);
  const Outcome none = gamut("tolerance none.toml");
  EXPECT_EQ(none.exitCode, 2);
  EXPECT_EQ(none.error, "gamut: none.toml: the study has no [[requirement]]\n");
}

}  // namespace
}  // namespace gamut
