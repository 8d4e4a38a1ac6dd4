// SPDX-License-Identifier: Apache-2.0
// What people get wrong on command lines: one line that names the option or file, before any work.
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/paths.hpp"
#include "support/semview_runs.hpp"

namespace semview {
namespace {

using semview::testing::Arguments;
using semview::testing::ChildProcess;
using ::testing::HasSubstr;

const std::string kMap = SEMVIEW_SOURCE_DIR "/maps/duplex_level1";

class UsageTest : public semview::testing::SemviewRuns {
 protected:
  /// Expects wrong usage (exit code 2) and `words` on standard error.
  void expect_usage(const Arguments& arguments, const std::string& words) {
    EXPECT_EQ(run(arguments), 2) << output_ << errors_;
    EXPECT_THAT(errors_, HasSubstr(words));
  }

  /// Expects a failure (exit code 1) and `words` on standard error.
  void expect_failure(const Arguments& arguments, const std::string& words) {
    EXPECT_EQ(run(arguments), 1) << output_ << errors_;
    EXPECT_THAT(errors_, HasSubstr(words));
  }

  void localize_from(const std::string& init, const std::string& words) {
    expect_usage(
        {"localize", "--log", file("log"), "--map", kMap, "--init", init, "-o", file("est.tum")},
        words);
  }
};

TEST_F(UsageTest, AStartThatIsNoneIsRefusedByName) {
  localize_from("1,-5,nan,0.3", "--init 1,-5,nan,0.3: expected 4 finite numbers");
  localize_from("1e9,-5,0,0.3", "--init: X 1000000000 or Y -5 is beyond");
  localize_from("1,-5,0,-1", "--init: SIGMA -1 is not in 0..100 m");
  localize_from("1,-5,0,1000", "--init: SIGMA 1000 is not in 0..100 m");
}

TEST_F(UsageTest, AStartFarFromTheMapIsRefusedWithTheMapsExtent) {
  ASSERT_EQ(run({"simulate", kMap, "--out", file("log"), "--steps", "2"}), 0) << errors_;
  EXPECT_THAT(output_, HasSubstr("of the robot's time"));
  localize_from("100,100,0,0.3", "--init: no free space within 0.90 m of (100, 100)");
  EXPECT_THAT(errors_, HasSubstr("reaches from x 0.1 to 8.8 m and y -18.4 to 0.5 m"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "est.tum"));
}

TEST_F(UsageTest, ASimulationThatIsNoneIsRefusedByItsOption) {
  const auto refused = [this](const std::string& option, const std::string& value) {
    expect_usage({"simulate", kMap, "--out", file("log"), option, value}, option + ": ");
    EXPECT_FALSE(std::filesystem::exists(folder_ / "log"));
  };
  refused("--steps", "0");
  refused("--fov", "700");
  refused("--frame-distance", "nan");
  refused("--columns", "7");
  refused("--noise", "-1");
}

TEST_F(UsageTest, APictureIsNotWrittenUnderAnotherKindsName) {
  const std::string words = "x.jpg: is not the name of a PNG";
  expect_failure({"map", "preview", kMap, "-o", file("x.jpg")}, words);
  expect_failure({"map", "occupancy", kMap, "-o", file("x.jpg")}, words);
  expect_failure({"view", kMap, "--pose", "4.5,-13.2,0", "--image", file("x.jpg")}, words);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "x.jpg"));
}

TEST_F(UsageTest, NumbersMustBeFinite) {
  expect_usage({"view", kMap, "--pose", "nan,1,2"}, "--pose nan,1,2: expected 3 finite numbers");
  expect_usage({"evaluate", "run", "--log", "x", "y.tum", "--final-within", "nan"},
               "--final-within nan: expected a finite number");
  expect_usage({"evaluate", "run", "--log", "x", "y.tum", "--converged-within", "-1"},
               "--converged-within -1: expected a finite number");
}

TEST_F(UsageTest, WholeNumbersFromZeroAreNoOthers) {
  const std::string words = " is not a whole number from 0 to 18446744073709551615";
  for (const std::string bad : {"-1", "1.5", "99999999999999999999", "one"}) {
    expect_usage({"simulate", kMap, "--out", file("log"), "--seed", bad}, "--seed: " + bad + words);
    expect_usage({"localize", "--log", "l", "--map", kMap, "--global", "-o", "e", "--seed", bad},
                 "--seed: " + bad + words);
    expect_usage({"heatmap", kMap, "--obs", "o", "--frame", bad}, "--frame: " + bad + words);
  }
  EXPECT_FALSE(std::filesystem::exists(folder_ / "log"));
}

