#include "dspm/looking/serve/live_page.h"

#include <time.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <thread>

#include "dspm/base/math/moments.h"
#include "dspm/base/system/cancellation.h"
#include "dspm/base/system/json.h"
#include "dspm/base/system/parallel.h"
#include "dspm/image/image.h"
#include "dspm/looking/serve/describe_run.h"
#include "dspm/session/job/developed.h"

namespace dspm {
namespace {

constexpr std::chrono::milliseconds kTick(30);
constexpr int kKeptWidth = 256;  // of the pictures that stay of earlier intervals
constexpr int kCoarseHalvings = 2;
constexpr double kShareOfASet = 0.005;  // of the whole run, for one picture of all that is looked at
static_assert(1 << kCoarseHalvings == kQuickShare);

double processor_seconds() {
  timespec time = {};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

int slot_of(const Job& job, FileFrame frame) {
  return static_cast<int>(std::lower_bound(job.frames.begin(), job.frames.end(), frame) - job.frames.begin());
}

}  // namespace

int LivePage::halvings() const { return coarse_ ? kCoarseHalvings : 0; }

void LivePage::begin() {
  orders_.begin();
  allow_work();
  step_ = "reading the scene";
  show_state("rendering");
}

void LivePage::restart() {
  orders_.restart();
  discard_work();
}

bool LivePage::wait_for_restart(const std::function<bool()>& interrupted) {
  show_state("waiting for an edit");
  while (!end_wanted() && !interrupted()) std::this_thread::sleep_for(kTick);
  return is_restarting();
}

void LivePage::begin_run(const Job& job, const Scene& scene, const Integrator& integrator, int iterations,
                         bool coarse) {
  job_ = &job, coarse_ = coarse, iterations_ = iterations;
  guided_ = job.settings.file != nullptr;
  progress_ = {}, outlook_ = {};
  begin_ = processor_seconds();
  outputs_.clear();
  const std::vector<std::string>& asked = job.outputs;
  for (const OutputInfo& output : integrator.outputs())
    if (output.name == kRadiance || std::find(asked.begin(), asked.end(), output.name) != asked.end())
      outputs_.push_back(output);
  pictures_.reset();
  gallery_.begin_run(static_cast<int>(job.frames.size()));
  board_.set_run(describe_run(job, scene, outputs_, view_, ++run_, halvings()));
  show_state("rendering");
}

void LivePage::step_begins(const std::string& step) {
  step_ = step;
  show_state("rendering");
}

void LivePage::iteration_done(const IntervalProgress& progress, const Exhibit& exhibit, const Outlook& outlook) {
  progress_ = progress, outlook_ = outlook;
  // What was never seen, somebody waits for; after four iterations the noise has halved.
  const bool is_telling = progress.iterations == 1 || progress.iterations == 4;
  show_pictures(exhibit, is_telling || pictures_.is_due() ? Gallery::kNewer : 0, Size::affordable);
  show_state("rendering");
}

void LivePage::show_pictures(const Exhibit& exhibit, int iterations, Size size) {
  const std::vector<Wish> wishes = gallery_.wanted(iterations);
  if (wishes.empty()) return;
  const int shrunk = size == Size::affordable ? halvings_to_afford(wishes) : 0;
  const Ration::Clock::time_point begin = Ration::Clock::now();
  const double spent = processor_seconds();
  take(exhibit, wishes, shrunk);
  const double took = processor_seconds() - spent;
  looking_ += took, pixels_ += pixels_of(wishes, shrunk);
  pictures_.took(begin);
}

/// Returns the pixels of the wishes' pictures, each halved `shrunk` times more.
double LivePage::pixels_of(const std::vector<Wish>& wishes, int shrunk) const {
  double sum = 0;
  for (const Wish& wish : wishes)
    sum += std::ldexp(job_->settings.crop.count(), -2 * (std::max(wish.halvings - halvings(), 0) + shrunk));
  return sum;
}

/// Returns how much smaller pictures must be. A short run of many large frames gets smaller ones, until there is time
/// for those that were wished for.
int LivePage::halvings_to_afford(const std::vector<Wish>& wishes) const {
  if (coarse_ || !(outlook_.share > 0) || pixels_ == 0) return 0;
  const double run = (processor_seconds() - begin_) / outlook_.share;
  const double a_pixel = looking_ / pixels_;
  int shrunk = 0;
  while (shrunk < kCoarseHalvings && pixels_of(wishes, shrunk) * a_pixel > kShareOfASet * run) ++shrunk;
  return shrunk;
}

/// Takes pictures, a few at a time: images are large, and their compression takes a thread for each.
void LivePage::take(const Exhibit& exhibit, const std::vector<Wish>& wishes, int shrunk) {
  std::vector<Picture> pictures;
  std::vector<Taken> batch;
  const auto finish_batch = [&] {
    const std::size_t first = pictures.size();
    pictures.resize(first + batch.size());
    parallel_for(static_cast<std::int64_t>(batch.size()), 1, [&](std::int64_t i) {
      const auto slot = static_cast<std::size_t>(i);
      Picture& picture = pictures[first + slot] = picture_of(std::move(batch[slot]), shrunk);
      picture.iterations = exhibit.iterations, picture.coarse = coarse_;
      picture.shrunk = shrunk > 0;
    });
    batch.clear();
  };
  for (const Wish& wish : wishes) {
    if (is_restarting()) return;  // whoever looks has edited the scene
    if (std::optional<Taken> taken = take_one(exhibit, wish)) batch.push_back(std::move(*taken));
    if (static_cast<int>(batch.size()) >= thread_count()) finish_batch();
  }
  finish_batch();
  gallery_.put(std::move(pictures));
}

/// Returns nullopt if the integrator does not have the picture.
std::optional<LivePage::Taken> LivePage::take_one(const Exhibit& exhibit, const Wish& wish) const {
  const auto output =
      std::find_if(outputs_.begin(), outputs_.end(), [&](const OutputInfo& o) { return o.name == wish.output; });
  const auto place = std::find_if(exhibit.interval.begin(), exhibit.interval.end(),
                                  [&](FileFrame frame) { return slot_of(*job_, frame) == wish.frame; });
  if (output == outputs_.end() || place == exhibit.interval.end()) return std::nullopt;
  Image image = exhibit.integrator.estimate(static_cast<Frame>(place - exhibit.interval.begin()), output->name);
  if (output->name == kRadiance) image = developed(std::move(image), *job_);
  if (output->is_radiance) image = exposed(std::move(image), *job_);
  return Taken{wish, &*output, std::move(image)};
}

Picture LivePage::picture_of(Taken taken, int shrunk) const {
  Wish of_run = taken.wish;
  of_run.halvings = std::max(taken.wish.halvings - halvings(), 0) + shrunk;
  Picture picture = make_picture(of_run, *taken.output, std::move(taken.image));
  picture.wish = std::move(taken.wish);
  return picture;
}

void LivePage::interval_ends(const Exhibit& exhibit) {
  if (exhibit.iterations == 0 || exhibit.interval.size() == job_->frames.size()) return;
  int kept = 0;
  while (job_->settings.crop.width() << halvings() >> kept > kKeptWidth) ++kept;
  std::vector<Wish> wishes = gallery_.wanted();
  for (const FileFrame frame : exhibit.interval) wishes.push_back({slot_of(*job_, frame), kRadiance, kept});
  take(exhibit, wishes);
}

void LivePage::wait_while_paused(const Exhibit& exhibit, const std::function<bool()>& interrupted) {
  if (!orders_.is_paused()) return;
  const char* const phase = "paused";
  show_state(phase);
  while (orders_.is_paused() && !end_wanted() && !interrupted()) {
    std::this_thread::sleep_for(kTick);
    show_pictures(exhibit, exhibit.iterations);
  }
  show_state("rendering");
}

int LivePage::wait_for_more(const Exhibit& exhibit, const std::function<bool()>& interrupted) {
  show_state("done");
  while (!end_wanted() && !interrupted()) {
    const int room = std::max(Orders::kMostIterations - exhibit.iterations, 0);
    if (const int more = std::min(orders_.take_iterations(), room); more > 0) {
      iterations_ = exhibit.iterations + more;
      return show_state("rendering"), more;
    }
    std::this_thread::sleep_for(kTick);
    show_pictures(exhibit, exhibit.iterations);
  }
  return 0;
}

void LivePage::show_state(const char* phase) {
  JsonWriter json;
  json.begin_object();
  json.member("run", run_);
  json.member("phase", phase);
  json.member("coarse", coarse_ ? 1 : 0);
  json.member("guided", guided_ ? 1 : 0);
  json.member("step", step_);
  json.member("iterations", progress_.iterations);
  json.member("of", iterations_);
  json.member("seconds", outlook_.seconds);
  json.member("looking", looking_);
  json.member("share", outlook_.share);
  if (outlook_.seconds_left) json.member("left", *outlook_.seconds_left);
  if (progress_.error) json.member("error", *progress_.error);
  json.end_object();
  std::string line = json.text();
  std::erase(line, '\n');  // none is within a text: those are escaped
  board_.set_state(std::move(line));
}

}  // namespace dspm
