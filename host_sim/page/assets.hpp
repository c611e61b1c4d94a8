// The files of this folder and dygraphs, as they were when the program was built
// (cmake/embed.cmake).
#pragma once

#include <string_view>

namespace servoid::assets {

extern const std::string_view page, style, dygraphs_css, dygraphs_js, scripts;

} // namespace servoid::assets
