#include "can/socketcan.hpp"

#include "can/can_socket.hpp"
#include "can/error_frame.hpp"

#include <fmt/format.h>

#include <linux/can.h>
#include <linux/sock_diag.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <ctime>
#include <thread>

namespace servoid::can {

namespace {

using namespace std::chrono_literals;

constexpr unsigned kBatch = 64;         // frames of one call into the kernel
constexpr int kBatches = 64;            // of one drain: a flood must not hold the caller
constexpr int kGivenBetweenDrains = 16; // the kernel's queue is looked at that often
constexpr auto kLook = 10ms;            // at an interface that is down
constexpr auto kStep = 500us;           // between tries to send: poll() knows nothing of room
constexpr std::int64_t kSecond_ns = 1'000'000'000;

std::int64_t time_of(msghdr& message) {
    for (cmsghdr* c = CMSG_FIRSTHDR(&message); c; c = CMSG_NXTHDR(&message, c)) {
        if (c->cmsg_level != SOL_SOCKET || c->cmsg_type != SCM_TIMESTAMPNS) continue;
        timespec time;
        std::memcpy(&time, CMSG_DATA(c), sizeof time);
        return time.tv_sec * kSecond_ns + time.tv_nsec;
    }
    return 0;
}

Frame frame_of(const canfd_frame& raw, bool fd) {
    Frame out;
    out.error = (raw.can_id & CAN_ERR_FLAG) != 0;
    out.extended = !out.error && (raw.can_id & CAN_EFF_FLAG) != 0;
    out.remote = !out.error && (raw.can_id & CAN_RTR_FLAG) != 0;
    out.id = raw.can_id & (out.error || out.extended ? CAN_EFF_MASK : CAN_SFF_MASK);
    out.fd = fd;
    out.fd_flags = fd ? raw.flags : std::uint8_t{0};
    out.length = std::min<std::uint8_t>(raw.len, fd ? CANFD_MAX_DLEN : CAN_MAX_DLEN);
    if (!out.remote) std::copy_n(raw.data, out.length, out.data.begin());
    return out;
}

canfd_frame raw_of(const Frame& frame) {
    canfd_frame out{};
    out.can_id = frame.id | (frame.extended ? CAN_EFF_FLAG : 0) |
                 (frame.remote ? CAN_RTR_FLAG : 0) | (frame.error ? CAN_ERR_FLAG : 0);
    out.len = frame.length;
    if (frame.fd) out.flags = frame.fd_flags;
    std::copy_n(frame.data.begin(), frame.length, out.data);
    return out;
}

bool is_no_room(int error) { return error == ENOBUFS || error == EAGAIN || error == ENETDOWN; }

[[noreturn]] void refuse_sending(const std::string& interface, const Frame& frame, int error) {
    if (error == EINVAL && frame.fd)
        throw BusError(fmt::format("{0}: the interface carries no CAN FD: `ip link set {0} mtu 72` "
                                   "or `... type can bitrate 500000 dbitrate 2000000 fd on`",
                                   interface));
    if (error == ENODEV || error == ENXIO) throw BusError(interface + ": the interface is gone");
    throw BusError(fmt::format("{}: {} cannot be sent: {}", interface, to_text(id_of(frame)),
                               std::strerror(error)));
}

} // namespace

struct SocketCan::Batch {
    std::array<canfd_frame, kBatch> frames;
    std::array<iovec, kBatch> parts;
    struct alignas(cmsghdr) Control {
        std::array<char, CMSG_SPACE(sizeof(timespec))> bytes;
    };
    std::array<Control, kBatch> control;
    std::array<mmsghdr, kBatch> messages;

