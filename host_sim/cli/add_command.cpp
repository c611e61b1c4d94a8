#include "cli/add_command.hpp"

#include <fmt/format.h>

namespace servoid::cli {

namespace {

std::string free_name(const Model& model) {
    std::string name = "cubic";
    for (int i = 2; model.find("custom." + name); ++i)
        name = fmt::format("cubic{}", i);
    return name;
}

} // namespace

std::string shell_word(const std::string& text) {
    constexpr const char* plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"
                                  "0123456789_-+=.,:/%@";
    if (!text.empty() && text.find_first_not_of(plain) == std::string::npos) return text;
    std::string out = "'";
    for (char c : text)
        out += c == '\'' ? "'\\''" : std::string(1, c);
    return out + "'";
}

std::string options_of(const CaptureOptions& captures) {
    std::string out;
    if (!captures.map.empty()) out += " --map " + shell_word(captures.map);
    if (captures.band_Hz) out += fmt::format(" --band {}", *captures.band_Hz);
    if (!captures.input.empty()) out += " --input " + captures.input;
    return out;
}

std::string add_command(const std::string& law, const Model& model, const std::string& model_path,
                        const CaptureOptions& captures) {
    const std::string name = free_name(model);
    std::string out =
        fmt::format("servoid add 'custom.{}={}' {}", name, law, shell_word(model_path));
    for (const std::string& file : captures.files)
        out += " " + shell_word(file);
    return out + options_of(captures) + fmt::format(" --out with_{}.toml", name);
}

} // namespace servoid::cli
