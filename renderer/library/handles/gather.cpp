// SPDX-License-Identifier: MIT
#include "renderer/library/handles/gather.h"

#include <sys/mman.h>
#include <ucontext.h>

#include <algorithm>
#include <exception>
#include <new>
#include <utility>

namespace minkray {
namespace {

/// Size of each task's stack: traversal and solvers take some ten thousand bytes, and each level of
/// nested shapes (at most a thousand, nesting.h) up to 1632 where hulls of shapes are evaluated in
/// lanes of doubles; as much again is for other compilers. Memory that is never touched costs
/// nothing but addresses.
constexpr std::size_t stack_bytes = std::size_t{1} << 22;

/// Below a stack, so that a frame of several pages that is too much does not reach beyond it.
constexpr std::size_t guard_bytes = std::size_t{1} << 16;

/// Largest number of suspended tasks.
constexpr std::size_t most_turns = 256;

/// Memory for a stack, above what must not be touched.
class Stack {
 public:
  Stack()
      : memory_(mmap(nullptr, guard_bytes + stack_bytes, PROT_READ | PROT_WRITE,
                     MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0)) {
    if (memory_ == MAP_FAILED) throw std::bad_alloc();
    if (mprotect(memory_, guard_bytes, PROT_NONE) == 0) return;
    munmap(memory_, guard_bytes + stack_bytes);
    throw std::bad_alloc();
  }
  ~Stack() { munmap(memory_, guard_bytes + stack_bytes); }
  Stack(const Stack&) = delete;
  Stack& operator=(const Stack&) = delete;
  void* lowest() const { return static_cast<char*>(memory_) + guard_bytes; }

 private:
  void* memory_;
};

/// A suspended task, and the source it waits for.
struct Turn {
  Stack stack;
  ucontext_t context;
  const BatchSource* source = nullptr;  ///< null when it is done
  std::size_t count = 0;
  const Coordinates* directions = nullptr;
  Coordinates* points = nullptr;
};

}  // namespace

class Gathering::Turns {
 public:
  void run(std::size_t count, const std::function<void(std::size_t)>& work) {
    next_ = 0;
    count_ = count;
    work_ = &work;
    thrown_ = nullptr;
    while (turns_.size() < std::min(count, most_turns)) turns_.push_back(std::make_unique<Turn>());
    std::vector<Turn*> ready, waiting;
    ready.reserve(turns_.size());
    waiting.reserve(turns_.size());
    struct Guard {
      ~Guard() { of_this_thread() = outer; }
      Turns* outer;
    } guard{std::exchange(of_this_thread(), this)};
    for (std::size_t i = 0; i < std::min(count, most_turns); ++i) {
      begin(*turns_[i]);
      ready.push_back(turns_[i].get());
    }
    while (!ready.empty()) {
      waiting.clear();
      for (Turn* turn : ready) {
        turn->source = nullptr;
        current_ = turn;
        swapcontext(&caller_, &turn->context);
        if (turn->source) waiting.push_back(turn);
      }
      try {
        answer(waiting);
      } catch (...) {  // waiting tasks are resumed with an error, and end: nothing of theirs stays
                       // on their stacks
        thrown_ = std::current_exception();
      }
      ready.swap(waiting);
    }
    if (thrown_) std::rethrow_exception(thrown_);
  }

  void wait(const BatchSource& source, std::size_t count, const Coordinates* directions,
            Coordinates* points) {
    Turn& turn = *current_;
    turn.source = &source;
    turn.count = count;
    turn.directions = directions;
    turn.points = points;
    swapcontext(&turn.context, &caller_);
    if (thrown_) std::rethrow_exception(thrown_);
  }

  /// The tasks of this thread; null if it has none. Thread-local, since a support mapping, deep in
  /// a solver, has no argument for it.
  static Turns*& of_this_thread() {
    thread_local Turns* turns = nullptr;
    return turns;
  }

 private:
  /// Initialised each time: the task may run on another thread by then.
  void begin(Turn& turn) {
    getcontext(&turn.context);
    turn.context.uc_stack.ss_sp = turn.stack.lowest();
    turn.context.uc_stack.ss_size = stack_bytes;
    turn.context.uc_link = &caller_;
    makecontext(&turn.context, &Turns::take_pieces, 0);
  }

  static void take_pieces() {
    Turns& turns = *of_this_thread();
    try {
      while (turns.next_ < turns.count_ && !turns.thrown_) (*turns.work_)(turns.next_++);
    } catch (...) {
      if (!turns.thrown_) turns.thrown_ = std::current_exception();
    }
  }

  /// Calls each source once for all its requested directions, or as often as needed if that is too
  /// much at once.
  void answer(std::vector<Turn*>& waiting) {
    for (std::size_t first = 0; first < waiting.size();) {
      const BatchSource& source = *waiting[first]->source;
      const auto begin = waiting.begin() + static_cast<std::ptrdiff_t>(first);
      const auto of_others = std::stable_partition(
          begin, waiting.end(), [&](const Turn* turn) { return turn->source == &source; });
      const auto end = static_cast<std::size_t>(of_others - waiting.begin());
      while (first < end) {
        directions_.clear();
        std::size_t last = first;
        do {
          const Turn& turn = *waiting[last++];
          directions_.insert(directions_.end(), turn.directions, turn.directions + turn.count);
        } while (last < end && directions_.size() + waiting[last]->count <= source.most_at_once());
        points_.resize(directions_.size());
        source.answer(directions_.size(), directions_.data(), points_.data());
        const Coordinates* from = points_.data();
        for (; first < last; ++first) {
          std::copy_n(from, waiting[first]->count, waiting[first]->points);
          from += waiting[first]->count;
        }
      }
    }
  }

  std::vector<std::unique_ptr<Turn>> turns_;
  ucontext_t caller_;
  Turn* current_ = nullptr;
  std::size_t next_ = 0, count_ = 0;
  const std::function<void(std::size_t)>* work_ = nullptr;
  std::exception_ptr thrown_;
  std::vector<Coordinates> directions_, points_;
};

Gathering::Gathering() = default;
Gathering::~Gathering() = default;

void Gathering::run(std::size_t count, const std::function<void(std::size_t)>& work) {
  std::unique_ptr<Turns> turns;
  {
    const std::lock_guard lock(mutex_);
    if (!idle_.empty()) {
      turns = std::move(idle_.back());
      idle_.pop_back();
    }
  }
  if (!turns) turns = std::make_unique<Turns>();
  turns->run(count, work);
  const std::lock_guard lock(mutex_);
  idle_.push_back(std::move(turns));
}

bool Gathering::wait(const BatchSource& source, std::size_t count, const Coordinates* directions,
                     Coordinates* points) {
  Turns* const turns = Turns::of_this_thread();
  if (!turns) return false;
  turns->wait(source, count, directions, points);
  return true;
}

}  // namespace minkray
