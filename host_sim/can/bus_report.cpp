#include "can/bus_report.hpp"

#include "can/error_frame.hpp"

namespace servoid::can {

void count_error(const Frame& frame, BusReport& report) {
    const Trouble trouble = trouble_of(frame);
    ++report.errors;
    report.bus_off += trouble.bus_off;
    report.restarted += trouble.restarted;
    report.error_passive += trouble.error_passive;
    report.error_warning += trouble.warning;
}

} // namespace servoid::can
