#include "page/page.hpp"

#include "page/assets.hpp"

#include <nlohmann/json.hpp>

#include <string_view>

namespace servoid {

namespace {

// JSON in a script element: nothing in it can end the element or begin a comment.
std::string script_safe(const std::string& json) {
    std::string out;
    out.reserve(json.size() + json.size() / 50);
    for (size_t i = 0; i < json.size(); ++i) {
        const std::string_view rest = std::string_view(json).substr(i, 3);
        if (json[i] == '<')
            out += "\\u003c";
        else if (json[i] == '>')
            out += "\\u003e";
        else if (json[i] == '&')
            out += "\\u0026";
        else if (rest == "\u2028" || rest == "\u2029")
            out += rest == "\u2028" ? "\\u2028" : "\\u2029", i += 2;
        else
            out += json[i];
    }
    return out;
}

// In one pass, so that nothing that is put in is searched again.
std::string filled(std::string_view page, const std::string& mode) {
    const std::pair<std::string_view, std::string_view> places[] = {
        {"@STYLE@", assets::style},
        {"@DYGRAPHS_CSS@", assets::dygraphs_css},
        {"@DYGRAPHS_JS@", assets::dygraphs_js},
        {"@SCRIPTS@", assets::scripts},
        {"@MODE_JSON@", mode}};
    std::string out;
    for (size_t at = 0; at < page.size();) {
        const size_t next = std::min(page.find('@', at), page.size());
        out += page.substr(at, next - at);
        at = next;
        if (at == page.size()) break;
        bool found = false;
        for (const auto& [name, text] : places)
            if (page.substr(at, name.size()) == name) {
                out += text, at += name.size(), found = true;
                break;
            }
        if (!found) out += page[at++];
    }
    return out;
}

} // namespace

std::string report_page(const Json& story) {
    const Json mode = {{"mode", "report"}, {"story", story}};
    return filled(assets::page,
                  script_safe(mode.dump(-1, ' ', false, Json::error_handler_t::replace)));
}

std::string studio_page() { return filled(assets::page, R"({"mode":"studio"})"); }

} // namespace servoid
