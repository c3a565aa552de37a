#include "tools/camera/run.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <opencv2/core.hpp>

#include "core/base/parallel.h"
#include "core/base/text.h"
#include "core/io/whole_file.h"
#include "tools/camera/calibrate_lens.h"
#include "tools/camera/count.h"
#include "tools/camera/gray_image.h"
#include "tools/camera/lens_file.h"
#include "tools/camera/readings.h"
#include "tools/camera/settings.h"
#include "tools/camera/tables.h"

namespace dhcal {
namespace {

/// What is kept of an image.
struct SeenImage {
  Diagnostics diagnostics;  // why it is no image
  int width = 0, height = 0;
  RulerReading reading;
  CountedRulings counted;  // for the calibration of a lens
};

/// Reads all images, each by itself, and does `work` with each.
template <typename Work>
std::vector<SeenImage> SeeAll(const std::vector<std::string>& files,
                              int threads,
                              Diagnostics* diagnostics,
                              const Work& work) {
  cv::setNumThreads(1);  // one thread for each image
  std::vector<SeenImage> images(files.size());
  ParallelFor(
      static_cast<int>(files.size()),
      [&](int k) {
        SeenImage& image = images[static_cast<std::size_t>(k)];
        const auto gray = ReadGrayImage(files[static_cast<std::size_t>(k)], &image.diagnostics);
        if (!gray) return;
        image.width = gray->cols;
        image.height = gray->rows;
        work(*gray, &image);
      },
      threads);
  for (const SeenImage& image : images) {
    for (const Diagnostic& message : image.diagnostics.all()) diagnostics->Add(message);
  }
  return images;
}

/// All images must be of one size, that of the lens where there is one.
void CheckSizes(const std::vector<SeenImage>& images,
                const RulerCommand& command,
                const std::optional<Lens>& lens,
                Diagnostics* diagnostics) {
  int width = lens ? lens->width : 0, height = lens ? lens->height : 0;
  const std::string whose = lens ? command.lens + " is for" : "the first image has";
  for (std::size_t k = 0; k < images.size(); ++k) {
    if (images[k].width == 0) continue;
    if (width == 0) {
      width = images[k].width;
      height = images[k].height;
    }
    if (images[k].width == width && images[k].height == height) continue;
    diagnostics->Error({command.images[k]},
                       fmt::format("has {} x {} px, but {} {} x {}; all must be of one camera",
                                   images[k].width,
                                   images[k].height,
                                   whose,
                                   width,
                                   height));
  }
}

int CalibrateTheLens(const RulerCommand& command,
                     const RulerSettings& settings,
                     std::ostream& out,
                     Diagnostics* diagnostics) {
  const std::vector<SeenImage> images = SeeAll(
      command.images, settings.threads, diagnostics, [&](const cv::Mat& gray, SeenImage* image) {
        image->counted = CountRulings(gray, PlainLens(gray.cols, gray.rows), settings.ruler);
      });
  CheckSizes(images, command, std::nullopt, diagnostics);
  if (!diagnostics->ok()) return kRulerBadInput;
  std::vector<CountedRulings> counted;
  for (const SeenImage& image : images) counted.push_back(image.counted);
  const StraightenedLens lens =
      CalibrateLens(PlainLens(images[0].width, images[0].height), counted, settings.ruler);
  if (!lens.failure.empty()) {
    diagnostics->Error({command.calibrate}, "is not written: " + lens.failure);
    return kRulerBadInput;
  }
  if (!WriteWholeFile(command.calibrate, LensToYaml(lens), diagnostics)) return kRulerBadInput;
  out << fmt::format(
      "{}: lens from {} of {} images; rulings scatter by {:.3f} px about straight, even "
      "rows, {:.3f} px without it\n",
      command.calibrate,
      lens.images,
      images.size(),
      lens.rms_after,
      lens.rms_before);
  return kRulerOk;
}

/// Coarse positions of all images [mm].
std::vector<double> CoarseOf(const RulerSettings& settings,
                             const std::optional<Readings>& readings,
                             const std::optional<Readings>& coarse,
                             std::size_t images) {
  if (coarse) return coarse->coarse_positions;
  if (readings && !readings->coarse_positions.empty()) return readings->coarse_positions;
  std::vector<double> steps;
  for (std::size_t k = 0; k < images; ++k) steps.push_back(settings.step * static_cast<double>(k));
  return steps;
}

/// Where along the rulings each image is, with its doubts. `groups` may be empty.
std::vector<CountedPlace> CountedPlaces(const RulerSettings& settings,
                                        const std::vector<RulerReading>& found,
                                        const std::vector<double>& coarse,
                                        const std::vector<int>& groups) {
  std::vector<ImagePlace> places;
  for (std::size_t k = 0; k < found.size(); ++k) {
    const RulerReading& reading = found[k];
    places.push_back({reading.refusal.empty(),
                      reading.place,
                      reading.px_per_pitch,
                      coarse[k] / settings.pitch,
                      groups.empty() ? 0 : groups[k]});
  }
  return CountAlong(places, settings.coarse_error / settings.pitch);
}

/// Ruler coordinates [mm], NaN where there is none; errors (with `skip`, warnings) say why.
std::vector<double> RulerPlaces(const RulerCommand& command,
                                const RulerSettings& settings,
                                const std::vector<RulerReading>& found,
                                const std::vector<CountedPlace>& counted,
                                Diagnostics* diagnostics) {
  std::vector<double> ruler;
  for (std::size_t k = 0; k < found.size(); ++k) {
    ruler.push_back(counted[k].place * settings.pitch);
    const std::string& why = found[k].refusal.empty() ? counted[k].doubt : found[k].refusal;
    if (why.empty()) continue;
    if (command.skip) {
      diagnostics->Warning({command.images[k]}, why + "; its row is left blank");
    } else {
      diagnostics->Error({command.images[k]}, why);
    }
  }
  return ruler;
}

/// The tables, or the first alone where there is a file for nothing else.
void WriteTables(const RulerCommand& command,
                 const std::string& recording,
                 const std::string& details,
                 std::ostream& out,
                 Diagnostics* diagnostics) {
  if (!command.details.empty() && !WriteWholeFile(command.details, details, diagnostics)) return;
  const std::string& table = recording.empty() ? details : recording;
  if (command.out.empty()) {
    out << table;
  } else {
    WriteWholeFile(command.out, table, diagnostics);
  }
}

int ReadTheRuler(const RulerCommand& command,
                 const RulerSettings& settings,
                 std::ostream& out,
                 std::ostream& messages,
                 Diagnostics* diagnostics) {
  std::optional<Lens> lens;
  std::optional<Readings> readings, coarse;
  if (!command.lens.empty()) lens = ReadLensFile(command.lens, diagnostics);
  if (!command.readings.empty()) {
    readings = ReadReadings(command.readings, command.images, diagnostics);
    if (readings) CheckReadings(*readings, command.readings, diagnostics);
  }
  if (!command.coarse.empty()) coarse = ReadReadings(command.coarse, command.images, diagnostics);
  const Readings* const told = coarse ? &*coarse : readings ? &*readings : nullptr;
  if (told != nullptr && told->coarse < 0 && command.step.empty()) {
    diagnostics->Error(
        {coarse ? command.coarse : command.readings, 1},
        "lacks the column coarse_mm: where the camera roughly is along the ruler; add "
        "it, or give --coarse or --step_mm");
  }
  if (!diagnostics->ok()) return kRulerBadInput;
  std::vector<SeenImage> images = SeeAll(
      command.images, settings.threads, diagnostics, [&](const cv::Mat& gray, SeenImage* image) {
        image->reading =
            ReadRulings(gray, lens ? *lens : PlainLens(gray.cols, gray.rows), settings.ruler);
      });
  CheckSizes(images, command, lens, diagnostics);
  if (!diagnostics->ok()) return kRulerBadInput;

  std::vector<RulerReading> found;
  for (SeenImage& image : images) found.push_back(std::move(image.reading));
  const std::vector<CountedPlace> counted =
      CountedPlaces(settings,
                    found,
                    CoarseOf(settings, readings, coarse, found.size()),
                    readings ? readings->groups : std::vector<int>());
  const std::vector<double> ruler = RulerPlaces(command, settings, found, counted, diagnostics);
  const auto lost =
      std::count_if(ruler.begin(), ruler.end(), [](double x) { return std::isnan(x); });
  if (diagnostics->ok() && 2 * lost > static_cast<std::ptrdiff_t>(ruler.size())) {
    diagnostics->Error({"command line"},
                       "most of the images cannot be read, so that the others cannot be relied on "
                       "(wrong --pitch_mm, --direction or coarse positions?)");
  }
  if (!diagnostics->ok()) return kRulerBadInput;
  Remark(command, found, diagnostics);
  WriteTables(command,
              readings ? RecordingText(*readings, ruler) : "",
              DetailsText(command, found, ruler, settings.pitch),
              out,
              diagnostics);
  if (!diagnostics->ok()) return kRulerBadInput;
  messages << Summary(found, ruler, settings.pitch);
  return lost > 0 ? kRulerSkipped : kRulerOk;
}

}  // namespace

int RunRuler(const RulerCommand& command, std::ostream& out, std::ostream& messages) {
  Diagnostics diagnostics;
  const RulerSettings settings = ReadSettings(command, &diagnostics);
  int status = kRulerBadInput;
  if (diagnostics.ok()) {
    status = command.calibrate.empty()
                 ? ReadTheRuler(command, settings, out, messages, &diagnostics)
                 : CalibrateTheLens(command, settings, out, &diagnostics);
  }
  messages << diagnostics.ToString();
  return status;
}

}  // namespace dhcal
