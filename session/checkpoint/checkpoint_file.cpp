#include "dspm/session/checkpoint/checkpoint_file.h"

#include <fmt/format.h>
#include <sys/stat.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cerrno>
#include <cmath>
#include <set>
#include <stdexcept>
#include <system_error>

#include "dspm/base/math/frames.h"
#include "dspm/base/math/moments.h"
#include "dspm/base/system/atomic_file.h"
#include "dspm/base/system/file_access.h"
#include "dspm/base/system/state_in_memory.h"
#include "dspm/integrators/possible_state.h"
#include "dspm/session/checkpoint/loading_stream.h"
#include "dspm/session/revertible.h"

namespace dspm {
namespace {

static_assert(std::endian::native == std::endian::little);  // like the numbers in the file
constexpr std::string_view kMagic = CheckpointFile::kMagic;
constexpr std::size_t kMostIntervals = 1 << 20, kMostFrames = 1 << 24, kLongestName = 1 << 16;

[[noreturn]] void fail(const std::string& why) { throw std::runtime_error(why); }

void persist(IntervalState& interval, StateStream& state) {
  state.list(interval.places.frames, kMostFrames);
  state.value(interval.places.given_up);
  state.value(interval.iterations);
  state.value(interval.seconds);
  state.value(interval.offset);
  state.value(interval.size);
}

/// Saves or loads intervals one by one: a large count without contents must not allocate.
void persist(std::vector<IntervalState>& all, StateStream& state) {
  std::uint64_t count = all.size();
  state.value(count);
  if (count > kMostIntervals) fail("it has too many entries");
  for (std::uint64_t i = 0; i < count; ++i) {
    if (i == all.size()) all.emplace_back();
    persist(all[i], state);
  }
}

void persist(std::vector<std::string>& texts, StateStream& state) {
  std::uint64_t count = texts.size();
  state.value(count);
  if (count > kMostFrames) fail("it has too many entries");
  for (std::uint64_t i = 0; i < count; ++i) {
    if (i == texts.size()) texts.emplace_back();
    state.text(texts[i], kLongestName);
  }
}

void persist(KnownFrames& frames, StateStream& state) {
  state.value(frames.base);
  state.value(frames.moments);
  persist(frames.names, state);
}

void persist(Part& part, StateStream& state) {
  state.value(part);
  if (part.number < 1 || part.number > part.of || part.of > Part::kMost) fail("it is damaged");
}

/// Throws if frames are not possible: a forged file could name frames that do not exist.
void expect_possible(const KnownFrames& frames, const std::vector<IntervalState>& intervals) {
  const FramesPart &base = frames.base, all = frames.all();
  const bool is_possible = base.moments >= 1 && base.combinations >= 1 && base.moments <= all.moments &&
                           base.combinations <= all.combinations &&
                           all.moments <= static_cast<int>(kMostFrames) / all.combinations;
  bool valid = is_possible;
  for (const IntervalState& interval : intervals)
    for (const FileFrame frame : interval.places.frames)
      valid = valid && frame.index() >= 0 && frame.index() < all.count();
  if (!valid) fail("it is damaged");
}

void persist_head(CheckpointFile::Render& render, std::vector<IntervalState>& intervals, StateStream& state) {
  dspm::persist(render.facts, state);
  persist(render.frames, state);
  state.text(render.sampling, kLongestName);
  persist(render.part, state);
  state.value(render.memory);
  persist(render.machines, state);
  persist(render.words, state);
  persist(intervals, state);
}

std::uint64_t head_bytes(CheckpointFile::Render& render, std::vector<IntervalState>& intervals) {
  CountingStream counting;
  persist_head(render, intervals, counting);
  return counting.count();
}

constexpr std::uint64_t kHeadAt = kMagic.size();

/// Calls fn(block) for the next `count` bytes, a block at a time. Returns false if they could not be read.
template <class Fn>
bool for_each_block(std::istream& file, std::uint64_t count, Fn&& fn) {
  std::vector<char> block(static_cast<std::size_t>(std::min<std::uint64_t>(LoadingStream::kBlock, count)));
  for (std::uint64_t left = count; left > 0;) {
    const std::size_t now = static_cast<std::size_t>(std::min<std::uint64_t>(block.size(), left));
    if (!file.read(block.data(), static_cast<std::streamsize>(now))) return false;
    fn(std::string_view(block.data(), now));
    left -= now;
  }
  return true;
}

/// A checksum that grows block by block.
class Checksum {
 public:
  void add(std::string_view block) {
    if (block.empty()) return;  // zlib takes a null pointer as a request to start over
    value_ = crc32_z(value_, reinterpret_cast<const Bytef*>(block.data()), block.size());
  }
  std::uint32_t value() const { return static_cast<std::uint32_t>(value_); }

 private:
  uLong value_ = crc32_z(0, nullptr, 0);
};

}  // namespace

void expect_frames(const std::vector<IntervalState>& intervals, const std::string& file) {
  std::set<FileFrame> all;
  bool valid = true;
  for (const IntervalState& interval : intervals) {
    const FrameList frames = interval.places.going_on();
    valid = valid && !frames.empty() && interval.places.frames.size() <= kMaxFrames;
    for (const FileFrame frame : frames) valid = all.insert(frame).second && valid;
  }
  if (!valid) throw std::runtime_error(fmt::format("checkpoint {}: its frames are not possible", file));
}

class CheckpointFile::SavingStream final : public StateStream {
 public:
  explicit SavingStream(AtomicFile& file) : file_(file) {}
  std::uint32_t checksum() const { return checksum_.value(); }
  void append(std::string_view block) {
    checksum_.add(block);
    file_.write(block);
  }

