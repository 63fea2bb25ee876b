// A frame among others against the same frame in a file of its own, in scenes whose photons are worth less to it among
// others: lights are chosen for all frames of a file alike, and the disk of distant ones covers what is in any of them.
#include <cmath>

#include "bench/measure/convergence.h"
#include "bench/measure/noise.h"
#include "bench/measure/rounds.h"
#include "bench/report/progress.h"
#include "bench/report/table.h"
#include "bench/sections/sections.h"
#include "dspm/base/math/moments.h"
#include "dspm/image/image.h"
#include "dspm/world/scene/scene.h"

namespace dspm {
namespace {

constexpr int kOwnSeed = 500;  // a frame in a file of its own shares no seed with the joint run

struct Case {
  std::filesystem::path file;
  bool quick;          // a quarter of the width and height
  int photons;         // per iteration
  std::size_t frames;  // this many are compared
};

std::vector<Case> cases() {
  const std::filesystem::path here = std::filesystem::path(DSPM_SOURCE_DIR) / "bench";
  return {{here / "eight_lamps.dsc", false, 4000, 2},
          {here / "rising_ball.dsc", false, 4000, 3},
          {our_scene("lamp"), true, 300000 / 16, 6}};
}

struct Effort {
  int iterations, seeds, reference, rounds;
};

/// Relative errors, and the standard deviation together over that alone.
struct Row {
  std::string frame;
  double together = 0, own = 0, deviation = 0;
  int iterations_in_time = 0;  // of the frame's own file, in the time of one frame of the joint run
  double own_in_time = 0;
};

Choices choices_of(const Case& c) {
  Choices choices;
  choices.quick = c.quick;
  return choices;
}

/// A frame alone in its file.
class Own {
 public:
  Own(const Case& c, FileFrame frame, const Effort& effort)
      : effort_(effort),
        file_(load(c.file, choices_of(c), frame)),
        job_(with_integer(file_.job, "photons", c.photons)),
        scene_(file_.world->scene(job_.frames)),
        truth_(long_run(*scene_, job_, effort.reference)) {}

  const Images& truth() const { return truth_; }
  Images by_seed(int iterations) const {
    Images all;
    for (int seed = kOwnSeed; seed < kOwnSeed + effort_.seeds; ++seed)
      all.push_back(rendered(*scene_, "sppm", job_, seed, iterations).front());
    return all;
  }
  Run run() const { return start(file_, job_, "sppm", job_.frames); }

 private:
  Effort effort_;
  LoadedScene file_;
  Job job_;
  std::unique_ptr<Scene> scene_;
  Images truth_;
};

/// The mean over images of one frame.
double mean_error(const Images& by_seed, const Images& truth) {
  double sum = 0;
  for (const Image& image : by_seed) sum += error_of({image}, truth);
  return sum / static_cast<double>(by_seed.size());
}

/// Up to a factor that is the same for equally many images. From differences between seeds, so without bias.
double deviation(const Images& by_seed, const Images& truth) {
  double sum = 0;
  for (std::size_t s = 1; s < by_seed.size(); ++s) sum += relative_square(by_seed[s], by_seed[s - 1], truth.front());
  return std::sqrt(sum);
}

/// In a frame's share of the joint run's time.
int iterations_in_time(const LoadedScene& loaded, const Job& job, const Own& own, const Effort& effort) {
  std::vector<Group> groups(2);
  groups[0].push_back(start(loaded, job, "dsppm", job.frames));
  groups[1].push_back(own.run());
  const std::vector<Rounds> rounds = in_turns(groups, effort.rounds);
  const double frames = ratios(rounds[0], rounds[1]).back();  // of their own files, in the time of a joint iteration
  return std::max(1,
                  static_cast<int>(std::lround(effort.iterations * frames / static_cast<double>(job.frames.size()))));
}

struct Measured {
  std::string name;
  std::size_t frames;
  std::vector<Row> rows;
  std::string told;  // by --explain
};

Measured measure_one(const Case& c, const Effort& effort) {
  const LoadedScene loaded = load(c.file, choices_of(c));
  const Job job = with_integer(loaded.job, "photons", c.photons);
  Measured m{c.file.stem().string(), job.frames.size(), {}, {}};
  for (const std::string& line : loaded.world->explain(job.frames))
    if (line.find("of its own") != line.npos) m.told += "* " + line + "\n";
  const std::unique_ptr<Scene> scene = loaded.world->scene(job.frames);
  say("{}: all frames together", m.name);
  std::vector<Images> runs;
  for (int seed = 0; seed < effort.seeds; ++seed)
    runs.push_back(rendered(*scene, "dsppm", job, seed, effort.iterations));
  for (const FileFrame f : spread_frames(job.frames, c.frames)) {
    Row row{job.description->frames.label(f)};
    say("{}: frame {} alone", m.name, row.frame);
    const Own own(c, f, effort);
    Images together;
    for (const Images& images : runs) together.push_back(images[f.slot()]);
    const Images alone = own.by_seed(effort.iterations);
    row.together = mean_error(together, own.truth()), row.own = mean_error(alone, own.truth());
    row.deviation = deviation(together, own.truth()) / deviation(alone, own.truth());
    row.iterations_in_time = iterations_in_time(loaded, job, own, effort);
    row.own_in_time = mean_error(own.by_seed(row.iterations_in_time), own.truth());
    m.rows.push_back(row);
  }
  return m;
}

std::string error_cell(double error) { return fmt::format("{:.3f}", error); }

std::string table_of(const std::vector<Measured>& all, int iterations) {
  Table table({"scene", "frames", "frame", fmt::format("error together, {} iterations", iterations),
               "in a file of its own", "ratio", "standard deviations' ratio", "iterations of its own in equal time",
               "error", "ratio"});
  for (const Measured& m : all)
    for (const Row& row : m.rows)
      table.row({m.name, std::to_string(m.frames), row.frame, error_cell(row.together), error_cell(row.own),
                 ratio_cell(row.together / row.own), ratio_cell(row.deviation), std::to_string(row.iterations_in_time),
                 error_cell(row.own_in_time), ratio_cell(row.together / row.own_in_time)});
  return table.text();
}

}  // namespace

Findings measure_own(const Setup& setup) {
  const Effort effort = setup.quick ? Effort{8, 2, 64, 3} : Effort{16, 4, 256, 7};
  std::vector<Measured> all;
  std::string told, skipped;
  for (const Case& c : cases()) {
    try {
      all.push_back(measure_one(c, effort));
      const std::string& of_lights = all.back().told;
      if (!of_lights.empty()) told += fmt::format("\n{}, as `--explain` says:\n\n{}", all.back().name, of_lights);
    } catch (const Skipped& why) {
      skipped += fmt::format("\n{}: SKIPPED, {}\n", c.file.stem().string(), why.what());
    }
  }
  return {table_of(all, effort.iterations) + told + skipped, {}};
}

}  // namespace dspm
