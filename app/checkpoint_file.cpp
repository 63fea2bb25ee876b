#include "app/checkpoint_file.h"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <bit>
#include <stdexcept>

#include "core/atomic_file.h"
#include "core/file_access.h"

namespace dspm {
namespace {

static_assert(std::endian::native == std::endian::little);  // as numbers are in the file
constexpr std::string_view kMagic = CheckpointFile::kMagic;
constexpr std::size_t kMostFacts = 10'000'000, kMostText = 1 << 20, kMostIntervals = 1 << 20, kMostFrames = 1 << 24;
constexpr std::size_t kBlock = 1 << 20;

[[noreturn]] void fail(const std::string& why) { throw std::runtime_error(why); }

class CountingStream final : public StateStream {
 public:
  std::uint64_t count() const { return count_; }

 protected:
  void bytes(void*, std::size_t count) override { count_ += count; }

 private:
  std::uint64_t count_ = 0;
};

class SavingStream final : public StateStream {
 public:
  explicit SavingStream(AtomicFile& file) : file_(file) {}
  uLong checksum() const { return checksum_; }
  void append(std::string_view block) {
    if (block.empty()) return;  // zlib takes a null pointer for a wish to begin anew
    checksum_ = crc32_z(checksum_, reinterpret_cast<const Bytef*>(block.data()), block.size());
    file_.write(block);
  }

 protected:
  void bytes(void* data, std::size_t count) override { append({static_cast<const char*>(data), count}); }

 private:
  AtomicFile& file_;
  uLong checksum_ = crc32_z(0, nullptr, 0);
};

class LoadingStream final : public StateStream {
 public:
  /// As many bytes as there may be from where the file stands.
  LoadingStream(std::istream& file, std::uint64_t left) : file_(file), left_(left) {}
  std::uint64_t left() const { return left_; }

 protected:
  void bytes(void* data, std::size_t count) override {
    expect(count);
    if (!file_.read(static_cast<char*>(data), static_cast<std::streamsize>(count))) fail("it cannot be read");
    left_ -= count;
  }
  void expect(std::size_t count) override {
    if (count > left_) fail("it ends too early");
  }