 protected:
  void bytes(void* data, std::size_t count) override { append({static_cast<const char*>(data), count}); }

 private:
  AtomicFile& file_;
  Checksum checksum_;
};

void CheckpointFile::open(const std::filesystem::path& path) {
  struct stat status;
  if (stat(path.c_str(), &status) != 0) fail("there is no such file");
  if (!S_ISREG(status.st_mode)) fail("it is not a regular file");
  device_ = status.st_dev, inode_ = status.st_ino;
  file_.open(path, std::ios::binary);
  if (!file_) fail(fmt::format("it cannot be read: {}", std::error_code(errno, std::generic_category()).message()));
}

bool CheckpointFile::is_at(const std::filesystem::path& path) const {
  struct stat status;
  return stat(path.c_str(), &status) == 0 && status.st_dev == device_ && status.st_ino == inode_;
}

CheckpointFile::CheckpointFile(const std::filesystem::path& path) : path_(path) {
  try {
    expect_allowed(path);
    open(path);
    const std::uint64_t size = std::filesystem::file_size(path);
    std::array<char, kMagic.size()> magic{};
    file_.read(magic.data(), magic.size());
    if (std::string_view(magic.data(), magic.size()) != kMagic) fail("it is not a checkpoint of this version of dspm");
    std::uint32_t checksum = 0;
    if (size < kHeadAt + sizeof(checksum)) fail("it ends too early");
    Checksum actual;
    const auto add = [&](std::string_view block) { actual.add(block); };
    if (!for_each_block(file_, size - kHeadAt - sizeof(checksum), add)) fail("it cannot be read");
    file_.read(reinterpret_cast<char*>(&checksum), sizeof(checksum));
    if (actual.value() != checksum) fail("it is damaged: its checksum is wrong");
    file_.seekg(static_cast<std::streamoff>(kHeadAt));
    LoadingStream head(file_, size - kHeadAt - sizeof(checksum));
    persist_head(render_, intervals_, head);
    expect_possible(render_.frames, intervals_);
    for (const IntervalState& interval : intervals_)
      for (const FileFrame frame : interval.places.going_on()) render_.frames.rendered.push_back(frame);
    for (const IntervalState& interval : intervals_)
      if (interval.offset > size || interval.size > size - interval.offset || interval.iterations < 0 ||
          interval.iterations > kMostIterations || !(interval.seconds >= 0 && std::isfinite(interval.seconds)))
        fail("it is damaged");
  } catch (const std::exception& error) {
    fail(fmt::format("checkpoint {}: {}", path.string(), error.what()));
  }
}

void CheckpointFile::load(std::size_t interval, Integrator& integrator) const {
  load_by<LoadingStream>(interval, integrator);
}

void CheckpointFile::add(std::size_t interval, Integrator& integrator) const {
  load_by<AddingStream>(interval, integrator);
}

template <class Stream>
void CheckpointFile::load_by(std::size_t interval, Integrator& integrator) const {
  const IntervalState& state = intervals_[interval];
  try {
    file_.clear();
    file_.seekg(static_cast<std::streamoff>(state.offset));
    Stream stream(file_, state.size);
    if (!integrator.persist(stream) || stream.left() != 0) fail("it belongs to another integrator");
    expect_iterations(integrator.statistics().iterations);
  } catch (const std::exception& error) {
    fail(fmt::format("checkpoint {}: {}", path_.string(), error.what()));
  }
}

bool CheckpointFile::copy(const IntervalState& state, SavingStream& to) const {
  file_.clear();
  file_.seekg(static_cast<std::streamoff>(state.offset));
  return for_each_block(file_, state.size, [&](std::string_view block) { to.append(block); });
}

std::unique_ptr<const CheckpointFile> CheckpointFile::write(const std::filesystem::path& path, const Render& render,
                                                            std::vector<IntervalState> intervals, const NewState* state,
                                                            const CheckpointFile* before) {
  std::unique_ptr<CheckpointFile> written(new CheckpointFile);
  written->path_ = path, written->render_ = render;
  const std::vector<IntervalState> old = intervals;
  std::uint64_t offset = kHeadAt + head_bytes(written->render_, intervals);
  for (std::size_t i = 0; i < intervals.size(); ++i) {
    if (state != nullptr && i == state->interval) intervals[i].size = *state_bytes(state->integrator);
    intervals[i].offset = offset;
    offset += intervals[i].size;
  }
  written->intervals_ = std::move(intervals);
  AtomicFile file(path);
  file.write(kMagic);
  SavingStream saving(file);
  persist_head(written->render_, written->intervals_, saving);
  for (std::size_t i = 0; i < written->intervals_.size(); ++i)
    if (state != nullptr && i == state->interval)
      state->integrator.persist(saving);
    else if (written->intervals_[i].size > 0 && !before->copy(old[i], saving))
      throw WriteError(path, "the previous checkpoint cannot be read");
  const std::uint32_t checksum = saving.checksum();
  file.write({reinterpret_cast<const char*>(&checksum), sizeof(checksum)});
  try {
    written->open(file.temporary());  // so that it is this very file, whichever file has its name later
  } catch (const std::runtime_error& error) {
    throw WriteError(path, error.what());
  }
  file.commit();
  return written;
}

}  // namespace dspm