TEST_F(UsageTest, WorldsAreListedAlikeInEveryExperiment) {
  for (const char* const experiment : {"lost", "paper2017", "sketches"}) {
    for (const std::string bad : {"6..1", "1,,2", "1,1", "1..3,2", "x", "1..", "1..200"}) {
      expect_usage({"evaluate", experiment, "--worlds", bad, "--out", file("out")},
                   "--worlds " + bad + ": expected seeds or ranges such as 1,2,3 or 1..6");
    }
  }
  for (const char* const list : {"1..3,101", "3,100..102"}) {
    expect_usage({"evaluate", "lost", "--worlds", list, "--out", file("out")},
                 "--worlds: weights are learned on world 101");
  }
}

TEST_F(UsageTest, WorldsAndNoiseOfLostAreChecked) {
  const auto expect = [&](const std::string& option, const std::string& value, const char* words) {
    expect_usage({"evaluate", "lost", option, value, "--out", file("out")}, words);
  };
  expect("--worlds", "1,201", "--worlds: 1 is a test world and 201 a validation world");
  expect("--worlds", "300", "--worlds: 300 is no world");
  expect("--noise", "nan", "--noise nan: expected levels from 0 to 3, each once");
  expect("--noise", "0.3,0.3", "--noise 0.3: expected levels from 0 to 3, each once");
  expect_usage({"evaluate", "lost", "--learn", "--worlds", "1"}, "--worlds");
}

TEST_F(UsageTest, NoExperimentStartsMoreThreadsThanThereCanBe) {
  for (const char* const experiment : {"paper2017", "sketches", "lost"}) {
    expect_usage({"evaluate", experiment, "--threads", "100000", "--out", file("out")},
                 "--threads: Value 100000 not in range");
  }
  expect_usage({"evaluate", "logs", "--map", kMap, "log", "--threads", "100000"},
               "--threads: Value 100000 not in range");
}

TEST_F(UsageTest, WhatIsNamedTwiceIsRefused) {
  const auto expect = [&](const std::string& verb, const std::string& option, const char* list) {
    const std::string first = std::string(list).substr(0, std::string(list).find(','));
    Arguments all{"evaluate", verb, option, list, "--out", file("out")};
    if (verb == "logs") all.insert(all.end(), {"--map", kMap, "log"});
    expect_usage(all, option + ": " + first + " is named twice; expected each once");
    EXPECT_FALSE(std::filesystem::exists(folder_ / "out"));
  };
  expect("paper2017", "--rows", "unmodified,unmodified");
  expect("paper2017", "--methods", "ours,ablation");
  expect("paper2017", "--starts", "local,local");
  expect("sketches", "--methods", "none,none");
  expect("sketches", "--starts", "local,local");
  expect("logs", "--methods", "ours,ours");
  expect("logs", "--starts", "local,local");
}

TEST_F(UsageTest, AnExportTakesNoOptionsOfWhatItDoesNotRun) {
  for (const Arguments& more : {Arguments{"--methods", "ours"},
                                Arguments{"--starts", "local"},
                                Arguments{"--runs", "3"},
                                Arguments{"--resume"}}) {
    Arguments all{"evaluate", "paper2017", "--export", file("exported"), "--quick"};
    all.insert(all.end(), more.begin(), more.end());
    expect_usage(all, more.front() + ": has no meaning with --export");
    EXPECT_FALSE(std::filesystem::exists(folder_ / "exported"));
  }
}

TEST_F(UsageTest, RoomsOfNoCommonNameAreRefused) {
  const std::string header = "room,min_x_m,min_y_m,max_x_m,max_y_m\n";
  std::ofstream(folder_ / "true.csv") << header << "hall,0,0,1,1\n";
  std::ofstream(folder_ / "drawn.csv") << header << "kitchen,0,0,1,1\n";
  expect_failure({"evaluate",
                  "rooms",
                  "--log",
                  "log",
                  "--true-rooms",
                  file("true.csv"),
                  "--rooms",
                  file("drawn.csv"),
                  "est.tum"},
                 "have no room of the same name");
}

TEST_F(UsageTest, APanoramasEyeIsAboveTheGround) {
  for (const char* const height : {"-3", "0", "nan", "101"}) {
    expect_usage({"observe", "x.jpg", "--equirectangular", "--eye-height", height, "-o", "out"},
                 "--eye-height: " + std::string(height) + ": expected a height above 0 m");
  }
}

