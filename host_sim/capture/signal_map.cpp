#include "capture/capture.hpp"
#include "capture/raw_table.hpp"
#include "common/error.hpp"
#include "common/file.hpp"
#include "common/text.hpp"
#include "common/toml_view.hpp"

namespace servoid {

namespace {

std::vector<std::string> signal_names() {
    std::vector<std::string> names;
    for (const KnownColumn& bare : bare_signals())
        names.push_back(bare.name);
    return names;
}

void check_signal_name(const TomlView& signals, const std::string& name) {
    const auto names = signal_names();
    for (const auto& known : names)
        if (known == name) return;
    if (find_column(name))
        signals.fail(name, "signal " + in_quotes(name) +
                               " has a unit; expected the name alone (such as "
                               "force_ref), with a scale to SI");
    signals.fail(name, "unknown signal " + in_quotes(name) + suggestion(name, names));
}

SignalMap::Signal read_signal(const TomlView& table) {
    for (const auto* key : {"id", "start_bit", "length", "byte_order", "signed"})
        if (table.has(key))
            table.fail(key, table.full(key) + " is for CAN frames; a column of a .csv or .mat file "
                                              "has column, scale, offset");
    table.allow_only({"column", "scale", "offset"});
    SignalMap::Signal signal;
    signal.line = static_cast<long>(table.raw().source().begin.line);
    signal.column = table.text("column");
    if (signal.column.empty()) table.fail("column", table.full("column") + " is empty");
    if (table.has("scale")) signal.scale = table.number("scale");
    if (table.has("offset")) signal.offset = table.number("offset");
    if (signal.scale == 0) table.fail("scale", table.full("scale") + " must not be zero");
    return signal;
}

} // namespace

SignalMap read_signal_map(const std::string& path) {
    const std::string text = read_file(path);
    if (trim(text).empty()) throw FileError(path, 0, "is empty; a map of signals was expected");
    const toml::table document = parse_toml(text, path);
    const TomlView root(document, path, "");
    root.allow_only({"signals", "metadata"});
    SignalMap map;
    map.path = path;
    const TomlView signals = root.table("signals");
    for (const auto& name : signals.keys()) {
        check_signal_name(signals, name);
        map.signals[name] = read_signal(signals.table(name));
    }
    if (map.signals.empty()) signals.fail("[signals] is empty; expected [signals.time] and others");
    if (root.has("metadata")) map.metadata = root.table("metadata").as_texts();
    return map;
}

} // namespace servoid