    // The kernel shortens what it was given.
    void reset() {
        for (unsigned i = 0; i < kBatch; ++i) {
            parts[i] = {&frames[i], sizeof frames[i]};
            messages[i] = {};
            messages[i].msg_hdr.msg_iov = &parts[i];
            messages[i].msg_hdr.msg_iovlen = 1;
            messages[i].msg_hdr.msg_control = control[i].bytes.data();
            messages[i].msg_hdr.msg_controllen = control[i].bytes.size();
        }
    }
};

SocketCan::SocketCan(std::string interface, SocketCanOptions options)
    : interface_(std::move(interface)), options_(std::move(options)),
      socket_(open_can_socket(interface_, options_.listen_to, options_.receive_buffer_bytes)),
      batch_(std::make_unique<Batch>()) {}

SocketCan::~SocketCan() { ::close(socket_); }

void SocketCan::listen_to(const std::vector<FrameId>& identifiers) {
    set_filter(socket_, interface_, identifiers);
}

void SocketCan::send(const Frame& frame) {
    const canfd_frame raw = raw_of(frame);
    const std::size_t bytes = frame.fd ? CANFD_MTU : CAN_MTU;
    const auto until = Clock::now() + options_.send_wait;
    while (::write(socket_, &raw, bytes) != ssize_t(bytes)) {
        const int error = errno;
        if (error == EINTR) continue;
        if (!is_no_room(error)) refuse_sending(interface_, frame, error);
        if (error == ENETDOWN) note_down();
        refuse_lasting_trouble();
        // An error from a pause that is over may still be pending: then it is tried again.
        if (down_since_ || Clock::now() >= until) {
            ++health_.not_sent;
            return;
        }
        std::this_thread::sleep_for(kStep);
    }
    ++health_.sent;
}

bool SocketCan::receive(Frame& frame, std::chrono::nanoseconds wait) {
    std::optional<Clock::time_point> until; // where a frame waits, no clock is read
    for (;;) {
        if (queue_.empty() || ++given_since_drain_ >= kGivenBetweenDrains) drain();
        if (!queue_.empty()) {
            frame = queue_.front();
            queue_.pop_front();
            return true;
        }
        refuse_lasting_trouble();
        const auto now = Clock::now();
        if (!until) until = now + wait;
        const auto left = *until - now;
        if (left <= 0ns) return false;
        const bool trouble = down_since_ || off_since_;
        if (!wait_for_frames(trouble ? std::min<std::chrono::nanoseconds>(left, kLook) : left))
            return false;
    }
}

// False where a signal came.
bool SocketCan::wait_for_frames(std::chrono::nanoseconds wait) const {
    pollfd one{socket_, POLLIN, 0};
    const timespec time{std::time_t(wait.count() / kSecond_ns), long(wait.count() % kSecond_ns)};
    return ::ppoll(&one, 1, &time, nullptr) >= 0 || errno != EINTR;
}

// From the kernel's queue into ours.
void SocketCan::drain() {
    given_since_drain_ = 0;
    for (int i = 0; i < kBatches; ++i) {
        const int count = read_batch();
        for (int k = 0; k < count; ++k) {
            mmsghdr& message = batch_->messages[unsigned(k)];
            Frame frame = frame_of(batch_->frames[unsigned(k)], message.msg_len == CANFD_MTU);
            frame.time_ns = time_of(message.msg_hdr);
            take(frame);
        }
        if (count < int(kBatch)) break;
    }
    count_kernel_drops();
}

int SocketCan::read_batch() {
    batch_->reset();
    for (;;) {
        const int count =
            ::recvmmsg(socket_, batch_->messages.data(), kBatch, MSG_DONTWAIT, nullptr);
        if (count >= 0) return count;
        // What befell the interface is told before the frames that came earlier.
        if (errno == ENETDOWN)
            note_down();
        else if (errno == ENODEV)
            gone_ = true;
        else if (errno == EAGAIN)
            return 0;
        else if (errno != EINTR)
            throw BusError(fmt::format("{}: {}", interface_, std::strerror(errno)));
    }
}

void SocketCan::take(const Frame& frame) {
    note_trouble(frame);
    if (queue_.size() >= options_.queue_frames) {
        ++health_.dropped;
        return;
    }
    ++health_.received;
    queue_.push_back(frame);
}

void SocketCan::note_trouble(const Frame& frame) {
    const Trouble trouble = trouble_of(frame);
    health_.error_frames += frame.error;
    health_.bus_off += trouble.bus_off;
    health_.restarted += trouble.restarted;
    health_.error_passive += trouble.error_passive;
    health_.dropped += trouble.overflow;
    if (trouble.bus_off)
        off_since_ = Clock::now();
    else if (trouble.restarted || !frame.error)
        off_since_.reset();
}

void SocketCan::note_down() {
    if (down_since_) return;
    down_since_ = Clock::now();
    ++health_.interface_down;
}

// Asked for, not taken from the next frame: the last frames of a burst may be those that were lost.
void SocketCan::count_kernel_drops() {
    std::array<std::uint32_t, SK_MEMINFO_VARS> memory{};
    socklen_t bytes = sizeof memory;
    if (::getsockopt(socket_, SOL_SOCKET, SO_MEMINFO, memory.data(), &bytes) != 0) return;
    const std::uint32_t drops = memory[SK_MEMINFO_DROPS];
    health_.dropped += long(drops - kernel_drops_);
    kernel_drops_ = drops;
}

void SocketCan::refuse_lasting_trouble() {
    const auto lasted = [&](const std::optional<Clock::time_point>& since) {
        return since && Clock::now() - *since >= options_.trouble_wait;
    };
    const InterfaceState state = down_since_ ? state_of(socket_, interface_) : InterfaceState::up;
    if (gone_ || state == InterfaceState::gone)
        throw BusError(interface_ + ": the interface is gone");
    if (state == InterfaceState::up) down_since_.reset();
    if (lasted(down_since_)) throw BusError(interface_is_down(interface_));
    if (lasted(off_since_))
        throw BusError(fmt::format("{0}: bus off: the controller has left the bus (wiring, "
                                   "termination, bit rate); `ip link set {0} type can restart`",
                                   interface_));
}

} // namespace servoid::can