TEST_F(UsageTest, OptionsWithoutEffectAreRefused) {
  const std::string pinhole = "525,525,320,240,640,480";
  expect_usage({"view", kMap, "--pose", "1,-5,0", "--pinhole", pinhole, "--rows", "9"}, "--rows");
  expect_usage({"view", kMap, "--pose", "1,-5,0", "--pinhole", pinhole, "--columns", "120"},
               "--columns");
  expect_usage({"view", kMap, "--pose", "1,-5,0", "--cache", file("cache")}, "--cache");
  expect_usage({"view", kMap, "--pose", "1,-5,0", "--ranges"}, "--ranges");
  expect_usage({"score", kMap, "--obs", "o", "--weights", "w", "--pose", "1,-5,0", "--ranges"},
               "--ranges");
  expect_usage({"heatmap", kMap, "--obs", "o", "--weights", "w", "-o", "x.png", "--ranges"},
               "--ranges");
  expect_usage({"localize", "--log", "l", "--map", kMap, "--global", "-o", "e.tum", "--ranges"},
               "--ranges");
  expect_usage({"view", kMap, "--pose", "1,-5,0", "--threads", "-1"},
               "--threads: Value -1 not in range");
}

TEST_F(UsageTest, WrongParametersOfTheFilterAreNamedByTheirOption) {
  const Arguments localize{"localize", "--log", "l", "--map", kMap, "--global", "-o", "e.tum"};
  const auto expect = [&](const Arguments& more, const std::string& words) {
    Arguments all = localize;
    all.insert(all.end(), more.begin(), more.end());
    expect_usage(all, words);
  };
  expect({"--heading", "stars"}, "--heading");
  expect({"--heading", "combined", "--combined-sigma", "0"}, "--combined-sigma");
  expect({"--heading", "combined", "--combined-lost", "2"}, "--combined-lost");
  expect({"--compass-gain", "2"}, "--compass-gain");
  expect({"--kld", "--kld-err", "0"}, "--kld-err");
  expect({"--kld", "--min-particles", "9", "--max-particles", "8"}, "--max-particles");
  expect({"--kld-err", "0.1"}, "--kld-err: needs --kld");
  expect({"--recovery", "uniform", "--recovery-alpha-fast", "0.01"}, "--recovery-alpha-fast");
  expect({"--recovery", "prayer"}, "--recovery");
  expect({"--affine-drift", "0.1"}, "--affine-drift: needs --estimate-map-affine");
  expect({"--estimate-map-affine", "--affine-exact", "2"},
         "--affine-exact: 2: expected a share from 0 to 1");
  expect({"--estimate-map-affine", "--affine-scale-sigma", "nan"},
         "--affine-scale-sigma: nan: expected a finite number from 0");
  expect({"--combined-sigma", "3"}, "--combined-sigma: needs --heading combined");
  expect({"--kappa", "20"}, "--kappa: needs --weighting exponential");
  expect({"--weighting", "exponential", "--power", "3"}, "--power: needs --weighting power");
  expect({"--sigma", "0.1"}, "--sigma: needs --motion paper");
  expect({"--motion", "paper", "--alpha3", "0.1"}, "--alpha3: needs --motion odometry");
  expect({"--heading", "odometry", "--compass-gain", "1"}, "--compass-gain: needs --heading");
  expect({"--init-heading-sigma", "3"}, "--init-heading-sigma: needs --init");
  expect({"--estimate-map-affine", "--particles", "30000"}, "--particles: 30000");
}

TEST_F(UsageTest, AnOutputThatCannotBeWrittenIsToldBeforeTheWork) {
  // The map is not there either: the output is looked at first.
  const std::string map = file("no_map");
  const std::string missing = file("missing/out");
  const std::string words = "cannot be written: the folder " + file("missing") + " is not there";
  expect_failure({"view", map, "--pose", "0,0,0", "--image", missing}, words);
  expect_failure({"map", "preview", map, "-o", missing}, words);
  expect_failure({"map", "occupancy", map, "-o", missing}, words);
  expect_failure({"map", "export", map, missing + ".glb"}, words);
  expect_failure({"heatmap", map, "--obs", "o", "--weights", "w.csv", "-o", missing}, words);
  expect_failure({"evaluate", "run", "--log", "x", "y.tum", "--svg", missing}, words);
  expect_failure({"localize", "--log", "x", "--map", map, "--global", "-o", missing}, words);
  expect_failure({"weights", "init", map, "-o", missing}, words);
  EXPECT_THAT(errors_, HasSubstr("mkdir -p"));
  const std::string below_a_file = folder_.write("file", "").string() + "/out";
  expect_failure({"simulate", map, "--out", below_a_file}, "is not a folder");
  expect_failure({"map", "import", "ros", "x.yaml", "-o", below_a_file}, "is not a folder");
}

