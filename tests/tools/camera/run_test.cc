// Whole runs of dhcal_ruler: from images in files to a recording.
#include "tools/camera/run.h"

#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <ctime>
#include <sstream>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "core/base/units.h"
#include "core/model/recording.h"
#include "problems/formats/problem/problem_reader.h"
#include "problems/formats/recording/recording_reader.h"
#include "tests/support/comma_locale.h"
#include "tests/support/files.h"
#include "tests/support/ruler_scene.h"
#include "tests/support/temp_folder.h"
#include "tests/tools/camera/camera_images.h"

namespace dhcal {
namespace {

using Eigen::Vector3d;
using testing::HasSubstr;
using testing::Not;

RulerScene SceneAt(double x) {
  RulerScene scene;
  scene.noise = 0.01;
  scene.seed = static_cast<std::uint64_t>(1000 * x);
  scene.missing = {static_cast<int>(x) + 3};
  scene.X_RC = CameraOver(x, 0.3, 70, Vector3d(0.2 * std::sin(x), 0.3 * std::cos(x), 0.1));
  return scene;
}

/// Photographs at places along the ruler, and a run over them.
class Photographs : public testing::Test {
 protected:
  void Take(const std::vector<double>& places) {
    for (const double x : places) {
      Save(Photograph(SceneAt(x)));
      truth_.push_back(TrueReading(SceneAt(x)));
    }
  }
  void Save(const cv::Mat& image) {
    command_.images.push_back(folder_ / fmt::format("image{:02}.png", command_.images.size()));
    cv::imwrite(command_.images.back(), image);
  }
  int Run() {
    std::ostringstream out, messages;
    const int status = RunRuler(command_, out, messages);
    out_ = out.str();
    messages_ = messages.str();
    return status;
  }
  /// Two placements of the ruler, coarse positions off by a tenth of a pitch and a common offset.
  std::string Readings() const {
    std::string text =
        "q1_deg,q2_deg,q3_deg,q4_deg,q5_deg,q6_deg,edge,run,height1_mm,height2_mm,coarse_mm,"
        "image\n";
    for (std::size_t k = 0; k < truth_.size(); ++k) {
      text += fmt::format("{0},10,20,30,40,50,{1},a,{2},60.25,{3},image{0:02}.png\n",
                          k,
                          2 * k < truth_.size() ? "E01" : "E02",
                          59.5 + 0.125 * static_cast<double>(k),
                          truth_[k] + 340.2 + (k % 2 == 0 ? 0.1 : -0.1));
    }
    return text;
  }

  /// ruler_mm of the table that was printed.
  std::vector<double> RulerColumn() const {
    std::vector<double> numbers;
    std::istringstream table(out_);
    std::string line;
    std::getline(table, line);
    while (std::getline(table, line)) numbers.push_back(std::stod(line.substr(line.find(',') + 1)));
    return numbers;
  }

