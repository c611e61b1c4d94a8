#include "can/can_socket.hpp"

#include "can/bus.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <linux/can.h>
#include <linux/can/error.h>
#include <linux/can/raw.h>
#include <net/if.h>
#include <net/if_arp.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

namespace servoid::can {

namespace {

// Closed unless it is kept.
struct Guard {
    int fd;
    ~Guard() {
        if (fd >= 0) ::close(fd);
    }
    int keep() { return std::exchange(fd, -1); }
};

bool ask(int socket, const std::string& interface, unsigned long what, ifreq& answer) {
    answer = {};
    interface.copy(answer.ifr_name, IFNAMSIZ - 1);
    return interface.size() < IFNAMSIZ && ::ioctl(socket, what, &answer) == 0;
}

bool is_can(int socket, const std::string& interface) {
    ifreq answer;
    return ask(socket, interface, SIOCGIFHWADDR, answer) &&
           answer.ifr_hwaddr.sa_family == ARPHRD_CAN;
}

// "; there are can0, can1", or nothing.
std::string can_interfaces(int socket) {
    std::vector<std::string> names;
    struct if_nameindex* all = ::if_nameindex();
    for (auto* one = all; one && one->if_index != 0; ++one)
        if (is_can(socket, one->if_name)) names.emplace_back(one->if_name);
    ::if_freenameindex(all);
    return names.empty() ? "" : fmt::format("; there are {}", fmt::join(names, ", "));
}

[[noreturn]] void refuse_socket(const std::string& interface, int error) {
    if (error == EAFNOSUPPORT || error == EPROTONOSUPPORT || error == ESOCKTNOSUPPORT)
        throw BusError(interface + ": this kernel has no CAN: `modprobe can_raw`, and for a "
                                   "virtual bus `modprobe vcan`");
    if (error == EPERM || error == EACCES)
        throw BusError(interface + ": not allowed to open a CAN socket; in a container, that is "
                                   "for its host to allow");
    throw BusError(fmt::format("{}: no CAN socket: {}", interface, std::strerror(error)));
}

void refuse_interface(int socket, const std::string& interface) {
    ifreq answer;
    if (!ask(socket, interface, SIOCGIFINDEX, answer))
        throw BusError(fmt::format("{0}: there is no such interface{1}; `ip link add dev vcan0 "
                                   "type vcan` makes a virtual one",
                                   interface, can_interfaces(socket)));
    if (!is_can(socket, interface))
        throw BusError(fmt::format("{}: no CAN interface{}", interface, can_interfaces(socket)));
    if (state_of(socket, interface) != InterfaceState::up)
        throw BusError(interface_is_down(interface));
}

void option(int socket, const std::string& interface, int level, int name, int value) {
    if (::setsockopt(socket, level, name, &value, sizeof value) == 0) return;
    throw BusError(
        fmt::format("{}: CAN socket option {}: {}", interface, name, std::strerror(errno)));
}

// More than the system's limit only for an administrator. Whatever it is, drops are counted.
void set_receive_buffer(int socket, int bytes) {
    if (::setsockopt(socket, SOL_SOCKET, SO_RCVBUFFORCE, &bytes, sizeof bytes) != 0)
        ::setsockopt(socket, SOL_SOCKET, SO_RCVBUF, &bytes, sizeof bytes);
}

void bind_to(int socket, const std::string& interface) {
    sockaddr_can address{};
    address.can_family = AF_CAN;
    address.can_ifindex = int(::if_nametoindex(interface.c_str()));
    if (::bind(socket, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0)
        throw BusError(fmt::format("{}: {}", interface, std::strerror(errno)));
}

} // namespace

std::string interface_is_down(const std::string& interface) {
    return fmt::format("{0}: the interface is down: `ip link set {0} up type can bitrate 500000`, "
                       "a virtual one `ip link set {0} up`",
                       interface);
}

InterfaceState state_of(int socket, const std::string& interface) {
    ifreq answer;
    if (!ask(socket, interface, SIOCGIFFLAGS, answer)) return InterfaceState::gone;
    return answer.ifr_flags & IFF_UP ? InterfaceState::up : InterfaceState::down;
}

void set_filter(int socket, const std::string& interface, const std::vector<FrameId>& identifiers) {
    std::vector<can_filter> filter;
    for (FrameId id : identifiers) {
        if (id.extended)
            filter.push_back({id.id | CAN_EFF_FLAG, CAN_EFF_FLAG | CAN_EFF_MASK});
        else
            filter.push_back({id.id, CAN_EFF_FLAG | CAN_SFF_MASK});
    }
    if (filter.empty()) filter.push_back({0, 0}); // none at all would be: no frame
    if (::setsockopt(socket, SOL_CAN_RAW, CAN_RAW_FILTER, filter.data(),
                     socklen_t(filter.size() * sizeof(can_filter))) != 0)
        throw BusError(fmt::format("{}: a filter for {} identifiers: {}", interface,
                                   identifiers.size(), std::strerror(errno)));
}

int open_can_socket(const std::string& interface, const std::vector<FrameId>& listen_to,
                    int receive_buffer_bytes) {
    Guard guard{::socket(PF_CAN, SOCK_RAW | SOCK_NONBLOCK | SOCK_CLOEXEC, CAN_RAW)};
    if (guard.fd < 0) refuse_socket(interface, errno);
    refuse_interface(guard.fd, interface);
    option(guard.fd, interface, SOL_SOCKET, SO_TIMESTAMPNS, 1);
    option(guard.fd, interface, SOL_CAN_RAW, CAN_RAW_ERR_FILTER, CAN_ERR_MASK);
    option(guard.fd, interface, SOL_CAN_RAW, CAN_RAW_FD_FRAMES, 1); // the interface may have none
    set_receive_buffer(guard.fd, receive_buffer_bytes);
    set_filter(guard.fd, interface, listen_to); // before it is bound: nothing else gets in
    bind_to(guard.fd, interface);
    return guard.keep();
}

} // namespace servoid::can
