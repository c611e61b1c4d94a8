#include "cli/end_on_signal.hpp"

namespace servoid::cli {

namespace {
std::atomic<bool> end_wanted{false};
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler sets it");
} // namespace

EndOnSignal::EndOnSignal() {
    end_wanted = false;
    struct sigaction action = {};
    action.sa_handler = [](int) { end_wanted = true; };
    ::sigaction(SIGINT, &action, &before_[0]);
    ::sigaction(SIGTERM, &action, &before_[1]);
}

EndOnSignal::~EndOnSignal() {
    ::sigaction(SIGINT, &before_[0], nullptr);
    ::sigaction(SIGTERM, &before_[1], nullptr);
}

const std::atomic<bool>& EndOnSignal::wanted() { return end_wanted; }

} // namespace servoid::cli