  TempFolder folder_;
  RulerCommand command_;
  std::vector<double> truth_;
  std::string out_, messages_;
};

TEST_F(Photographs, BecomeARecordingThatTheIdentifierLoads) {
  Take({20.13, 46.4, 71.95, 98.02, 33.3, 59.21});
  WriteFile(folder_ / "readings.csv", Readings());
  command_.pitch = "1";
  command_.readings = folder_ / "readings.csv";
  command_.out = folder_ / "recording.csv";
  command_.details = folder_ / "details.csv";
  ASSERT_EQ(Run(), kRulerOk) << messages_;

  Diagnostics diagnostics;
  const auto spec = ReadProblemFile(SourcePath("problems/cases/kr15_edges.yaml"), "", &diagnostics);
  ASSERT_TRUE(spec) << diagnostics.ToString();
  const auto recording = ReadRecording(folder_ / "recording.csv", spec->robot.joints, &diagnostics);
  ASSERT_TRUE(recording) << diagnostics.ToString();
  EXPECT_EQ(diagnostics.all().size(), 0) << diagnostics.ToString();
  ASSERT_EQ(recording->num_rows(), 6);
  EXPECT_THAT(recording->edge_names, testing::ElementsAre("E01", "E02"));
  for (const int row : {1, 2, 4, 5}) {
    const double moved = (recording->head(row, 0) - recording->head(row - 1, 0)) / kMillimetre;
    EXPECT_NEAR(moved, truth_[row] - truth_[row - 1], 0.001) << "[mm], row " << row;
  }
  EXPECT_NEAR(recording->head(3, 1), 0.059875, 1e-12);
  EXPECT_THAT(ReadFile(folder_ / "details.csv"), HasSubstr("image,ruler_mm,ruler_sigma_mm"));
}

TEST_F(Photographs, TellTheSameWhateverTheThreadsAndTheLocale) {
  Take({20.13, 46.2, 72.05});
  command_.pitch = "1";
  command_.step = "26";
  ASSERT_EQ(Run(), kRulerOk) << messages_;
  const std::string first = out_;
  command_.threads = "1";
  const CommaLocale locale;
  ASSERT_EQ(Run(), kRulerOk);
  EXPECT_EQ(out_, first);
}

TEST_F(Photographs, InColourAndIn16BitsSayTheSame) {
  Take({20.13});
  cv::Mat colour;
  cv::cvtColor(Photograph(SceneAt(20.13)), colour, cv::COLOR_GRAY2BGR);
  Save(colour);
  Save(Photograph(SceneAt(20.13), CV_16U));
  command_.pitch = "1";
  command_.step = "0";
  ASSERT_EQ(Run(), kRulerOk) << messages_;
  ASSERT_EQ(RulerColumn().size(), 3);
  for (const double ruler : RulerColumn()) {
    EXPECT_NEAR(std::remainder(ruler - truth_[0], 1), 0, 0.0005);
  }
}

TEST_F(Photographs, ThatCannotBeReadLeaveNothingWritten) {
  Take({20.13, 46.4});
  command_.pitch = "1";
  command_.step = "26.3";
  command_.out = folder_ / "out.csv";
  const auto with = [&](const std::string& name, const std::string& content) {
    WriteFile(folder_ / name, content);
    command_.images.back() = folder_ / name;
    EXPECT_EQ(Run(), kRulerBadInput);
    EXPECT_FALSE(NamesIn(folder_.path()).count("out.csv"));
    EXPECT_THAT(messages_, HasSubstr(folder_ / name));
    return messages_;
  };
  EXPECT_THAT(with("text.png", "no image"), HasSubstr("is no image that can be read"));
  EXPECT_THAT(with("empty.png", ""), HasSubstr("is empty"));
  const std::string whole = ReadFile(command_.images.front());
  EXPECT_THAT(with("cut.png", whole.substr(0, 200)), HasSubstr("error"));

  const auto saved = [&](const cv::Mat& image) {
    command_.images.pop_back();
    Save(image);
    EXPECT_EQ(Run(), kRulerBadInput);
    return messages_;
  };
  EXPECT_THAT(saved(cv::Mat(480, 640, CV_8U, cv::Scalar(90))), HasSubstr("one brightness"));
  RulerScene one = SceneAt(46.4);
  for (int k = 0; k < 100; ++k) {
    if (k != 47) one.missing.insert(k);
  }
  EXPECT_THAT(saved(Photograph(one)), HasSubstr("no row of rulings"));
  EXPECT_THAT(saved(cv::Mat(20, 20, CV_8U, cv::Scalar(90))), HasSubstr("at least 32 x 32"));
  cv::Mat small;
  cv::resize(Photograph(SceneAt(46.4)), small, {}, 0.5, 0.5);
  EXPECT_THAT(saved(small), HasSubstr("all must be of one camera"));
}

TEST_F(Photographs, OfAWrongPitchDirectionOrStepAreRefused) {
  Take({20.13, 46.4, 71.95, 98.02, 133.3, 159.21});
  WriteFile(folder_ / "readings.csv", Readings());
  command_.coarse = folder_ / "readings.csv";
  command_.pitch = "1.3";
  EXPECT_EQ(Run(), kRulerBadInput);
  EXPECT_THAT(messages_, HasSubstr("wrong pitch, direction or coarse position?"));
  command_.pitch = "1";
  command_.direction = "left";
  EXPECT_EQ(Run(), kRulerBadInput);
  EXPECT_EQ(out_, "");
  command_.direction = "down";
  EXPECT_EQ(Run(), kRulerBadInput);
}

TEST_F(Photographs, ThatAreSkippedLeaveTheirRowsBlank) {
  Take({20.13, 46.4, 71.95});
  cv::imwrite(command_.images[1], cv::Mat(cv::Mat::zeros(480, 640, CV_8U)) + cv::Scalar(0));
  cv::Mat spotted = cv::Mat::zeros(480, 640, CV_8U);
  spotted.at<unsigned char>(100, 100) = 255;
  cv::imwrite(command_.images[1], spotted);
  WriteFile(folder_ / "readings.csv", Readings());
  command_.pitch = "1";
  command_.readings = folder_ / "readings.csv";
  EXPECT_EQ(Run(), kRulerBadInput);
  command_.skip = true;
  EXPECT_EQ(Run(), kRulerSkipped) << messages_;
  EXPECT_THAT(out_, HasSubstr("1,10,20,30,40,50,E01,a,,,\n"));
  EXPECT_THAT(messages_, HasSubstr("its row is left blank"));
}

TEST_F(Photographs, NeedWordsThatFit) {
  const auto message = [&](auto change) {
    const RulerCommand kept = command_;
    change(&command_);
    EXPECT_EQ(Run(), kRulerBadInput);
    command_ = kept;
    return messages_;
  };
  Take({20.13, 46.4});
  command_.pitch = "1";
  command_.step = "26.3";
  EXPECT_THAT(message([](RulerCommand* c) { c->pitch = ""; }), HasSubstr("--pitch_mm is missing"));
  EXPECT_THAT(message([](RulerCommand* c) { c->pitch = "-1"; }), HasSubstr("--pitch_mm is '-1'"));
  EXPECT_THAT(message([](RulerCommand* c) { c->step = ""; }), HasSubstr("how many rulings lie"));
  EXPECT_THAT(message([](RulerCommand* c) { c->direction = "east"; }), HasSubstr("'east'"));
  EXPECT_THAT(message([](RulerCommand* c) { c->images.clear(); }), HasSubstr("no images"));
  EXPECT_THAT(message([](RulerCommand* c) { c->lens = "/none.yaml"; }), HasSubstr("/none.yaml"));
  WriteFile(folder_ / "short.csv", "q1_deg,edge,coarse_mm\n1,E,2\n");
  EXPECT_THAT(message([&](RulerCommand* c) { c->readings = folder_ / "short.csv"; }),
              HasSubstr("has 1 rows, but 2 images"));
  WriteFile(folder_ / "lacks.csv", "q1_deg,coarse_mm\n1,2\n3,4\n");
  EXPECT_THAT(message([&](RulerCommand* c) { c->readings = folder_ / "lacks.csv"; }),
              HasSubstr("lacks the columns height1_mm and height2_mm"));
  WriteFile(folder_ / "swapped.csv", "coarse_mm,image\n1,image01.png\n3,image00.png\n");
  EXPECT_THAT(message([&](RulerCommand* c) { c->coarse = folder_ / "swapped.csv"; }),
              HasSubstr("in the order of the rows"));
}

TEST_F(Photographs, StraightenTheirLens) {
  for (const double x : {20.1, 33.5, 46.9, 60.3}) {
    RulerScene scene = SceneAt(x);
    scene.k1 = -0.15;
    Save(Photograph(scene));
    truth_.push_back(TrueReading(scene));
  }
  command_.calibrate = folder_ / "lens.yaml";
  ASSERT_EQ(Run(), kRulerOk) << messages_;
  EXPECT_THAT(out_, HasSubstr("lens from 4 of 4 images"));
  command_.calibrate = "";
  command_.lens = folder_ / "lens.yaml";
  command_.pitch = "1";
  command_.step = "13.4";
  EXPECT_EQ(Run(), kRulerOk) << messages_;
  EXPECT_THAT(messages_, Not(HasSubstr("calibrate the lens")));
  const std::vector<double> ruler = RulerColumn();
  ASSERT_EQ(ruler.size(), 4);
  for (std::size_t k = 1; k < 4; ++k) {
    EXPECT_NEAR(ruler[k] - ruler[k - 1], truth_[k] - truth_[k - 1], 0.005) << "[mm]";
  }
}

// 1,000 images below 60 s; ctest -L slow -R SlowRulerTime prints how long they took.
TEST(SlowRulerTime, OfAThousandImages) {
  for (const int size : {1, 2}) {
    const TempFolder folder;
    RulerCommand command;
    std::vector<std::string> files;
    for (int k = 0; k < 20; ++k) {
      RulerScene scene = RandomScene({}, static_cast<std::uint64_t>(30001 + k));
      scene.width *= size;
      scene.height *= size;
      scene.focal *= size;
      scene.centre = Eigen::Vector2d(320 * size - 0.5, 240 * size - 0.5);
      scene.k1 = scene.k2 = 0;
      // All at the same place between two rulings, so that they can be counted as one series.
      const double x = TrueReading(scene);
      scene.X_RC.translation().x() += std::round(x) - x;
      files.push_back(folder / fmt::format("{}.png", k));
      cv::imwrite(files.back(), Photograph(scene));
    }
    for (int k = 0; k < 1000; ++k)
      command.images.push_back(files[static_cast<std::size_t>(k % 20)]);
    command.pitch = "1";
    command.step = "0";
    command.skip = true;
    std::ostringstream out, messages;
    const auto begin = std::chrono::steady_clock::now();
    const std::clock_t cpu = std::clock();
    EXPECT_NE(RunRuler(command, out, messages), kRulerBadInput) << messages.str();
    const double seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    const double cpu_seconds = static_cast<double>(std::clock() - cpu) / CLOCKS_PER_SEC;
    printf("1,000 images of %d x %d px: %.1f s, %.1f CPU s\n",
           640 * size,
           480 * size,
           seconds,
           cpu_seconds);
    EXPECT_LT(cpu_seconds, 100) << "0.1 s for each";
  }
}

}  // namespace
}  // namespace dhcal
