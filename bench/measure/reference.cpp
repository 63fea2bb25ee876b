#include "bench/measure/reference.h"

#include <algorithm>

#include "dspm/image/image.h"
#include "dspm/image/shrink.h"

namespace dspm {
namespace {

constexpr int kBlock = 8;  // pixels
constexpr double kAgrees = 0.1;
constexpr int kSeed = 1000;

int columns_of(const Image& image) { return std::max(1, image.width / kBlock); }
int rows_of(const Image& image) { return std::max(1, image.height / kBlock); }

/// All see light of the same depth, whatever their defaults: what one of them cuts off would count as its error.
LoadedScene loaded_for(const std::filesystem::path& file, Choices choices, const char* integrator) {
  constexpr int kDepth = 16;
  choices.integrator = integrator;
  LoadedScene loaded = load(file, choices);
  loaded.job = with_integer(std::move(loaded.job), "maxdepth", kDepth);
  return loaded;
}

Images reference_run(const LoadedScene& loaded, const char* integrator, Job job, int seed, double seconds) {
  job.settings.seed += static_cast<std::uint64_t>(kSeed + seed);
  return render_for(loaded, {"reference", integrator, std::move(job)}, seconds);
}

}  // namespace

std::size_t Part::square(const Image& image, int x, int y) const {
  const int column = x * columns / image.width, row = y * rows / image.height;
  return static_cast<std::size_t>(row * columns + column);
}

bool Part::holds(std::size_t frame, const Image& image, int x, int y) const {
  return frames[frame][square(image, x, y)];
}

double Part::share() const {
  std::ptrdiff_t inside = 0, all = 0;
  for (const std::vector<bool>& squares : frames) {
    inside += std::count(squares.begin(), squares.end(), true);
    all += std::ssize(squares);
  }
  return all > 0 ? static_cast<double>(inside) / static_cast<double>(all) : 0;
}

Part Part::rest() const {
  Part other = *this;
  for (std::vector<bool>& squares : other.frames) squares.flip();
  return other;
}

Part squares_in(const PixelRect& pixels, const Images& images) {
  Part part{columns_of(images.front()), rows_of(images.front()), {}};
  std::vector<bool> squares(static_cast<std::size_t>(part.columns * part.rows));
  for (int y = pixels.y0; y < pixels.y1; ++y)
    for (int x = pixels.x0; x < pixels.x1; ++x) squares[part.square(images.front(), x, y)] = true;
  part.frames.assign(images.size(), squares);
  return part;
}

Images in_blocks(const Images& images) {
  Images blocks;
  for (const Image& image : images) blocks.push_back(shrunk(image, columns_of(image), rows_of(image)));
  return blocks;
}

double error_of(const Images& images, const Images& truth, const Part& part) {
  double sum = 0;
  std::size_t count = 0;
  for (std::size_t f = 0; f < truth.size(); ++f) {
    const double floor = error_floor(truth[f]);
    for (int y = 0; y < truth[f].height; ++y)
      for (int x = 0; x < truth[f].width; ++x) {
        if (!part.holds(f, truth[f], x, y)) continue;
        sum += error_of(images[f].at(x, y), truth[f].at(x, y), floor);
        ++count;
      }
  }
  return count > 0 ? sum / static_cast<double>(count) : 0;
}

Part agreement(const Images& path, const Images& truth) {
  const Images a = in_blocks(path), b = in_blocks(truth);
  Part part{b.front().width, b.front().height, {}};
  for (std::size_t f = 0; f < b.size(); ++f) {
    const double floor = error_floor(b[f]);
    std::vector<bool> squares;
    for (std::size_t p = 0; p < b[f].pixels.size(); ++p)
      squares.push_back(error_of(a[f].pixels[p], b[f].pixels[p], floor) <= kAgrees);
    part.frames.push_back(std::move(squares));
  }
  return part;
}

Comparison::Comparison(const std::filesystem::path& file, Choices choices)
    : path(loaded_for(file, choices, "path")),
      dsppm(loaded_for(file, choices, "dsppm")),
      vcm(loaded_for(file, choices, "vcm")) {}

const LoadedScene& Comparison::of(const std::string& integrator) const {
  return integrator == "path" ? path : integrator == "vcm" ? vcm : dsppm;
}

Reference make_reference(const Comparison& scene, double seconds) {
  const Job job = with_number(scene.vcm.job, "alpha", 0.5f);
  const Images path = reference_run(scene.path, "path", scene.path.job, 0, seconds);
  const Images first = reference_run(scene.vcm, "vcm", job, 1, seconds),
               second = reference_run(scene.vcm, "vcm", job, 2, seconds);
  Reference made{mean_of(first, second), {}, {}, 0, 0};
  made.seen = agreement(path, made.truth), made.hidden = made.seen.rest();
  const Images both = in_blocks(made.truth);
  made.uncertain_seen = error_of(in_blocks(path), both, made.seen) / 2;
  made.uncertain_hidden = error_of(in_blocks(first), in_blocks(second), made.hidden) / 2;
  const Images seen = mean_of(path, made.truth);
  for (std::size_t f = 0; f < seen.size(); ++f)
    for (int y = 0; y < seen[f].height; ++y)
      for (int x = 0; x < seen[f].width; ++x)
        if (made.seen.holds(f, seen[f], x, y)) made.truth[f].at(x, y) = seen[f].at(x, y);
  return made;
}

}  // namespace dspm
