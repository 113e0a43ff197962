// Messages are CBOR (job.h), told apart by their tag. Only the main thread of a process talks MPI.
#include "reprocess/mpi_crew.h"

#include <mpi.h>

#include <deque>
#include <utility>
#include <vector>

#include "reprocess/shard.h"

namespace scarf::reprocess {
namespace {

constexpr std::chrono::milliseconds kPoll(2);  // the CPU is for the threads

enum Tag : int { kReady, kTask, kOutcome, kDismissed };

struct Message {
  size_t rank = 0;
  Tag tag = kReady;
  std::vector<uint8_t> bytes;
};

// MPI's default error handler ends the whole job, so calls that return have succeeded.

void send(size_t rank, Tag tag, const std::vector<uint8_t>& bytes) {
  MPI_Send(bytes.data(), static_cast<int>(bytes.size()), MPI_BYTE, static_cast<int>(rank), tag,
           MPI_COMM_WORLD);
}

std::optional<Message> receive_if_any() {
  int there = 0;
  MPI_Status status;
  MPI_Iprobe(MPI_ANY_SOURCE, MPI_ANY_TAG, MPI_COMM_WORLD, &there, &status);
  if (there == 0) return std::nullopt;
  int count = 0;
  MPI_Get_count(&status, MPI_BYTE, &count);
  Message message{static_cast<size_t>(status.MPI_SOURCE), static_cast<Tag>(status.MPI_TAG),
                  std::vector<uint8_t>(static_cast<size_t>(count))};
  MPI_Recv(message.bytes.data(), count, MPI_BYTE, status.MPI_SOURCE, status.MPI_TAG, MPI_COMM_WORLD,
           MPI_STATUS_IGNORE);
  return message;
}

// A rank says once for each of its threads that it is ready, and again with each outcome.
class Lead final : public Crew {
 public:
  explicit Lead(Crew& local) : local_(local) {}

  size_t idle() override {
    while (receive()) {
    }
    return local_.idle() + ready_.size();
  }

  Result<void> give(const Task& task) override {
    if (ready_.empty()) return local_.give(task);
    send(ready_.front(), kTask, bytes_of(task));
    ready_.pop_front();
    return {};
  }

  Result<std::optional<Outcome>> wait(std::chrono::milliseconds time) override {
    const auto end = std::chrono::steady_clock::now() + time;
    do {
      while (receive()) {
      }
      if (failure_) return *failure_;
      if (!outcomes_.empty()) {
        std::optional<Outcome> outcome = std::move(outcomes_.front());
        outcomes_.pop_front();
        return outcome;
      }
      auto outcome = local_.wait(kPoll);
      if (!outcome || *outcome) return outcome;
    } while (std::chrono::steady_clock::now() < end && ready_.empty());
    return std::optional<Outcome>();
  }

  uint64_t bytes_at_work() const override { return local_.bytes_at_work(); }

 private:
  bool receive() {
    const auto message = receive_if_any();
    if (!message) return false;
    ready_.push_back(message->rank);
    if (message->tag != kOutcome) return true;
    auto outcome = outcome_from(message->bytes);
    if (outcome) {
      outcomes_.push_back(*std::move(outcome));
    } else {
      failure_ = outcome.error();
    }
    return true;
  }

  Crew& local_;
  std::deque<size_t> ready_;  // a rank as often as it has idle threads
  std::deque<Outcome> outcomes_;
  std::optional<Error> failure_;
};

class Session final : public MpiSession {
 public:
  Session() {
    int provided = 0;
    MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &provided);
    MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
    MPI_Comm_size(MPI_COMM_WORLD, &size_);
  }
  // However rank 0 ends, with an error too, the others must not wait for tasks: MPI_Finalize waits for them.
  ~Session() override {
    if (rank_ == 0) {
      for (int rank = 1; rank < size_; ++rank) send(static_cast<size_t>(rank), kDismissed, {});
    }
    MPI_Finalize();
  }
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  size_t rank() const override { return static_cast<size_t>(rank_); }
  size_t size() const override { return static_cast<size_t>(size_); }

  std::unique_ptr<Crew> lead(Crew& local) override { return std::make_unique<Lead>(local); }

  Result<void> serve(Crew& local) override {
    for (size_t i = local.idle(); i > 0; --i) send(0, kReady, {});
    size_t at_work = 0;
    bool dismissed = false;
    while (!dismissed || at_work > 0) {
      while (const auto message = receive_if_any()) {
        dismissed |= message->tag == kDismissed;
        if (message->tag != kTask) continue;
        const auto task = task_from(message->bytes);
        if (!task) return task.error();
        if (auto r = local.give(*task); !r) return r;
        ++at_work;
      }
      const auto outcome = local.wait(kPoll);
      if (!outcome) return outcome.error();
      if (!*outcome) continue;
      --at_work;
      send(0, kOutcome, bytes_of(**outcome));
    }
    return {};
  }

 private:
  int rank_ = 0;
  int size_ = 1;
};

}  // namespace

Result<std::unique_ptr<MpiSession>> MpiSession::start() {
  // Outside a launcher MPI would try to start one by itself.
  const auto launched = mpi_shard(process_environment());
  if (!launched) return launched.error();
  if (!*launched || (*launched)->count == 1) return std::unique_ptr<MpiSession>();
  return std::unique_ptr<MpiSession>(std::make_unique<Session>());
}

}  // namespace scarf::reprocess