TEST_F(UsageTest, NoVerbWritesOverWhatItReads) {
  std::filesystem::create_directory(folder_ / "log");
  for (const char* const name : {"log/log.yaml", "log/odometry.txt", "log/labels.png"}) {
    folder_.write(name, "kept");
  }
  const std::string odometry = file("log/odometry.txt");
  expect_failure({"localize", "--log", file("log"), "--map", kMap, "--global", "-o", odometry},
                 "odometry.txt: is part of the run log in this folder");
  expect_failure({"evaluate", "run", "--log", file("log"), odometry, "--svg", odometry},
                 "odometry.txt: is part of the run log in this folder");
  expect_failure({"map", "distort", kMap, "--shear", "0.3", "-o", file("log")},
                 "log: has log.yaml, expected a new or empty folder for the map");
  const std::string flat = folder_.write("flat.glb", "kept").string();
  expect_failure({"map", "export", flat, flat}, "flat.glb: is read as input");
  std::filesystem::remove(folder_ / "log/log.yaml");
  expect_failure({"map", "distort", kMap, "--shear", "0.3", "-o", file("log")},
                 "labels.png: is there already, and would be written over");
}

TEST_F(UsageTest, AnEmptyFolderIsNoRunLogAndNoObservation) {
  std::filesystem::create_directory(folder_ / "empty");
  expect_failure(
      {"localize", "--log", file("empty"), "--map", kMap, "--global", "-o", file("est.tum")},
      "empty: has no log.yaml, expected a run log");
  const std::string weights = kMap + "/weights.csv";
  expect_failure({"score", kMap, "--obs", file("empty"), "--weights", weights, "--pose", "1,-5,0"},
                 "empty: has neither observation.yaml nor log.yaml");
}

TEST_F(UsageTest, AServerScoresAsThisProcessDoes) {
  ASSERT_EQ(run({"simulate", kMap, "--out", file("log"), "--steps", "2"}), 0) << errors_;
  ChildProcess server(
      "semview-server", {"--map", kMap, "--bind", "tcp://127.0.0.1:0"}, folder_ / "server");
  ASSERT_TRUE(server.says("listening on tcp://")) << server.errors();
  const std::string text = server.output();
  const std::size_t begin = text.find("tcp://");
  const std::string endpoint = text.substr(begin, text.find('\n', begin) - begin);
  const auto score = [&](Arguments arguments) {
    const Arguments same{"--obs", file("log"), "--frame", "1", "--weights", kMap + "/weights.csv"};
    arguments.insert(arguments.end(), same.begin(), same.end());
    arguments.insert(arguments.end(), {"--pose", "3,-9,90", "--compass"});
    EXPECT_EQ(run(arguments), 0) << errors_;
    return output_;
  };
  const std::string here = score({"score", kMap});
  EXPECT_EQ(score({"score", "duplex_level1", "--server", endpoint}), here);
  EXPECT_THAT(here, HasSubstr("best_yaw_deg"));
  expect_usage({"score",
                "duplex_level1",
                "--server",
                endpoint,
                "--cache",
                "c",
                "--obs",
                "x",
                "--weights",
                "w",
                "--pose",
                "1,1,1"},
               "--cache: is the server's own choice");
}

TEST_F(UsageTest, ADryRunMakesNoCacheAndProgressBeginsWithoutAGuess) {
  const Arguments region{"precompute", kMap, "--cache", file("cache"), "--region", "1,-5,2,-4"};
  Arguments dry = region;
  dry.emplace_back("--dry-run");
  ASSERT_EQ(run(dry), 0) << errors_;
  EXPECT_FALSE(std::filesystem::exists(folder_ / "cache"));
  ASSERT_EQ(run(region), 0) << errors_;
  EXPECT_THAT(output_.substr(0, output_.find('\n')), HasSubstr("\"remaining_s\":null"));
}

}  // namespace
}  // namespace semview
