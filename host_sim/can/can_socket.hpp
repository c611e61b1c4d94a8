// The kernel's side of SocketCan: opening, and what to say where that fails.
#pragma once

#include "can/frame.hpp"

#include <string>
#include <vector>

namespace servoid::can {

// A non-blocking raw socket bound to the interface: with times, error frames and FD. Throws
// BusError as SocketCan's constructor does.
int open_can_socket(const std::string& interface, const std::vector<FrameId>& listen_to,
                    int receive_buffer_bytes);

// Empty: every identifier. Throws BusError.
void set_filter(int socket, const std::string& interface, const std::vector<FrameId>& identifiers);

enum class InterfaceState { up, down, gone };
InterfaceState state_of(int socket, const std::string& interface);

// "can0: the interface is down: `ip link set ...`"
std::string interface_is_down(const std::string& interface);

} // namespace servoid::can
