#include "openni/oni_recorder.hpp"

#include <algorithm>
#include <utility>
#include <variant>

#include "core/error.hpp"
#include "openni/oni_checksum.hpp"
#include "openni/oni_records.hpp"
#include "openni/oni_source.hpp"

namespace credo {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds kTick{100};
/// Of each stream, to find again in the file.
constexpr std::size_t kKept = 5;

Clock::duration seconds(double s) {
  return std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(s));
}

void refuse_existing(fs::path const& file) {
  for (fs::path const& one : {file, oni_checksum_file(file)}) {
    if (fs::exists(one)) {
      throw InputError(one.string() + ": is there already; name a new file to record into");
    }
  }
}

}  // namespace

OniRecorder::OniRecorder(std::string const& uri, SensorConfig const& config, fs::path file)
    : config_(config), file_(std::move(file)) {
  refuse_existing(file_);
  sensor_.emplace(uri, config_);
  uri_ = sensor_->uri();
  std::error_code error;
  if (file_.has_parent_path()) {
    fs::create_directories(file_.parent_path(), error);
  }
  sensor_->start_recording(file_);
  quiet_until_ = Clock::now() + seconds(config_.first_frame_s);
}

OniRecorder::Event OniRecorder::next() {
  SensorImage image = sensor_->next(kTick);
  switch (image.kind) {
    case SensorImage::Kind::kDepth:
      take(std::move(image));
      return Event::kDepth;
    case SensorImage::Kind::kColor:
      if (first_.color.size() < kKept) {
        first_.color.push_back({image.stamp_us, std::move(image.color)});
      }
      return Event::kNothing;
    case SensorImage::Kind::kUnplugged:
    case SensorImage::Kind::kEnd:
      return Event::kUnplugged;
    case SensorImage::Kind::kNone:
    case SensorImage::Kind::kBroken:
      break;
  }
  if (Clock::now() > quiet_until_) {
    quiet_until_ = Clock::now() + seconds(config_.stall_s);
    return Event::kStalled;
  }
  return Event::kNothing;
}

void OniRecorder::take(SensorImage image) {
  quiet_until_ = Clock::now() + seconds(config_.stall_s);
  first_number_ = seen_ == 0 ? image.number : first_number_;
  last_number_ = image.number;
  ++seen_;
  if (first_.depth.size() < kKept) {
    first_.depth.push_back({image.stamp_us, std::move(image.counts)});
  }
}

OniTally OniRecorder::finish() {
  OniTally tally;
  bool const has_color = sensor_->has_color();
  tally.registered = has_color && sensor_->says_registered();
  sensor_->stop_recording();
  sensor_.reset();
  if (seen_ == 0) {
    fs::remove(file_);
    return tally;
  }
  std::uint64_t const end_bytes = index_oni(file_).end_bytes;
  if (end_bytes == 0) {
    throw InputError(file_.string() +
                     ": is not whole: OpenNI2's recorder did not write its end; is the disk full? "
                     "What it holds can be read, and is not verified");
  }
  // The recorder leaves a hole behind the end, as long as all before.
  fs::resize_file(file_, end_bytes);
  if (has_color && !align_oni(file_, first_)) {
    tally.notes.push_back(file_.string() +
                          ": no image of one of its streams was found again, so that colour may be "
                          "of another moment than its depth");
  }
  read_again(tally);
  write_oni_checksum(file_);
  tally.bytes = end_bytes;
  return tally;
}

void OniRecorder::read_again(OniTally& tally) const {
  CaptureConfig everything;
  everything.max_depth_m = 100.0;
  OpenedSource const opened = open_oni(file_, everything, {});
  std::string fault = opened.warnings.empty() ? "" : opened.warnings.front();
  SourceResult result = opened.source->next();
  for (; !std::holds_alternative<EndOfSource>(result); result = opened.source->next()) {
    if (auto const* failure = std::get_if<FrameFailure>(&result); failure != nullptr) {
      fault = fault.empty() ? failure->message : fault;
    } else {
      ++tally.frames;
    }
  }
  // The first that was taken may have waited since before the recording began.
  if (fault.empty() && tally.frames < seen_ - 1) {
    fault = file_.string() + ": holds " + std::to_string(tally.frames) + " depth images of " +
            std::to_string(seen_) + " that came";
  }
  if (!fault.empty()) {
    throw InputError(fault + ": it was not recorded whole; is the disk full, or too slow?");
  }
  tally.missed = std::max<std::int64_t>(last_number_ - first_number_ + 1 - tally.frames, 0);
}

}  // namespace credo