 private:
  std::istream& file_;
  std::uint64_t left_;
};

void persist(std::string& text, StateStream& state) {
  std::vector<char> bytes(text.begin(), text.end());
  state.list(bytes, kMostText);
  text.assign(bytes.begin(), bytes.end());
}

void persist(std::vector<Fact>& facts, StateStream& state) {
  std::uint64_t count = facts.size();
  state.part(count);
  if (count > kMostFacts) fail("it tells of too many things");
  for (std::uint64_t i = 0; i < count; ++i) {  // one by one: a count without contents must cost nothing
    if (i == facts.size()) facts.emplace_back();
    persist(facts[i].name, state);
    persist(facts[i].text, state);
    state.part(facts[i].is_digest);
  }
}

void persist(std::vector<IntervalState>& intervals, StateStream& state) {
  std::uint64_t count = intervals.size();
  state.part(count);
  if (count > kMostIntervals) fail("it tells of too many intervals");
  for (std::uint64_t i = 0; i < count; ++i) {
    if (i == intervals.size()) intervals.emplace_back();
    IntervalState& interval = intervals[i];
    state.list(interval.frames, kMostFrames);
    state.part(interval.iterations);
    state.part(interval.seconds);
    state.part(interval.offset);
    state.part(interval.size);
  }
}

std::uint64_t head_bytes(std::vector<Fact>& facts, std::vector<IntervalState>& intervals) {
  CountingStream counting;
  persist(facts, counting);
  persist(intervals, counting);
  return counting.count();
}

constexpr std::uint64_t kHeadAt = kMagic.size();

uLong checksum_of(std::istream& file, std::uint64_t count) {
  uLong checksum = crc32_z(0, nullptr, 0);
  std::vector<char> block(kBlock);
  for (std::uint64_t done = 0; done < count;) {
    const std::size_t now = static_cast<std::size_t>(std::min<std::uint64_t>(kBlock, count - done));
    if (!file.read(block.data(), static_cast<std::streamsize>(now))) fail("it cannot be read");
    checksum = crc32_z(checksum, reinterpret_cast<const Bytef*>(block.data()), now);
    done += now;
  }
  return checksum;
}

}  // namespace

CheckpointFile::CheckpointFile(const std::filesystem::path& path) : path_(path) {
  try {
    expect_allowed(path);
    file_.open(path, std::ios::binary);
    if (!file_) fail("there is no such file, or it cannot be read");
    const std::uint64_t size = std::filesystem::file_size(path);
    std::array<char, kMagic.size()> magic{};
    file_.read(magic.data(), magic.size());
    if (std::string_view(magic.data(), magic.size()) != kMagic) fail("it is no checkpoint of this version of dspm");
    std::uint32_t checksum = 0;
    if (size < kHeadAt + sizeof(checksum)) fail("it ends too early");
    const uLong actual = checksum_of(file_, size - kHeadAt - sizeof(checksum));
    file_.read(reinterpret_cast<char*>(&checksum), sizeof(checksum));
    if (actual != checksum) fail("it is damaged: its checksum is wrong");
    file_.seekg(static_cast<std::streamoff>(kHeadAt));
    LoadingStream head(file_, size - kHeadAt - sizeof(checksum));
    persist(facts_, head);
    persist(intervals_, head);
    for (const IntervalState& interval : intervals_)
      if (interval.offset > size || interval.size > size - interval.offset) fail("it is damaged");
  } catch (const std::exception& error) {
    fail(fmt::format("checkpoint {}: {}", path.string(), error.what()));
  }
}

void CheckpointFile::load(std::size_t interval, Integrator& integrator) const {
  const IntervalState& state = intervals_[interval];
  try {
    file_.clear();
    file_.seekg(static_cast<std::streamoff>(state.offset));
    LoadingStream stream(file_, state.size);
    if (!integrator.persist(stream) || stream.left() != 0) fail("it is of another integrator");
  } catch (const std::exception& error) {
    fail(fmt::format("checkpoint {}: {}", path_.string(), error.what()));
  }
}

void CheckpointFile::write(const std::filesystem::path& path, const std::vector<Fact>& facts,
                           std::vector<IntervalState> intervals, std::size_t interval, Integrator& integrator,
                           const CheckpointFile* before) {
  std::vector<Fact> told = facts;
  std::uint64_t offset = kHeadAt + head_bytes(told, intervals);
  for (std::size_t i = 0; i < intervals.size(); ++i) {
    if (i == interval) intervals[i].size = *state_bytes(integrator);
    intervals[i].offset = offset;
    offset += intervals[i].size;
  }
  AtomicFile file(path);
  file.write(kMagic);
  SavingStream saving(file);
  persist(told, saving);
  persist(intervals, saving);
  std::vector<char> block(kBlock);
  for (std::size_t i = 0; i < intervals.size(); ++i) {
    if (i == interval) {
      integrator.persist(saving);
      continue;
    }
    if (intervals[i].size == 0) continue;
    before->file_.clear();
    before->file_.seekg(static_cast<std::streamoff>(before->intervals_[i].offset));
    for (std::uint64_t left = intervals[i].size; left > 0;) {
      const std::size_t now = static_cast<std::size_t>(std::min<std::uint64_t>(kBlock, left));
      if (!before->file_.read(block.data(), static_cast<std::streamsize>(now)))
        throw WriteError(path, "the checkpoint before it cannot be read");
      saving.append({block.data(), now});
      left -= now;
    }
  }
  const auto checksum = static_cast<std::uint32_t>(saving.checksum());
  file.write({reinterpret_cast<const char*>(&checksum), sizeof(checksum)});
  file.commit();
}

std::optional<std::uint64_t> state_bytes(Integrator& integrator) {
  CountingStream counting;
  if (!integrator.persist(counting)) return std::nullopt;
  return counting.count();
}

}  // namespace dspm
