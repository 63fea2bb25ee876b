// An integrator that does what a bad one may do; without a mood it paints every frame in its own grey.
#include <dspm/session/modules/module.h>

#include <cstdlib>
#include <list>
#include <stdexcept>
#include <thread>
#include <vector>

namespace {

using namespace dspm;

class Mischief final : public Integrator {
 public:
  Mischief(std::string mood, const RenderSettings& render) : mood_(std::move(mood)), render_(render) {}

  int iterations() const override { return 4; }
  std::string settings() const override { return mood_; }
  void iterate(const Iteration& iteration) override {
    if (iteration.number == 2 && mood_ == "throw") throw std::runtime_error("out of paint");
    if (iteration.number == 2 && mood_ == "hang") std::this_thread::sleep_for(std::chrono::seconds(3));
    if (iteration.number == 2 && mood_ == "hoard") hoard();
    if (iteration.number == 1) die();
    ++statistics_.iterations;
  }
  Image estimate(Frame frame, const std::string&) const override {
    Image image(render_.crop.width(), render_.crop.height());
    for (Rgb& c : image.pixels) c = Rgb(0.25f * static_cast<float>(frame + 1));
    if (mood_ == "nan") image.at(3, 1) = image.at(0, 2) = Rgb(std::numeric_limits<float>::quiet_NaN());
    return image;
  }
  Statistics statistics() const override { return statistics_; }
  bool persist(StateStream& state) override {
    statistics_.persist(state);
    return mood_ == "abort";
  }

 private:
  void die() const {
    volatile int* volatile nowhere = nullptr;  // compilers leave out stores that cannot be
    if (mood_ == "abort") std::abort();
    if (mood_ == "segfault") *nowhere = 1;
    if (mood_ == "exit") std::exit(0);
    if (mood_ == "_exit") _exit(0);
    if (mood_ == "_Exit") std::_Exit(0);
    if (mood_ == "quick_exit") std::quick_exit(0);
    if (mood_ == "exit in a thread") std::thread([] { std::exit(0); }).join();
    if (mood_ == "throw in a thread") std::thread([] { throw std::runtime_error("out of thread"); }).join();
  }
  /// All memory that a process with a limit may have.
  void hoard() {
    constexpr std::size_t kPiece = 1 << 18, kUnlimited = 1 << 12;
    while (hoard_.size() < kUnlimited) hoard_.emplace_back(kPiece);
    throw std::logic_error("a test for processes with a limit");
  }

  std::string mood_;
  RenderSettings render_;
  Statistics statistics_;
  std::list<std::vector<char>> hoard_;
};

std::unique_ptr<Integrator> make_mischief(ParamReader& params, const Scene&, const RenderSettings& render) {
  const std::string mood =
      params.choice("mood", "good",
                    {"good", "throw", "refuse", "hang", "nan", "hoard", "abort", "segfault", "exit", "_exit", "_Exit",
                     "quick_exit", "exit in a thread", "throw in a thread"},
                    "what it does");
  params.finish();
  if (mood == "refuse") throw std::runtime_error("not today");
  return std::make_unique<Mischief>(mood, render);
}

}  // namespace

DSPM_MODULE(registry) {
  registry.add(integrator_plugins(), {{"mischief", "does what a bad integrator may do", make_mischief}});
}
