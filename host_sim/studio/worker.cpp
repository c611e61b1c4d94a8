#include "studio/worker.hpp"

#include "common/error.hpp"

#include <utility>

namespace servoid::studio {

namespace {

constexpr size_t kMostWaiting = 32;
constexpr double kEnough = 0.05; // of the work: from here on it says how long the rest takes
constexpr auto kPause = std::chrono::milliseconds(100);

struct Stopped {};

double seconds(std::chrono::steady_clock::duration time) {
    return std::chrono::duration<double>(time).count();
}

} // namespace

Worker::Worker(std::function<void()> changed, std::function<void(const std::string&)> failed)
    : changed_(std::move(changed)), failed_(std::move(failed)), thread_([this] { run(); }) {}

Worker::~Worker() {
    ended_ = true;
    stop();
    thread_.join();
}

void Worker::queue(const std::string& what, Work work, bool dispensable) {
    const std::lock_guard lock(mutex_);
    if (waiting_.size() >= kMostWaiting) throw UsageError("too much waits already: stop it first");
    if (dispensable_) stop_ = true;
    std::erase_if(waiting_, [](const Task& task) { return task.dispensable; });
    waiting_.push_back({what, std::move(work), dispensable});
    wake_.notify_one();
}

void Worker::stop() {
    const std::lock_guard lock(mutex_);
    waiting_.clear();
    stop_ = true;
    wake_.notify_one();
}

std::optional<Busy> Worker::busy() const {
    const std::lock_guard lock(mutex_);
    if (!busy_ && !waiting_.empty()) return Busy{waiting_.front().what, "", 0, 0, std::nullopt};
    if (!busy_) return std::nullopt;
    Busy out = *busy_;
    const Clock::time_point now = Clock::now();
    out.elapsed_s = seconds(now - begun_);
    if (out.share > kEnough) out.left_s = seconds(now - pass_) * (1 - out.share) / out.share;
    return out;
}

// Called by the threads of the work itself, in any order.
void Worker::tell(const std::string& detail, double share) {
    if (stop_) throw Stopped();
    {
        const std::lock_guard lock(mutex_);
        if (!busy_) return;
        if (share < busy_->share) pass_ = Clock::now(); // refining looks several times
        busy_->detail = detail, busy_->share = share;
        if (Clock::now() - told_ < kPause) return;
        told_ = Clock::now();
    }
    changed_();
}

void Worker::perform(const Task& task) {
    try {
        task.work([this](const std::string& detail, double share) { tell(detail, share); });
    } catch (const Stopped&) {
    } catch (const std::exception& e) {
        failed_(e.what());
    }
}

void Worker::run() {
    while (!ended_) {
        Task task;
        {
            std::unique_lock lock(mutex_);
            wake_.wait(lock, [this] { return ended_ || !waiting_.empty(); });
            if (ended_) return;
            task = std::move(waiting_.front());
            waiting_.pop_front();
            stop_ = false, dispensable_ = task.dispensable;
            busy_ = Busy{task.what, "", 0, 0, std::nullopt};
            begun_ = pass_ = Clock::now();
        }
        changed_();
        perform(task);
        {
            const std::lock_guard lock(mutex_);
            busy_.reset(), dispensable_ = false;
        }
        changed_();
    }
}

} // namespace servoid::studio
