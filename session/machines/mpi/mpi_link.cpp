// Letters by MPI: a module with one function, for programs that mpirun has started.
#include <mpi.h>

#include <algorithm>
#include <cstdint>
#include <list>
#include <memory>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include "dspm/session/machines/link.h"

namespace dspm {
namespace {

/// Sends a letter's kind and the size of its text first, so that there is room for the text when it arrives.
class MpiLink final : public Link {
 public:
  MpiLink() {
    int given = 0;
    MPI_Init_thread(nullptr, nullptr, MPI_THREAD_SERIALIZED, &given);
    if (given < MPI_THREAD_SERIALIZED) {  // the post has a thread of its own
      MPI_Finalize();
      throw std::runtime_error("this MPI lets only the first thread call it: one with MPI_THREAD_SERIALIZED is needed");
    }
    MPI_Comm_dup(MPI_COMM_WORLD, &heads_);
    MPI_Comm_dup(MPI_COMM_WORLD, &texts_);
    MPI_Comm_size(MPI_COMM_WORLD, &machines_);
    MPI_Comm_rank(MPI_COMM_WORLD, &me_);
  }
  ~MpiLink() override {
    if (is_abandoned_) MPI_Abort(MPI_COMM_WORLD, 1);
    MPI_Finalize();
  }

  int machines() const override { return machines_; }
  int me() const override { return me_; }

  void send(Letter letter) override {
    Transfer& out = out_.emplace_back(std::move(letter));
    MPI_Isend(&out.size, sizeof(out.size), MPI_BYTE, out.letter.machine, static_cast<int>(out.letter.kind), heads_,
              &out.requests.emplace_back());
    out.for_each_piece([&](char* data, int size) {
      MPI_Isend(data, size, MPI_BYTE, out.letter.machine, 0, texts_, &out.requests.emplace_back());
    });
  }

  bool is_quiet() override {
    out_.remove_if([](Transfer& out) { return out.is_done(); });
    return out_.empty() && in_.empty();
  }

  std::optional<Letter> receive() override {
    begin_to_receive();
    const auto done = std::find_if(in_.begin(), in_.end(), [](Transfer& in) { return in.is_done(); });
    if (done == in_.end()) return std::nullopt;
    Letter letter = std::move(done->letter);
    in_.erase(done);
    return letter;
  }

  void abandon() override { is_abandoned_ = true; }

 private:
  struct Transfer {
    explicit Transfer(Letter sent) : letter(std::move(sent)), size(letter.text.size()) {}

    /// MPI counts with ints, so a long text goes in pieces.
    template <class Fn>
    void for_each_piece(Fn&& fn) {
      constexpr std::size_t kPiece = std::size_t{1} << 28;
      for (std::size_t at = 0; at < letter.text.size(); at += kPiece)
        fn(letter.text.data() + at, static_cast<int>(std::min(kPiece, letter.text.size() - at)));
    }
    bool is_done() {
      int done = 0;
      MPI_Testall(static_cast<int>(requests.size()), requests.data(), &done, MPI_STATUSES_IGNORE);
      return done != 0;
    }

    Letter letter;
    std::uint64_t size;
    std::vector<MPI_Request> requests;
  };

  void begin_to_receive() {
    int has_come = 0;
    MPI_Status status;
    MPI_Iprobe(MPI_ANY_SOURCE, MPI_ANY_TAG, heads_, &has_come, &status);
    if (has_come == 0) return;
    std::uint64_t size = 0;
    MPI_Recv(&size, sizeof(size), MPI_BYTE, status.MPI_SOURCE, status.MPI_TAG, heads_, MPI_STATUS_IGNORE);
    Transfer& in =
        in_.emplace_back(Letter{status.MPI_SOURCE, static_cast<LetterKind>(status.MPI_TAG), std::string(size, '\0')});
    in.for_each_piece([&](char* data, int piece) {
      MPI_Irecv(data, piece, MPI_BYTE, in.letter.machine, 0, texts_, &in.requests.emplace_back());
    });
  }

  MPI_Comm heads_ = MPI_COMM_NULL, texts_ = MPI_COMM_NULL;
  int machines_ = 1, me_ = 0;
  bool is_abandoned_ = false;
  std::list<Transfer> out_, in_;  // their addresses are stable
};

}  // namespace
}  // namespace dspm

/// Returns a new link, which the caller owns. A process may have only one.
extern "C" dspm::Link* dspm_link() { return new dspm::MpiLink; }
