#include "capture/capture.hpp"
#include "common/text.hpp"

#include <charconv>

namespace servoid {

namespace {

struct Column {
    std::string name;
    const std::vector<double>* values;
};

std::vector<Column> columns_of(const Capture& capture) {
    const std::string length = capture.linear ? "_m" : "_rad";
    const std::string torque = capture.torque_in_ampere ? "current"
                               : capture.linear         ? "force"
                                                        : "torque";
    const std::string unit = capture.torque_in_ampere ? "_A" : capture.linear ? "_N" : "_Nm";
    const std::vector<Column> all = {{"time_s", &capture.time_s},
                                     {"position_ref" + length, &capture.position_ref},
                                     {"velocity_ref" + length + "_s", &capture.velocity_ref},
                                     {torque + "_ref" + unit, &capture.torque_ref},
                                     {torque + unit, &capture.torque},
                                     {"position" + length, &capture.position},
                                     {"velocity" + length + "_s", &capture.velocity},
                                     {"load_position" + length, &capture.load_position}};
    std::vector<Column> recorded;
    for (const Column& column : all)
        if (!column.values->empty()) recorded.push_back(column);
    return recorded;
}

// What the fields of a capture say wins over what its metadata said when it was read.
std::map<std::string, std::string> metadata_of(const Capture& capture) {
    auto metadata = capture.metadata;
    const auto number = [&](const std::string& key, double value) {
        if (value > 0) metadata[key] = format_number(value);
    };
    number("sample_time_s", capture.sample_time_s);
    number("torque_delay_s", capture.torque_delay_s);
    number("period_s", capture.period_s.value_or(0));
    const std::string length = capture.linear ? "_m" : "_rad";
    number("position_quantum" + length, capture.position_quantum);
    number("velocity_quantum" + length + "_s", capture.velocity_quantum);
    number(std::string("torque_quantum") + (capture.torque_in_ampere ? "_A"
                                            : capture.linear         ? "_N"
                                                                     : "_Nm"),
           capture.torque_quantum);
    if (!capture.ref_held) metadata["torque_hold"] = "none";
    if (!capture.uniform && !metadata.contains("sampling")) metadata["sampling"] = "own times";
    if (capture.linear && capture.torque_in_ampere) metadata["motion"] = "linear";
    return metadata;
}

// One metadata entry is one line, whatever was in it.
std::string one_line(std::string text) {
    for (char& c : text)
        if (c == '\n' || c == '\r') c = ' ';
    return text;
}

void append_number(std::string& text, double value) {
    char digits[40];
    text.append(digits, std::to_chars(digits, digits + sizeof digits, value).ptr);
}

} // namespace

std::string format_capture_csv(const Capture& capture) {
    std::string text;
    for (const auto& [key, value] : metadata_of(capture))
        text += "# " + one_line(key) + " = " + one_line(value) + "\n";
    const auto columns = columns_of(capture);
    std::vector<std::string> names;
    for (const Column& column : columns)
        names.push_back(column.name);
    if (!capture.segment.empty()) names.emplace_back("segment");
    text += join(names, ",") + "\n";
    constexpr size_t typical_field = 20;
    text.reserve(text.size() + capture.rows() * names.size() * typical_field);
    for (size_t row = 0; row < capture.rows(); ++row) {
        for (size_t i = 0; i < columns.size(); ++i) {
            if (i > 0) text += ',';
            append_number(text, (*columns[i].values)[row]);
        }
        if (!capture.segment.empty()) text += "," + std::to_string(capture.segment[row]);
        text += '\n';
    }
    return text;
}

} // namespace servoid
